#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::shadow {

/// Which program evaluates a light: one row of the light-kind table and one of the filter table.
/// Names are paths under shaders/ and live as long as the program; empty filter: unshadowed.
struct ProgramRow {
    std::string_view kind_define;  // LIGHT_DIRECTIONAL, …
    std::string_view kind_file, filter_file;
    float reach_texel = 0.0f;  // the filter's footprint half-width E, without what LightRecord::spread adds
    bool fades = false;        // looks up a second view that the first one fades into
    bool depths = false;       // reads depths from the map, where other filters read results of comparing with it
    bool manual_bias = false;  // any BiasMode but automatic
    bool triangles = false;    // reads which triangles texels show, and those triangles
    bool sheets = false;       // reads next depths and bounds: rays are for what those leave uncertain
    bool moments = false;      // reads a prefiltered map
    bool rays = false;         // asks the casters' triangles by rays, of surfaces that say where exactly they are
    bool ray_masks = false;    // some of those, or of `triangles`, are masked
    bool footprint = false;    // of which it takes what a pixel covers, by mipmaps or anisotropy
    bool operator==(const ProgramRow&) const = default;
};

/// Returns all defines that the row's shaders require, in any program: "NAME value". Each is always given: a flag as 0
/// or 1, a file to include as a path in quotes (engine/gl/shader_source.h). lighting/light_programs.h adds the
/// outputs'.
std::vector<std::string> program_defines(const ProgramRow& row);

/// Returns the text that they include as "row.glsl": the kind's file and the filter's, and the camera's block where
/// those read it. Empty if the light is unshadowed.
std::string row_glsl(const ProgramRow& row);

}  // namespace gnomon::shadow
