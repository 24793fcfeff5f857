#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/assets/scene_data.h"
#include "gnomon/result.h"

namespace gnomon::assets {

/// Loads a .gltf or .glb file with everything it names. Reads nothing outside the asset's folder. The result is
/// validated: every index in range, every number finite, every node reached once. On error nothing is kept; the error
/// names file, JSON pointer and rule.
Result<SceneData> load_gltf(const std::filesystem::path& file);

/// Loads from memory (fuzzing, embedded scenes). `base_folder` resolves relative URIs; if empty, URIs are errors.
Result<SceneData> load_gltf_memory(std::span<const std::byte> bytes, const std::filesystem::path& base_folder,
                                   const std::string& name);

}  // namespace gnomon::assets
