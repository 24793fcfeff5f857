#include <array>
#include <cstdio>
#include <span>

#include "bench/sweep/sweep_json.h"
#include "bench/sweep/sweep_report.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

/// "point drawn", ... : which fronts a light's row is on.
std::vector<std::string> fronts_of(const SceneSweep& sweep, std::size_t row, const std::string& light) {
    std::vector<std::string> found;
    for (const SweepTruth truth : kSweepTruths)
        for (const SweepCost cost : kSweepCosts)
            for (const Choice& choice : choices(sweep, light, truth, cost))
                if (choice.row == row && choice.best)
                    found.push_back(std::string(to_text(truth)) + " " + to_text(cost));
    return found;
}

Json halving_json(const SceneSweep& sweep, const Halving& halving) {
    return {{"from", sweep.plan[halving.from.row].name},
            {"to", sweep.plan[halving.to.row].name},
            {"error_factor", halving.error_factor()},
            {"cost_factor", halving.cost_factor()}};
}

Json finding_json(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost) {
    const HalvingCost halving = halving_cost(sweep, light, truth, cost);
    Json front = Json::array(), steps = Json::array();
    for (const Choice& choice : choices(sweep, light, truth, cost))
        if (choice.best) front.push_back(sweep.plan[choice.row].name);
    for (const Halving& step : halving.steps) steps.push_back(halving_json(sweep, step));
    return {{"light", light},
            {"truth", to_text(truth)},
            {"cost", to_text(cost)},
            {"front", front},
            {"halving_factor", halving.factor ? Json(*halving.factor) : Json(nullptr)},
            {"halvings", steps},
            {"defaults_halved", halving.from_defaults ? halving_json(sweep, *halving.from_defaults) : Json(nullptr)}};
}

Json row_json(const SceneSweep& sweep, std::size_t row) {
    Json lights = Json::array();
    for (const LightRow& light : sweep.rows[row].lights) {
        Json json = to_json(light);
        json["fronts"] = fronts_of(sweep, row, light.light);
        lights.push_back(std::move(json));
    }
    const std::optional<std::string>& error = sweep.rows[row].error;
    return {{"row", sweep.plan[row].name},
            {"factor", sweep.plan[row].factor},
            {"settings", sweep.plan[row].settings},
            {"error", error ? Json(*error) : Json(nullptr)},
            {"lights", std::move(lights)}};
}

Json scene_json(const SceneSweep& sweep) {
    Json rows = Json::array(), findings = Json::array();
    for (std::size_t row = 0; row < sweep.plan.size(); ++row) rows.push_back(row_json(sweep, row));
    for (const std::string& light : lights_of(sweep))
        for (const SweepTruth truth : kSweepTruths)
            for (const SweepCost cost : kSweepCosts) findings.push_back(finding_json(sweep, light, truth, cost));
    return {{"scene", sweep.scene},           {"device", sweep.device},
            {"camera", sweep.camera},         {"size_px", {sweep.size_px.x, sweep.size_px.y}},
            {"trace_s", sweep.trace_s},       {"spent_s", sweep.spent_s},
            {"rounds", sweep.rounds},         {"gl_complaints", sweep.gl_complaints},
            {"rows", std::move(rows)},        {"findings", std::move(findings)},
            {"never_best", never_best(sweep)}};
}

/// As RFC 4180 has it: quoted where it holds a comma, a quote or a line's end.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

std::string number(const Figure& figure) {
    if (!figure) return "";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", *figure);
    return text.data();
}

std::string line_of(const SceneSweep& sweep, std::size_t row, const LightRow* light) {
    const SweepRow& plan = sweep.plan[row];
    std::vector<std::string> cells = {sweep.scene,
                                      sweep.device,
                                      plan.name,
                                      plan.factor,
                                      joined(plan.settings, " "),
                                      sweep.rows[row].error.value_or(""),
                                      light ? light->light : "",
                                      light ? std::string(kind_name(light->kind)) : "",
                                      light ? light->state : "",
                                      light ? light->reason : "",
                                      light ? joined(fronts_of(sweep, row, light->light), "; ") : ""};
    for (const FigureColumn& column : figure_columns())
        cells.push_back(light ? number(column.get(light->figures)) : std::string());
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + cell(cells[i]);
    return line + "\n";
}

}  // namespace

std::string sweep_json(const std::vector<SceneSweep>& scenes) {
    Json all = Json::array();
    for (const SceneSweep& sweep : scenes) all.push_back(scene_json(sweep));
    return Json{{"scenes", std::move(all)}}.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string sweep_csv(const std::vector<SceneSweep>& scenes) {
    std::string text = "scene,device,row,factor,settings,error,light,kind,state,reason,fronts";
    for (const FigureColumn& column : figure_columns()) text += std::string(",") + column.name;
    text += "\n";
    for (const SceneSweep& sweep : scenes)
        for (std::size_t row = 0; row < sweep.plan.size(); ++row) {
            if (sweep.rows[row].lights.empty()) text += line_of(sweep, row, nullptr);
            for (const LightRow& light : sweep.rows[row].lights) text += line_of(sweep, row, &light);
        }
    return text;
}

std::optional<Error> write_sweep(const std::vector<SceneSweep>& scenes, const std::filesystem::path& folder) {
    const std::pair<const char*, std::string> files[] = {
        {"report.json", sweep_json(scenes)}, {"report.csv", sweep_csv(scenes)}, {"report.html", sweep_page(scenes)}};
    for (const auto& [name, text] : files)
        if (auto error = game::write_file(folder / name, std::as_bytes(std::span(text)))) return error;
    return std::nullopt;
}

}  // namespace gnomon::bench
