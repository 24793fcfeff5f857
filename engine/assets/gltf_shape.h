#pragma once
#include <nlohmann/json_fwd.hpp>

#include "engine/assets/gltf_file.h"

namespace gnomon::assets::gltf {

/// Checks the type of every property that the loader reads, the length of number arrays, the size of collections,
/// and that every index names an existing object. tinygltf passes over most of these in silence.
/// Whole numbers written as 1.0 become integers, as glTF allows, and a spot without its object gets an empty one; what
/// is merely outside the letter is noted. Throws Failure.
void check_shape(nlohmann::json& document, Notes& notes);

}  // namespace gnomon::assets::gltf
