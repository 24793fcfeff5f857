#include <nlohmann/json.hpp>

#include "bench/check/check.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;  // grows when a key changes its meaning

Json to_json(const Spread& spread) {
    if (spread.count == 0) return nullptr;
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"count", spread.count}};
}

Json device_json(const DeviceCheck& device) {
    Json json = {{"vendor", device.facts.vendor},
                 {"renderer", device.facts.renderer},
                 {"version", device.facts.version},
                 {"glsl", device.facts.glsl},
                 {"software", device.info.is_software},
                 {"robust", device.facts.robust},
                 {"max_texture_px", device.info.max_texture_px},
                 {"max_cube_px", device.info.max_cube_px},
                 {"max_layers", device.info.max_layers},
                 {"max_point_px", device.info.max_point_px},
                 {"max_texel_bytes", device.info.max_texel_bytes},
                 {"uniform_alignment", device.info.uniform_alignment},
                 {"vertex_layer", device.info.vertex_layer}};
    json["limits"] = Json::object();
    for (const gl::DeviceLimit& limit : device.facts.limits) json["limits"][limit.name] = limit.value;
    json["short_of"] = device.short_of;
    json["extensions"] = Json::object();
    for (const gl::DeviceExtension& extension : device.facts.extensions)
        json["extensions"][extension.name] = extension.there;
    json["follows"] = device.follow;
    return json;
}

Json programs_json(const ProgramChecks& programs) {
    Json json = {{"tried", programs.all},         {"left_out", programs.left_out},
                 {"compiled", programs.compiled}, {"not_for_this_device", programs.not_here},
                 {"took_s", programs.took_s},     {"failed", Json::array()}};
    for (const ProgramFailure& failure : programs.failed)
        json["failed"].push_back({{"name", failure.label}, {"log", failure.log}});
    return json;
}

Json row_json(const CheckRow& row) {
    const CheckErrors& e = row.errors;
    const bool judged = row.verdict != CheckVerdict::not_judged;
    return {{"name", row.setup.name},
            {"kind", shadow::light_kind_row(row.setup.kind).name},
            {"filter", row.setup.filter->name},
            {"settings", row.setup.settings},
            {"verdict", judged ? (row.verdict == CheckVerdict::ok ? "ok" : "failed") : "not judged"},
            {"why", row.why},
            {"tolerance", row.tolerance},
            {"scored_px", e.scored},
            {"wrong_px", e.wrong},
            {"acne_px", e.acne},
            {"leak_px", e.leak},
            {"uncovered_px", e.uncovered},
            {"unexplained_px", e.unexplained},
            {"penumbra_error", e.penumbra_error ? Json(*e.penumbra_error) : Json(nullptr)},
            {"map_px", row.map_px},
            {"bytes", row.bytes},
            {"drawn_us", to_json(row.drawn_us)},
            {"kept_us", to_json(row.kept_us)}};
}

}  // namespace

std::string check_json(const Check& check) {
    Json json = {
        {"format", kFormat}, {"well", is_well(check)}, {"verdict", check_verdict(check)}, {"took_s", check.took_s}};
    json["device"] = device_json(check.device);
    json["programs"] = programs_json(check.programs);
    json["picture_px"] = {check.rows.size_px.x, check.rows.size_px.y};
    json["truth_s"] = check.rows.trace_s;
    json["rows_s"] = check.rows.took_s;
    json["rows_error"] = check.rows.error;
    json["rows_left_out"] = check.rows.left_out;
    const FirstFrames& first = check.first_frames;
    json["first_frames"] = {{"drawn", first.drawn},       {"differ", first.differ}, {"most_px", first.most_px},
                            {"dark_px", first.dark_px}, {"took_s", first.took_s}};
    json["rows"] = Json::array();
    for (const CheckRow& row : check.rows.rows) json["rows"].push_back(row_json(row));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
