#include "bench/sweep/sweep_json.h"

#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {

using Json = nlohmann::ordered_json;

std::string_view kind_name(LightKind kind) { return shadow::light_kind_row(kind).name; }

Json to_json(const RowFigures& figures) {
    Json json = Json::object();
    for (const FigureColumn& column : figure_columns()) {
        const Figure value = column.get(figures);
        json[column.name] = value ? Json(*value) : Json(nullptr);
    }
    return json;
}

RowFigures figures_from(const Json& json) {
    RowFigures figures;
    for (const FigureColumn& column : figure_columns()) {
        const auto found = json.find(column.name);
        if (found != json.end() && !found->is_null()) column.set(figures, found->get<double>());
    }
    return figures;
}

Json to_json(const LightRow& row) {
    return {{"light", row.light},
            {"kind", kind_name(row.kind)},
            {"state", row.state},
            {"reason", row.reason},
            {"figures", to_json(row.figures)}};
}

LightRow light_row_from(const Json& json) {
    LightRow row;
    row.light = json.at("light").get<std::string>();
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        if (json.at("kind").get<std::string>() == kind_name(kind)) row.kind = kind;
    row.state = json.at("state").get<std::string>();
    row.reason = json.at("reason").get<std::string>();
    row.figures = figures_from(json.at("figures"));
    return row;
}

}  // namespace gnomon::bench
