#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "components/shadow_tuning.h"
#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Settings that determine the width of a filter's footprint.
enum class FilterWidth : std::uint8_t {
    fixed,
    size,    // ShadowTuning::Kernel::size_texel
    spread,  // spread_texel, spread_m and doubles_m of ShadowTuning::Kernel
    source   // Light::source_radius_m, sun_radius_rad; needs true distances of casters
};

/// Content of a map for a filter.
/// - `depth`: depth only.
/// - `depth_and_triangle`: plus triangle and instance per texel (shaders/shadow/filters/triangles/mesh_walk.glsl).
/// - `moments`: plus blurred moments of distances (shaders/shadow/passes/prefilter).
/// - `sheets`: conservative shadow map, depth plus error bounds (shaders/shadow/filters/exact). Rays trace undecided
///   pixels, or all where the light has no map.
/// - `soft_sheets`: plus occluder pyramid, for area lights.
enum class FilterStorage : std::uint8_t { depth, depth_and_triangle, moments, sheets, soft_sheets };

/// Result of the map's sampler: depth comparisons, single or blended by hardware; stored depths; or blurred moments.
enum class MapReading : std::uint8_t { compare_nearest, compare_linear, depths, moments };

/// Storage of a prefiltered map with 16 or 32 bits per channel.
struct MomentStore {
    gl::Format format;
    float most_exponent;  // limit of c in the warp e^(c s), s in [-1,1], before the largest power overflows; 0: no warp
    float usual_exponent;  // default of c
    /// Bound on the rounding error of the reconstructed value. It is a variance relative to the warped distance's
    /// square, or a share of moments that are known to be possible. The filter's file defines which.
    float least;
};
struct MomentRow {
    MomentStore bits_16, bits_32;
    float usual_negative_exponent = 0.0f;  // default of c in a second warp, -e^(-c s); 0: there is none
};

/// Filter of a depth map. A new one needs a file in shaders/shadow/filters, an enumerator and a row
/// (docs/adding_a_filter.md).
struct FilterRow {
    ShadowFilter id;
    std::string_view name;  // as in --set filter=
    std::string_view file;  // below shaders/
    /// Returns the largest number of texture fetches per lookup, without early exit. `cube`: for a point light's cube.
    std::uint32_t (*taps)(const ShadowTuning::Kernel& kernel, bool cube);
    /// Kernel radius E, the half-width of the footprint that decides a pixel, texels, without the part that `width`
    /// adds.
    float reach_texel;
    FilterWidth width;
    MapReading reading;
    FilterStorage storage = FilterStorage::depth;
    /// Part of E that is read but cannot move a shadow's edge, texels.
    float still_texel = 0.0f;
    /// Default edge of a cascade, spot view or cube face, texels per pixel of the picture's larger side. More than 1,
    /// because receivers lie obliquely in the map. Measured in docs/accuracy.md.
    float texels_per_pixel = 1.5f;
    const MomentRow* moments = nullptr;  // FilterStorage::moments only
};

/// Default filter, and meaning of ShadowFilter::automatic unless the target chooses another: the row that measures
/// best.
inline constexpr ShadowFilter kUsualFilter = ShadowFilter::triangles;

/// Cheapest filter: fallback under a budget, and while the light's own program is unavailable. One fetch of one texel,
/// no texture beside the map, and the narrowest footprint, so that every border and bias suffices for it.
inline constexpr ShadowFilter kPlainFilter = ShadowFilter::hard;

inline bool has_sheets(FilterStorage storage) {
    return storage == FilterStorage::sheets || storage == FilterStorage::soft_sheets;
}
inline bool asks_rays(const FilterRow& row) { return has_sheets(row.storage); }

/// Returns all rows in the order of ShadowFilter.
std::span<const FilterRow> filter_table();
/// Returns the row of a filter. ShadowFilter::automatic: kUsualFilter's row. Other values outside the table: the first.
const FilterRow& filter_row(ShadowFilter filter);
/// Returns the row with that name, or nullptr.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
