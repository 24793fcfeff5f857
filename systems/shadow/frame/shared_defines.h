#pragma once
#include <string>
#include <vector>

namespace gnomon::shadow {

/// Shaders of a row as a part of one text that looks up all lights (systems/lookup): maps lie in shared arrays.
struct SharedRow {
    bool linear_taps = false;  // its sampler would blend four results of comparing
    bool ray_masks = false;    // casters may be alpha-masked
    bool antialias = false;    // as AreaShares::marked, for lights with LightRecord::low's w
    std::string reach_texel;   // GLSL of ShaderKey::reach_texel
};

/// Returns all defines that they require. shader_key.cpp has it, beside those of rows with a program of their own.
std::vector<std::string> shared_defines(const SharedRow& row);

}  // namespace gnomon::shadow
