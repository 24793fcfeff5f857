#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/gl/device.h"
#include "gnomon/shadow_tuning.h"
#include "systems/shadow/frame/area_shares.h"

namespace gnomon::shadow {

/// Settings that determine the width of a filter's footprint.
enum class FilterWidth : std::uint8_t {
    fixed,
    size,    // ShadowTuning::Kernel::size_texel
    spread,  // spread_texel, spread_m and doubles_m of ShadowTuning::Kernel
    source   // Light::source_radius_m, sun_radius_rad; needs true distances of casters
};

/// Work of drawing a view for its filter, relative to drawing depths of 4 bytes alone (budget/cost_model.h).
struct DrawingWork {
    double passes = 1.0;       // targets drawn into, one after the other
    double casters = 1.0;      // number of times that each caster is drawn
    double texel_bytes = 4.0;  // bytes cleared and written per texel, in all targets
    bool operator==(const DrawingWork&) const = default;
};

/// Content of a map for a filter beside its depths. Moments, which passes compute from the depths, are
/// FilterRow::moments.
struct FilterStorage {
    /// Triangle and instance per texel, for lookups (shaders/shadow/filters/triangles/mesh_walk.glsl).
    bool triangle_ids = false;
    /// Conservative shadow map: error bounds and the next depths behind (shaders/shadow/filters/exact).
    bool conservative_bounds = false;
    bool occluder_pyramid = false;  // minima of depths over squares of texels, for area lights
    DrawingWork work{};
    bool operator==(const FilterStorage&) const = default;
};

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

/// Rays to the light beside a map (shaders/ray_tracing). Rays trace undecided pixels, or all where the light has no
/// map.
struct RayRow {
    bool per_source;            // true: Kernel::penumbra_rays per pixel, to places of the source; false: one ray
    ShadowFilter without_rays;  // fallback where rays are unavailable: the most accurate filter without rays
    ShadowFilter without_size;  // replacement where the light's source is a point
};

/// Filter of a depth map. A new one needs a file in shaders/shadow/filters, an enumerator and a row
/// (docs/contributors/adding_a_filter.md).
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
    FilterStorage storage{};
    /// Part of E that is read but cannot move a shadow's edge, texels.
    float still_texel = 0.0f;
    /// Default edge of a cascade, spot view or cube face, texels per pixel of the picture's larger side. More than 1,
    /// because receivers lie obliquely in the map. Measured in docs/results/accuracy.md.
    float texels_per_pixel = 1.5f;
    /// Blurred moments of distances beside the map (shaders/shadow/passes/prefilter). nullptr: none.
    const MomentRow* moments = nullptr;
    const RayRow* rays = nullptr;  // rays beside the map; nullptr: none
    AreaShares area_shares = AreaShares::none;
    bool random = false;  // its taps or rays differ by a seed (shaders/shadow/filters/disk/noise_seed.glsl)
};

/// Default filter, and meaning of ShadowFilter::automatic unless the target chooses another: the row that measures
/// best.
inline constexpr ShadowFilter kDefaultFilter = ShadowFilter::triangles;

/// Meaning of ShadowFilter::automatic for an area light. The shadow of its middle alone would be hard, and black where
/// the middle lies below the surface.
inline constexpr ShadowFilter kAreaFilter = ShadowFilter::pcss;

/// Cheapest filter: fallback under a budget, and while the light's own program is unavailable. One fetch of one texel,
/// no texture beside the map, and the narrowest footprint, so that every border and bias suffices for it.
inline constexpr ShadowFilter kCheapestFilter = ShadowFilter::hard;

/// Returns all rows in the order of ShadowFilter.
std::span<const FilterRow> filter_table();
/// Returns the row of a filter. ShadowFilter::automatic: kDefaultFilter's row. Other values outside the table: the
/// first.
const FilterRow& filter_row(ShadowFilter filter);
/// Returns the row with that name, or nullptr.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
