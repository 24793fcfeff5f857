// Light on a shadow catcher, as luminance: red has what casters take of it, green what falls without casters. Both are
// illuminances, lux times ambient.sky.w.
vec4 caught_sum(float taken, float falls) { return vec4(taken, falls, 0.0, 0.0); }

// Returns the luminance of a linear colour (Rec. 709).
float luminance(vec3 colour) { return dot(colour, vec3(0.2126, 0.7152, 0.0722)); }
