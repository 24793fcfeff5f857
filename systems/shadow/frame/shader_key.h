#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "systems/shadow/frame/area_shares.h"

namespace gnomon::shadow {

/// How a program finds what the light's translucent casters let through: by layers beside its map, or by rays through a
/// tree of these casters. none: it has no such casters.
enum class TintLookup : std::uint8_t { none, layers, rays };

/// Key of the shader permutation that evaluates a light, from its rows of the light-kind and filter tables. File names
/// are paths below shaders/ with static lifetime. An empty filter_file means an unshadowed light.
struct ShaderKey {
    std::string_view kind_define;  // LIGHT_DIRECTIONAL, …
    std::string_view kind_file, filter_file;
    float reach_texel = 0.0f;  // kernel radius E, texels, without the part that LightRecord::spread adds
    bool fades = false;        // looks up a second view into which the first one fades
    bool depths = false;       // reads depths; other filters read results of a depth comparison
    bool manual_bias = false;  // any BiasMode but automatic
    bool triangles = false;    // reads which triangles texels show, and these triangles
    bool sheets = false;       // reads second depths and conservative bounds; rays trace the undecided pixels
    bool moments = false;      // reads a prefiltered map
    bool rays = false;         // traces rays to the casters' triangles from surfaces with exact positions
    bool ray_masks = false;    // some of the triangles read by `rays` or `triangles` are alpha-masked
    bool footprint = false;    // filters the prefiltered map over a pixel's footprint, by mipmaps or anisotropy
    AreaShares area_shares = AreaShares::none;  // how visibility becomes a share of the pixel's area; none: it does not
    TintLookup tint = TintLookup::none;         // read by programs that add light to a picture alone
    bool whole_source = false;                  // the filter sees all of an area light; others see its middle alone
    bool operator==(const ShaderKey&) const = default;
};

/// Returns all defines that the row's shaders require, in any program: "NAME value". Each is always given: a flag as 0
/// or 1, a file to include as a path in quotes (engine/gl/shader_source.h). lighting/light_programs.h adds the
/// outputs'.
std::vector<std::string> program_defines(const ShaderKey& row);

/// Returns the text that they include as "row.glsl": the kind's file and the filter's, and the camera's block where
/// those read it. Empty if the light is unshadowed.
std::string row_glsl(const ShaderKey& row);

}  // namespace gnomon::shadow
