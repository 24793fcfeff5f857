// Returns sums of light on a shadow catcher, luminance in lux times ambient.sky.w. Red: what casters take. Green: what
// falls without casters.
vec4 caught_sum(float taken, float falls) { return vec4(taken, falls, 0.0, 0.0); }

// Returns the luminance of a linear colour (Rec. 709).
float luminance(vec3 colour) { return dot(colour, vec3(0.2126, 0.7152, 0.0722)); }
