#pragma once
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

/// What a filter reads.
enum class FilterStorage : std::uint8_t { depth };

/// One way of looking a depth map up. To add one: a file under shaders/shadow/filters, an enumerator, a row
/// (docs/adding_a_filter.md).
struct FilterRow {
    ShadowFilter id;
    std::string_view name;  // as in --set filter=
    std::string_view file;  // under shaders/
    /// Texture fetches per lookup, without early bailing; `cube`: of a point light.
    std::uint32_t (*taps)(const LightShadow& shadow, bool cube);
    /// E, the half-width of the footprint that decides a pixel, in texels: this, and what `width` adds.
    float reach_texel;
    FilterWidth width;
    bool linear_sampler;  // compare results blended by hardware
    FilterStorage storage = FilterStorage::depth;
};

/// In the order of ShadowFilter.
std::span<const FilterRow> filter_table();
const FilterRow& filter_row(ShadowFilter filter);
/// nullptr if there is none of that name.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
