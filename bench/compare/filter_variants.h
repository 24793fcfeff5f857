#pragma once
#include <string>
#include <vector>

#include "bench/common/configuration.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {

/// A row of the filter table; its name is followed by its width or taps.
struct FilterVariant : RowSetup {
    const shadow::FilterRow* row = nullptr;
    game::LightSettings light;  // what the settings make of the defaults
    /// Returns whether the row softens by the source's size: then only the truth about a source with a size judges it.
    bool by_source() const { return row->width == shadow::FilterWidth::source; }
};

/// Returns every row. Rows with a choice of width or number of taps come with several values. Rows that soften by the
/// source have disk_source().
std::vector<FilterVariant> filter_variants();

/// Settings of the disk that softened rows are judged by: two degrees of sky, and four centimetres of lamp.
const std::vector<std::string>& disk_source();

}  // namespace gnomon::bench
