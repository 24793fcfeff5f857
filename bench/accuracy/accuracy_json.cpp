#include <nlohmann/json.hpp>

#include "bench/accuracy/accuracy.h"
#include "bench/accuracy/stated_accuracy.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Spread& spread) {
    if (spread.count == 0) return nullptr;
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"count", spread.count}};
}

Json to_json(const SoftAccuracy& soft) {
    const oracle::SoftMetrics& m = soft.metrics;
    return {
        {"source", soft.source},
        {"scored_px", m.scored},
        {"mean_error", m.mean_error},
        {"umbra_px", m.umbra},
        {"umbra_leak", m.umbra_leak},
        {"lit_px", m.lit},
        {"lit_loss", m.lit_loss},
        {"penumbra_px", m.penumbra},
        {"penumbra_error", m.penumbra_error},
        {"width_places", m.widths.places},
        {"width_lost", m.widths.lost},
        {"width_ratio", {{"p10", m.widths.p10_ratio}, {"median", m.widths.median_ratio}, {"p90", m.widths.p90_ratio}}}};
}

Json to_json(const AreaAccuracy& area) {
    const oracle::AreaMetrics& m = area.metrics;
    return {{"crossed_px", m.crossed},  {"mean_error", m.mean_error},       {"bias", m.bias},
            {"p99_error", m.p99_error}, {"uncrossed_px", m.uncrossed},      {"uncrossed_error", m.uncrossed_error},
            {"partial_px", m.partial},  {"partial_error", m.partial_error}, {"shown", area.shown}};
}

Json to_json(const TintAccuracy& tint) {
    const oracle::TintMetrics& m = tint.metrics;
    return {{"scored_px", m.scored},      {"tinted_px", m.tinted},          {"beyond_px", m.beyond},
            {"mean_error", m.mean_error}, {"tinted_error", m.tinted_error}, {"max_error", m.max_error}};
}

Json to_json(const AirAccuracy& air) {
    return {{"places", air.places},
            {"dark", air.dark},
            {"wrong", air.wrong},
            {"ways", air.ways},
            {"way_error", air.way_error}};
}

/// Adds the figures that are counted against the truth.
void add_errors(const LightAccuracy& light, Json& json) {
    const oracle::Metrics& m = light.metrics;
    json["scored_px"] = m.scored;
    json["wrong_px"] = m.wrong;
    json["false_shadow_px"] = m.false_shadow;
    json["false_light_px"] = m.false_light;
    json["uncovered_px"] = m.uncovered;
    json["acne_px"] = m.acne;
    json["leak_px"] = m.leak;
    json["false_shadow_far_px"] = light.far.false_shadow;
    json["false_light_far_px"] = light.far.false_light;
    json["false_shadow_crease_px"] = light.far.crease_shadow;
    json["false_light_crease_px"] = light.far.crease_light;
    json["ambiguous_px"] = m.ambiguous;
    json["other_surface_px"] = light.other_surface ? Json(*light.other_surface) : Json(nullptr);
    json["coverage_mismatch_px"] = m.coverage_mismatch;
    json["wrong"] = m.fraction(m.wrong);
    json["acne"] = m.fraction(m.acne);
    json["leak"] = m.fraction(m.leak);
    json["edge"] = {{"places", m.edge.places},         {"lost", m.edge.lost},
                    {"unmeasured", m.edge.unmeasured}, {"mean_signed_px", m.edge.mean_signed_px},
                    {"mean_px", m.edge.mean_px},       {"p95_px", m.edge.p95_px},
                    {"p99_px", m.edge.p99_px},         {"max_px", m.edge.max_px}};
    const EdgeAccuracy none;
    const EdgeAccuracy& edges = light.edges ? *light.edges : none;
    json["edge_exceptions"] = {{"sub_texel_caster", edges.exceptions.sub_texel_caster},
                               {"truth_ambiguous", edges.exceptions.truth_ambiguous},
                               {"unexplained", edges.exceptions.unexplained}};
    json["beyond_stated_px"] = edges.beyond_stated;
    json["resolved_edge"] = {{"places", edges.resolved.places},
                             {"unresolved", edges.resolved.unresolved},
                             {"truth_ambiguous", edges.resolved.ambiguous},
                             {"p99_px", edges.resolved.p99_px},
                             {"p999_px", edges.resolved.p999_px},
                             {"max_px", edges.resolved.max_px},
                             {"slack", slack_of(light)},
                             {"needs_wider_px", edges.needs_wider},
                             {"as_stated", is_as_stated(light)}};
}

Json to_json(const LightAccuracy& light) {
    Json json;
    json["name"] = light.report.name;
    json["kind"] = shadow::light_kind_row(light.report.kind).name;
    json["state"] = gnomon::to_text(light.report.state);
    json["reason"] = reason_code(light.report.reason);
    json["left_out"] = is_left_out(light.report);
    Json errors;
    add_errors(light, errors);
    // The keys are the same for all; what was not counted is null.
    for (const auto& error : errors.items())
        json[error.key()] = is_left_out(light.report) ? Json(nullptr) : error.value();
    json["predicted_error_px"] = light.report.predicted_error_px;
    json["keeps_max_error"] = light.report.keeps_max_error;
    json["resolved_px"] = light.report.resolved.px;
    json["resolved_m"] = light.report.resolved.m;
    json["keeps_narrowest_caster"] = light.report.resolved.keeps_narrowest;
    json["views"] = light.report.counts.views;
    json["texels"] = light.report.counts.texels;
    json["bytes"] = light.report.counts.bytes;
    json["redrawn_differs_px"] = light.redrawn_differs;
    json["soft"] = light.soft ? to_json(*light.soft) : Json(nullptr);
    json["area"] = light.area ? to_json(*light.area) : Json(nullptr);
    json["tint"] = light.tint ? to_json(*light.tint) : Json(nullptr);
    json["air"] = light.air ? to_json(*light.air) : Json(nullptr);
    json["gpu_us"] = to_json(light.gpu_us);
    json["cpu_us"] = to_json(light.cpu_us);
    return json;
}

}  // namespace

std::string accuracy_json(const Accuracy& accuracy) {
    Json json;
    json["scene"] = accuracy.scene;
    json["device"] = accuracy.device;
    json["size_px"] = {accuracy.size_px.x, accuracy.size_px.y};
    json["trace_s"] = accuracy.trace_s;
    json["gl_complaints"] = accuracy.gl_complaints;
    json["lights"] = Json::array();
    for (const LightAccuracy& light : accuracy.lights) json["lights"].push_back(to_json(light));
    json["unshadowed"] = accuracy.unshadowed;
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
