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

/// What a map holds for a filter: depth, or also which triangle each texel shows
/// (shaders/shadow/filters/triangles/mesh_walk.glsl), or also moments of distances, blurred (shaders/shadow/moments),
/// or also what tells of which pixels it is certain (shaders/shadow/exact); rays ask the casters themselves
/// (shaders/rays) about the others, or about all where the light has no such map; or also what of that a source with a
/// size asks for.
enum class FilterStorage : std::uint8_t { depth, depth_and_triangle, moments, sheets, soft_sheets };

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
    FilterStorage storage = FilterStorage::depth;
    /// What of E is read but cannot move a shadow's edge.
    float still_texel = 0.0f;
    /// Of one cascade, spot view or cube face, per pixel of the picture's larger side, where the light says no size.
    /// What is seen lies obliquely in the map, so that one to one is not enough. Measured in docs/accuracy.md.
    float texels_per_pixel = 1.5f;
    const MomentRow* moments = nullptr;  // of FilterStorage::moments
};

/// The row that measures best, and what ShadowFilter::automatic is where nothing speaks for another.
inline constexpr ShadowFilter kUsualFilter = ShadowFilter::triangles;

/// What is looked up where a budget leaves no more, or the light's own row cannot be had. One fetch, one texel, no
/// store beside the map, and the narrowest footprint: no border or bias is too small for it.
inline constexpr ShadowFilter kPlainFilter = ShadowFilter::hard;

inline bool has_sheets(FilterStorage storage) {
    return storage == FilterStorage::sheets || storage == FilterStorage::soft_sheets;
}
inline bool asks_rays(const FilterRow& row) { return has_sheets(row.storage); }

/// In the order of ShadowFilter.
std::span<const FilterRow> filter_table();
/// Of ShadowFilter::automatic: kUsualFilter's.
const FilterRow& filter_row(ShadowFilter filter);
/// nullptr if there is none of that name.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
