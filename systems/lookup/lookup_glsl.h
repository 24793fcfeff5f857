#pragma once
#include <string>

#include "gnomon/result.h"
#include "systems/lookup/lookup_rows.h"

/// One GLSL text that looks up any number of lights.
namespace gnomon::lookup {

/// Returns the text, without #version (it needs 4.30). An engine pastes it into any of its shaders. The same arguments
/// give the same text: no light that comes, goes or changes requires another. All its top-level names begin with
/// `gnomon_`. For engines:
/// - `int gnomon_light_count()`: number of lights;
/// - `float gnomon_visibility(int light, vec3 position, vec3 normal, float error_m)`: the fraction of the light that
///   reaches a surface; 0 where it faces away or lies outside range and cone. `position`: from the camera, in the
///   world's axes, metres. `normal`: geometric, unit, facing the viewer. `error_m`: how far off the position may be;
/// - `float gnomon_visibility(int light, vec3 position, vec3 normal)`: the same for positions as exact as floats are;
/// - `float gnomon_visibility(int light, vec3 position)`: the same for a place without a surface: fog, particles;
/// - `gnomon_uniform_visibility()` of each: faster, for a light that is the same for all invocations that call it at
///   once (dynamically uniform). In a loop over all lights it is, over the lights of a cluster it may not be;
/// - `bool gnomon_takes_shadow(int light, int layers)`: whether its shadows fall on receivers of these layers;
/// - `vec2 gnomon_pixel`: the pixel, which filters with noise by pixel read: gl_FragCoord.xy.
/// Errors: bindings with too few units; filters that are empty or that can_evaluate() denies, or no kind (rule
/// "lookup.bindings", "lookup.rows").
Result<std::string> lookup_glsl(const LookupBindings& bindings, const LookupRows& rows = {});

}  // namespace gnomon::lookup
