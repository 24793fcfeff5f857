#pragma once
#include <string>
#include <vector>

#include "components/light_shadow.h"
#include "systems/shadow/filter_table.h"

namespace gnomon::bench {

/// A row of the filter table and what of LightShadow differs from the defaults.
struct FilterVariant {
    std::string name;  // the row's, and its width or taps
    std::vector<std::string> settings;
    const shadow::FilterRow* row = nullptr;
    LightShadow shadow;
    /// It softens by the source's size, so that it is judged by a source with a size alone.
    bool by_source() const { return row->width == shadow::FilterWidth::source; }
};

/// Every row, those of a chosen width or number of taps with several; point lights, but for rows that soften by the
/// source: those get disk_source().
std::vector<FilterVariant> filter_variants();

/// Settings of the disk that softened rows are judged by: two degrees of sky, and four centimetres of lamp.
const std::vector<std::string>& disk_source();

}  // namespace gnomon::bench
