#pragma once
#include <nlohmann/json.hpp>

#include "bench/sweep/sweep.h"

namespace gnomon::bench {

/// Every figure_columns() name; null where there is none.
nlohmann::ordered_json to_json(const RowFigures& figures);
/// Names that it does not know are left out. Throws nlohmann's exceptions for what is no object of numbers.
RowFigures figures_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json to_json(const LightRow& row);
LightRow light_row_from(const nlohmann::ordered_json& json);

/// Everything that was measured, for report.py and for other scripts; bench/README.md lists the keys.
std::string sweep_json(const std::vector<SceneSweep>& scenes);

}  // namespace gnomon::bench
