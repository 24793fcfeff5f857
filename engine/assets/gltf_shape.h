#pragma once
#include <nlohmann/json_fwd.hpp>

#include "engine/assets/gltf_file.h"

namespace gnomon::assets::gltf {

/// Checks every property that the loader reads: type, length of number arrays, size of collections, existence of
/// referenced objects. tinygltf silently accepts most violations. Whole numbers written as 1.0 become integers, as glTF
/// allows. A spot without its object gets an empty one. Notes accepted violations of the format. Throws Failure.
void check_shape(nlohmann::json& document, Notes& notes);

}  // namespace gnomon::assets::gltf
