#pragma once
#include <span>
#include <string_view>

#include "components/light_shadow.h"

namespace gnomon::shadow {

/// One way of looking a depth map up. To add one: a file under shaders/shadow/filters, an enumerator, a row.
struct FilterRow {
    ShadowFilter id;
    std::string_view name;  // as in --set filter=
    std::string_view file;  // under shaders/
    std::uint32_t taps;     // texture fetches per pixel
    float reach_texel;      // E: half-width of the footprint that decides a pixel, in texels
    bool linear_sampler;    // compare results blended by hardware
};

/// In the order of ShadowFilter.
std::span<const FilterRow> filter_table();
const FilterRow& filter_row(ShadowFilter filter);
/// nullptr if there is none of that name.
const FilterRow* find_filter(std::string_view name);

}  // namespace gnomon::shadow
