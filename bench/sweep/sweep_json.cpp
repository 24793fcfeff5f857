#include "bench/sweep/sweep_json.h"

#include "bench/accuracy/default_limits.h"
#include "bench/compare/pareto_front.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {

using Json = nlohmann::ordered_json;

namespace {

/// Returns the name of a kind of light as in --stats.
std::string_view kind_name(LightKind kind) { return shadow::light_kind_row(kind).name; }

/// Names the bounds of the defaults that the figures exceed. Empty: none, or the filter softens by the source's size.
std::string above_bounds(const RowFigures& figures) {
    if (!figures.wrong) return {};
    return missed_limits({*figures.wrong, figures.leak.value_or(0.0), figures.acne.value_or(0.0),
                          figures.false_shadow_far, figures.false_light_far});
}

Json row_json(const SweepRow& plan, const JudgedRow& judged) {
    Json lights = Json::array();
    for (const LightRow& light : judged.lights) {
        lights.push_back(to_json(light));
        lights.back()["above"] = above_bounds(light.figures);
    }
    return {{"row", plan.name},
            {"factor", plan.factor},
            {"settings", plan.settings},
            {"error", judged.error ? Json(*judged.error) : Json(nullptr)},
            {"lights", std::move(lights)}};
}

Json scene_json(const SceneSweep& sweep) {
    Json rows = Json::array();
    for (std::size_t row = 0; row < sweep.plan.size(); ++row)
        rows.push_back(row_json(sweep.plan[row], sweep.rows[row]));
    return {{"scene", sweep.scene},     {"device", sweep.device},
            {"camera", sweep.camera},   {"size_px", {sweep.size_px.x, sweep.size_px.y}},
            {"trace_s", sweep.trace_s}, {"spent_s", sweep.spent_s},
            {"rounds", sweep.rounds},   {"gl_complaints", sweep.gl_complaints},
            {"cost_noise", kCostNoise}, {"rows", std::move(rows)}};
}

}  // namespace

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

std::string sweep_json(const std::vector<SceneSweep>& scenes) {
    Json columns = Json::object(), all = Json::array();
    for (const FigureColumn& column : figure_columns()) columns[column.name] = column.meaning;
    for (const SceneSweep& sweep : scenes) all.push_back(scene_json(sweep));
    return Json{{"columns", std::move(columns)}, {"scenes", std::move(all)}}.dump(1, ' ', false,
                                                                                  Json::error_handler_t::replace) +
           "\n";
}

}  // namespace gnomon::bench
