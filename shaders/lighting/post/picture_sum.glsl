// Radiance that passes add to the picture before its exposure, times ambient.sky.w, in 16 bits. More than they hold is
// cut: two infinities may add up to no number. alpha: 1 where a surface is, and one more times what still shows of
// unlit ones.
const float kMostInPicture = 65504.0;

vec3 in_picture(vec3 radiance) { return min(radiance, vec3(kMostInPicture)); }
