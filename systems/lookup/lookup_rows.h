#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "gnomon/light.h"
#include "systems/shadow/frame/shader_key.h"

/// What one text that looks up all lights can look up, and by which bindings.
namespace gnomon::lookup {

/// Numbers of bindings, which the engine chooses. They are written into the text.
struct LookupBindings {
    std::uint32_t first_texture_unit = 0;
    std::uint32_t texture_unit_count = 15;  // three for buffers that are read as texels, the others for maps
    std::uint32_t storage_binding = 0;      // one, for masks of casters
    bool operator==(const LookupBindings&) const = default;
};
inline constexpr std::uint32_t kTexelUnits = 3;  // records of the lights; instances; the casters' triangles
inline constexpr std::uint32_t kLeastTextureUnits = kTexelUnits + 2;

/// Units for shared arrays: of depths first, then as many of the triangles that texels show, then the buffers read as
/// texels.
struct LookupUnits {
    std::uint32_t arrays = 0;  // number of arrays of depths, and of triangles
    std::uint32_t first_depths = 0, first_triangles = 0, first_texels = 0;
};
LookupUnits units_of(const LookupBindings& bindings);

/// Returns whether a text may have the filter: it reads a map's depths.
bool can_evaluate(ShadowFilter filter);
/// Returns the filters of a text where none are chosen. They look up `hard`, `hardware_2x2`, `pcf_grid`,
/// `pcf_bilinear`, `sharp_4x4`, `triangles` and `pcss` to the same result, and others by the nearest.
std::span<const ShadowFilter> usual_filters();

/// What a text has. Each part costs time to compile; on software devices, which run both sides of a branch, also time
/// to run. A light that needs what is left out is looked up by what comes nearest, or is lit (LookupStatus).
struct LookupRows {
    std::span<const ShadowFilter> filters = usual_filters();
    bool suns = true;         // suns with cascades
    bool warped_suns = true;  // suns with warped maps
    bool cones = true;        // spots, aimed lamps and suns with an eye
    bool cubes = true;        // points
    bool masks = true;        // masked casters by their masks, for `triangles`
    bool antialias = false;   // antialiased edges, for lights that want them
    /// Text for hardware, where DeviceInfo::is_software is false: branches instead of loops, and four texels at once.
    bool for_hardware = false;
};

/// How a text looks up a light of some filter.
struct FilterChoice {
    ShadowFilter filter = ShadowFilter::automatic;  // one of the text's
    bool alike = false;                             // the result is the same
    bool one_tap = false;                           // by a single tap of it
    bool without_source = false;                    // the light counts as a point
    bool operator==(const FilterChoice&) const = default;
};
/// Returns the filter itself, or one with the same result. Else it returns the nearest in width of blur and in how it
/// measures edges. `filters` is not empty. Only maps of `triangles` have what that filter needs.
FilterChoice choose_filter(ShadowFilter filter, std::span<const ShadowFilter> filters);

/// Files of light kinds that have rows here, as ShaderKey::kind_file names them.
inline constexpr std::string_view kCascadesFile = "shadow/lookup/kinds/directional.glsl";
inline constexpr std::string_view kCubeFile = "shadow/lookup/kinds/point.glsl";

/// Kinds of lookups, as records number them. none: all is lit.
enum class LookupKind : std::uint8_t { none, cascades, warped_cascades, cone, cube };
/// Returns the kind of a row with a map.
LookupKind lookup_kind(const shadow::ShaderKey& row);
bool has_kind(const LookupRows& rows, LookupKind kind);

}  // namespace gnomon::lookup
