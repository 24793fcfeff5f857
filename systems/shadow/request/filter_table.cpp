#include "systems/shadow/request/filter_table.h"

#include <algorithm>
#include <iterator>

#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/prefilter_settings.h"

namespace gnomon::shadow {
namespace {

using Kernel = ShadowTuning::Kernel;

std::uint32_t one(const Kernel&, bool) { return 1; }
/// Returns the fetches of 16 bytes by an average ray through a large scene (docs/explanation/exact.md, "Trees"). There
/// is no upper bound.
std::uint32_t of_ray(const Kernel&, bool) {
    constexpr std::uint32_t kBoxes = 55, kTriangles = 32, kPerBox = 2, kPerTriangle = 3;
    return kBoxes * kPerBox + kTriangles * kPerTriangle;
}
std::uint32_t of_rays(const Kernel& kernel, bool cube) { return of_ray(kernel, cube) * kernel.penumbra_rays; }
std::uint32_t of_grid(const Kernel& kernel, bool) { return kernel.size_texel * kernel.size_texel; }
/// Counts fetches of 2x2 texels: a grid of n texels touches n + 1 of them per axis.
std::uint32_t of_pairs(const Kernel& kernel, bool) {
    const std::uint32_t pairs = (kernel.size_texel + 1) / 2;
    return pairs * pairs;
}
std::uint32_t of_disk(const Kernel& kernel, bool) { return kernel.taps; }
// On a flat map, offsets that differ only toward the light are one tap.
std::uint32_t of_cube_grid(const Kernel&, bool cube) { return cube ? 64 : 16; }
std::uint32_t of_directions(const Kernel&, bool cube) { return cube ? 20 : 8; }

/// Counts one fetch of four texels. Where these disagree, it counts sixteen texels and two neighbours of each texel
/// above the receiver's plane.
std::uint32_t of_votes(const Kernel&, bool) { return 1 + 16 * 3; }

/// Counts the fetches of of_votes(), and the triangles of four texels.
std::uint32_t of_triangles(const Kernel& kernel, bool cube) { return of_votes(kernel, cube) + 4; }

// The largest half float is e^11.09, the largest float e^88.7. EVSM stores squares, and a sum of weights needs room.
// Half floats below 2^-14 = e^-9.7 lose bits.
constexpr MomentRow kExponential{{gl::Format::r16f, 9.7f, 9.7f, 0.0f}, {gl::Format::r32f, 84.0f, 80.0f, 0.0f}};
// A variance is the difference of squares that are rounded to 2^-17 (16 bits) or 2^-24 of 1. `least` covers three
// roundings: two of squares, and one of blending.
constexpr MomentRow kVariance{{gl::Format::rg16, 0.0f, 0.0f, 3.0e-5f}, {gl::Format::rg32f, 0.0f, 0.0f, 2.5e-7f}};
// The same bound, relative to the square; half floats have 11 bits.
constexpr MomentRow kWarped{{gl::Format::rg16f, 5.54f, 5.54f, 1.5e-3f}, {gl::Format::rg32f, 42.0f, 40.0f, 2.5e-7f}};
constexpr MomentRow kWarpedTwice{
    {gl::Format::rgba16f, 5.54f, 5.54f, 1.5e-3f}, {gl::Format::rgba32f, 42.0f, 40.0f, 2.5e-7f}, 5.0f};
constexpr MomentRow kFourMoments{{gl::Format::rgba16, 0.0f, 0.0f, 6.0e-5f}, {gl::Format::rgba32f, 0.0f, 0.0f, 3.0e-7f}};

constexpr double kDepth_bytes = 4.0, kTriangle_bytes = 8.0, kBounds_bytes = 8.0;  // per texel (map_textures.h)
constexpr FilterStorage kDepthsAlone{};
/// Triangle ids, written in the pass of the depths.
constexpr FilterStorage kTriangleIds{.triangle_ids = true, .work = {.texel_bytes = kDepth_bytes + kTriangle_bytes}};
/// Nearest depths with triangle ids, next depths, and bounds. Each caster is drawn twice, and its slopes are measured
/// in a third pass.
constexpr DrawingWork kBoundsWork{3.0, 3.0, kDepth_bytes + kTriangle_bytes + kDepth_bytes + kBounds_bytes};
constexpr FilterStorage kConservativeBounds{.conservative_bounds = true, .work = kBoundsWork};
/// The same for an area light. The occluder pyramid, a small share of the work, is not counted.
constexpr FilterStorage kSourceBounds{.conservative_bounds = true, .occluder_pyramid = true, .work = kBoundsWork};
constexpr RayRow kOneRay{false, kDefaultFilter, ShadowFilter::exact};
constexpr RayRow kSourceRays{true, ShadowFilter::pcss, ShadowFilter::exact};

/// Counts the blocker search of pcss.glsl, then two disks or votes.
std::uint32_t of_search(const Kernel& kernel, bool cube) {
    constexpr std::uint32_t kTapsPerOctave = 4, kOctaves = 8;  // from half a texel to kMostPenumbra_texel
    static_assert(kMostPenumbra_texel == 0.5f * (1u << kOctaves));
    return kTapsPerOctave * kOctaves + std::max(2 * kernel.taps, of_votes(kernel, cube));
}

/// Counts the search of soft_triangles.glsl, its places by depth, and the triangles that it tests: their ids, their
/// corners and the instance.
std::uint32_t of_places(const Kernel&, bool) {
    constexpr std::uint32_t kSearch = 32, kPlaces = 32, kTriangles = 24, kPerTriangle = 2 + 3 + 5;
    return kSearch + kPlaces + kTriangles * kPerTriangle;
}

/// Counts a lookup in each mipmap level, up to a texel as wide as the widest penumbra, and four lookups between two
/// levels.
std::uint32_t of_levels(const Kernel&, bool) { return widest_penumbra_levels(kMostPenumbra_texel) + 4; }

// E of the rows below is the distance from the receiver's map position to the farthest texel edge that takes part.
// - One nearest tap: 1/2. A hardware 2x2 tap blends texels up to one away. Taps beside the middle add their distance.
// - sharp_4x4 counts votes of texels up to 2 away and reads their neighbours. It does so only where the four texels
//   around the receiver disagree. The edge is then less than a texel away, as under one nearest tap.

/// Returns the row of a prefiltered map: one fetch of texels that were blurred by size_texel. The sampler blends texels
/// up to one away.
constexpr FilterRow prefiltered(ShadowFilter id, std::string_view name, std::string_view file,
                                const MomentRow& moments) {
    FilterRow row{id, name, file, one, 1.0f, FilterWidth::size, MapReading::moments};
    row.moments = &moments;
    return row;
}

/// Returns the row of a prefiltered map for area lights: it is blurred by the default size, and by the penumbra's width
/// in the lookup.
constexpr FilterRow prefiltered_by_source(ShadowFilter id, std::string_view name, std::string_view file,
                                          const MomentRow& moments) {
    FilterRow row = prefiltered(id, name, file, moments);
    row.taps = of_levels;
    row.reach_texel = 2.0f;
    row.width = FilterWidth::source;
    row.texels_per_pixel = 0.75f;
    return row;
}

constexpr FilterRow with_seeds(FilterRow row) {
    row.random = true;
    return row;
}

constexpr FilterRow kRows[] = {
    {ShadowFilter::hard, "hard", "shadow/filters/pcf/hard.glsl", one, 0.5f, FilterWidth::fixed,
     MapReading::compare_nearest},
    {ShadowFilter::hardware_2x2, "hardware_2x2", "shadow/filters/pcf/hardware_2x2.glsl", one, 1.0f, FilterWidth::fixed,
     MapReading::compare_linear},
    {ShadowFilter::pcf_grid, "pcf_grid", "shadow/filters/pcf/pcf_grid.glsl", of_grid, 0.5f, FilterWidth::size,
     MapReading::compare_nearest},
    {ShadowFilter::pcf_bilinear, "pcf_bilinear", "shadow/filters/pcf/pcf_bilinear.glsl", of_pairs, 1.0f,
     FilterWidth::size, MapReading::compare_linear},
    {ShadowFilter::poisson, "poisson", "shadow/filters/disk/poisson.glsl", of_disk, 0.5f, FilterWidth::spread,
     MapReading::compare_nearest},
    with_seeds({ShadowFilter::poisson_rotated, "poisson_rotated", "shadow/filters/disk/poisson_rotated.glsl", of_disk,
                0.5f, FilterWidth::spread, MapReading::compare_nearest}),
    with_seeds({ShadowFilter::poisson_stratified, "poisson_stratified", "shadow/filters/disk/poisson_stratified.glsl",
                of_disk, 0.5f, FilterWidth::spread, MapReading::compare_nearest}),
    {ShadowFilter::cube_grid, "cube_grid", "shadow/filters/disk/cube_grid.glsl", of_cube_grid, 0.5f,
     FilterWidth::spread, MapReading::compare_nearest},
    {ShadowFilter::cube_directions, "cube_directions", "shadow/filters/disk/cube_directions.glsl", of_directions, 0.5f,
     FilterWidth::spread, MapReading::compare_nearest},
    {ShadowFilter::sharp_4x4, "sharp_4x4", "shadow/filters/pcf/sharp_4x4.glsl", of_votes, 3.0f, FilterWidth::fixed,
     MapReading::depths, kDepthsAlone, 2.5f},
    {ShadowFilter::triangles, "triangles", "shadow/filters/triangles/triangles.glsl", of_triangles, 3.0f,
     FilterWidth::fixed, MapReading::depths, kTriangleIds, 2.5f, 1.0f, nullptr, nullptr, AreaShares::marked},
    prefiltered(ShadowFilter::exponential, "exponential", "shadow/filters/prefiltered/exponential.glsl", kExponential),
    prefiltered(ShadowFilter::vsm, "vsm", "shadow/filters/prefiltered/vsm.glsl", kVariance),
    prefiltered(ShadowFilter::evsm2, "evsm2", "shadow/filters/prefiltered/evsm2.glsl", kWarped),
    prefiltered(ShadowFilter::evsm4, "evsm4", "shadow/filters/prefiltered/evsm4.glsl", kWarpedTwice),
    prefiltered(ShadowFilter::moments, "moments", "shadow/filters/prefiltered/moments.glsl", kFourMoments),
    with_seeds({ShadowFilter::pcss, "pcss", "shadow/filters/pcss/pcss.glsl", of_search, 3.0f, FilterWidth::source,
                MapReading::depths, kDepthsAlone, 2.5f, 0.75f, nullptr, nullptr, AreaShares::spread}),
    prefiltered_by_source(ShadowFilter::pcss_moments, "pcss_moments", "shadow/filters/prefiltered/pcss_moments.glsl",
                          kFourMoments),
    with_seeds({ShadowFilter::soft_triangles, "soft_triangles", "shadow/filters/soft_triangles/soft_triangles.glsl",
                of_places, 3.0f, FilterWidth::source, MapReading::depths, kTriangleIds, 2.5f, 0.75f, nullptr, nullptr,
                AreaShares::spread}),
    {ShadowFilter::exact, "exact", "shadow/filters/exact/exact.glsl", of_ray, 0.5f, FilterWidth::fixed,
     MapReading::depths, kConservativeBounds, 0.0f, 0.75f, nullptr, &kOneRay, AreaShares::marked},
    with_seeds({ShadowFilter::exact_soft, "exact_soft", "shadow/filters/exact/exact_soft.glsl", of_rays, 0.5f,
                FilterWidth::source, MapReading::depths, kSourceBounds, 0.0f, 0.75f, nullptr, &kSourceRays,
                AreaShares::spread}),
};
static_assert(std::size(kRows) == static_cast<std::size_t>(ShadowFilter::count));

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < std::size(kRows); ++i)
        if (static_cast<std::size_t>(kRows[i].id) != i) return false;
    return true;
}
static_assert(rows_are_in_order());

}  // namespace

std::span<const FilterRow> filter_table() { return kRows; }

const FilterRow& filter_row(ShadowFilter filter) {
    const auto index = static_cast<std::size_t>(filter == ShadowFilter::automatic ? kDefaultFilter : filter);
    return kRows[index < std::size(kRows) ? index : 0];
}

const FilterRow* find_filter(std::string_view name) {
    for (const FilterRow& row : kRows)
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace gnomon::shadow

namespace gnomon {

const char* to_text(ShadowFilter filter) {
    return filter == ShadowFilter::automatic ? "automatic" : shadow::filter_row(filter).name.data();
}

}  // namespace gnomon
