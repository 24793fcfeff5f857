#pragma once
#include <nlohmann/json.hpp>

#include "bench/sweep/sweep.h"

namespace gnomon::bench {

/// Writes a value for every figure_columns() name; null: there is none.
nlohmann::ordered_json to_json(const RowFigures& figures);
/// Reads figures, without unknown names. Throws nlohmann's exceptions if `json` is no object of numbers.
RowFigures figures_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json to_json(const LightRow& row);
LightRow light_row_from(const nlohmann::ordered_json& json);

/// Returns all measurements for report.py and for other scripts; bench/README.md lists the keys.
std::string sweep_json(const std::vector<SceneSweep>& scenes);

}  // namespace gnomon::bench
