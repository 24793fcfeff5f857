#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "components/shadow_tuning.h"
#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Which settings the footprint of a filter follows.
enum class FilterWidth : std::uint8_t {
    fixed,
    size,    // ShadowTuning::Kernel::size_texel
    spread,  // its spread_texel, spread_m, doubles_m
    source   // Light::source_radius_m, sun_radius_rad; needs true distances of casters
};

/// Work of drawing a view, against drawing depths of 4 bytes alone (budget/cost_model.h).
struct DrawingWork {
    double passes = 1.0;       // targets drawn into, one after the other
    double casters = 1.0;      // number of times that each caster is drawn
    double texel_bytes = 4.0;  // bytes cleared and written per texel, in all targets
    bool operator==(const DrawingWork&) const = default;
};

/// Facts of what a map stores for a filter beside its depths. Moments, which passes make of the depths, are
/// FilterRow::moments.
struct FilterStorage {
    /// Instance and triangle that each texel shows, for lookups (shaders/shadow/filters/triangles/mesh_walk.glsl).
    bool triangle_ids = false;
    /// Bounds within which nothing else can lie, with the next depths behind (shaders/shadow/exact).
    bool conservative_bounds = false;
    bool occluder_pyramid = false;  // minima of depths over squares of texels, for a source with a size
    DrawingWork work{};
    bool operator==(const FilterStorage&) const = default;
};

/// What its sampler returns: results of comparing, as they are or blended by hardware, what is stored, or blurred
/// moments of it.
enum class MapReading : std::uint8_t { compare_nearest, compare_linear, depths, moments };

/// How a prefiltered map stores what its filter's file makes of distances: in 16 or 32 bits a channel.
struct MomentStore {
    gl::Format format;
    float most_exponent;   // of warped distances e^(c s), s in [-1,1]; beyond, the largest power overflows; 0: no warp
    float usual_exponent;  // where the light names none
    /// How far rounding may take what is reconstructed: a variance, relative to the warped distance's square, or a
    /// share of moments that are known to be possible (the filter's file says which).
    float least;
};
struct MomentRow {
    MomentStore bits_16, bits_32;
    float usual_negative_exponent = 0.0f;  // of a second warp, -e^(-c s); 0: there is none
};

/// Facts of a filter with rays to the light (shaders/rays), for pixels that its map leaves uncertain.
struct RayRow {
    bool per_source;            // rays per pixel are Kernel::penumbra_rays, to places of the source; else one
    ShadowFilter without_rays;  // filter instead where rays cannot be had: errs least by maps alone
    ShadowFilter without_size;  // filter instead where the light's source is a point
};

/// One way of looking a depth map up. To add one: a file under shaders/shadow/filters, an enumerator, a row
/// (docs/adding_a_filter.md).
struct FilterRow {
    ShadowFilter id;
    std::string_view name;  // as in --set filter=
    std::string_view file;  // under shaders/
    /// Most texture fetches per lookup, without early bailing; `cube`: of a point light.
    std::uint32_t (*taps)(const ShadowTuning::Kernel& kernel, bool cube);
    /// E, the half-width of the footprint that decides a pixel, in texels: this, and what `width` adds.
    float reach_texel;
    FilterWidth width;
    MapReading reading;
    FilterStorage storage{};
    /// What of E is read but cannot move a shadow's edge.
    float still_texel = 0.0f;
    /// Of one cascade, spot view or cube face, per pixel of the picture's larger side, where the light says no size.
    /// What is seen lies obliquely in the map, so that one to one is not enough. Measured in docs/accuracy.md.
    float texels_per_pixel = 1.5f;
    const MomentRow* moments = nullptr;  // blurred moments of distances (shaders/shadow/moments); nullptr: none
    const RayRow* rays = nullptr;        // rays beside the map; nullptr: none
};

/// The row that measures best, and what ShadowFilter::automatic is where nothing speaks for another.
inline constexpr ShadowFilter kUsualFilter = ShadowFilter::triangles;

/// What is looked up where a budget leaves no more, or the light's own row cannot be had. One fetch, one texel, no
/// store beside the map, and the narrowest footprint: no border or bias is too small for it.
inline constexpr ShadowFilter kPlainFilter = ShadowFilter::hard;

/// In the order of ShadowFilter.
std::span<const FilterRow> filter_table();
/// Of ShadowFilter::automatic: kUsualFilter's.
const FilterRow& filter_row(ShadowFilter filter);
/// nullptr if there is none of that name.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
