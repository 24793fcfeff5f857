#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "components/light_shadow.h"

namespace gnomon::shadow {

/// What of LightShadow the footprint of a filter follows.
enum class FilterWidth : std::uint8_t {
    fixed,
    size,   // filter_size
    spread  // filter_spread_texel, filter_spread_m, filter_doubles_m
};

/// What a map holds for a filter: depth, or also which triangle each texel shows
/// (shaders/shadow/caster_triangles.glsl).
enum class FilterStorage : std::uint8_t { depth, depth_and_triangle };

/// What its sampler returns: results of comparing, as they are or blended by hardware, or what is stored.
enum class MapReading : std::uint8_t { compare_nearest, compare_linear, depths };

/// One way of looking a depth map up. To add one: a file under shaders/shadow/filters, an enumerator, a row
/// (docs/adding_a_filter.md).
struct FilterRow {
    ShadowFilter id;
    std::string_view name;  // as in --set filter=
    std::string_view file;  // under shaders/
    /// Most texture fetches per lookup, without early bailing; `cube`: of a point light.
    std::uint32_t (*taps)(const LightShadow& shadow, bool cube);
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
};

/// In the order of ShadowFilter.
std::span<const FilterRow> filter_table();
const FilterRow& filter_row(ShadowFilter filter);
/// nullptr if there is none of that name.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
