#pragma once
#include <nlohmann/json.hpp>

#include "bench/compare/evaluate_configuration.h"

namespace gnomon::bench {

/// Every figure_columns() name; null where there is none.
nlohmann::ordered_json to_json(const RowFigures& figures);
/// Names that it does not know are left out. Throws nlohmann's exceptions for what is no object of numbers.
RowFigures figures_from(const nlohmann::ordered_json& json);

nlohmann::ordered_json to_json(const LightRow& row);
LightRow light_row_from(const nlohmann::ordered_json& json);

/// How a kind of light is called in files and tables, as in --stats.
std::string_view kind_name(LightKind kind);

}  // namespace gnomon::bench
