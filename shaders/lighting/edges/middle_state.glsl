// Visibility at the middles of pixels, in the first of two steps toward antialiased edges.
const float kUnreached = -1.0;   // by the light, or no surface; systems/lighting/edge_pass.cpp has the same
const float kUndecided = 2.0;    // added where the texels around the middle do not agree, or the map is not certain

// Returns the visibility of a state.
float share_of(float state) { return state < 0.0 ? 0.0 : (state < kUndecided ? state : state - kUndecided); }
