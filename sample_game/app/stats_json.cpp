#include "sample_game/app/stats_json.h"

#include <span>

#include "gnomon/light.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::game {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the value; null, never 0, where it is unknown.
Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

void add_why(const Why& why, Json& json) {
    json["receivers"] = why.receivers;
    json["casters"] = why.casters;
    json["bytes_saved"] = why.bytes_saved;
    json["stale_px"] = why.stale_px;
    json["saved_us"] = or_null(why.saved_us);
}

/// Returns a light's reasons and savings, and those of its views.
Json why_stats(const FrameReport& report, const LightReport& light) {
    Json why, views = Json::array();
    add_why(light.why, why);
    why["display_steps"] = or_null(light.why.display_steps);
    for (const ViewReport& view : report.views_of(light)) {
        Json entry = {{"view", view.layer}, {"state", to_text(view.state)}, {"reason", reason_code(view.reason)}};
        add_why(view.why, entry);
        views.push_back(std::move(entry));
    }
    why["views"] = std::move(views);
    return why;
}

Json budget_stats(const BudgetReport& budget) {
    return {{"wanted_px", budget.wanted_px},
            {"px", budget.px},
            {"wanted_views", budget.wanted_views},
            {"views", budget.views},
            {"plain", budget.plain},
            {"refresh_frames", budget.refresh_frames},
            {"wanted_bytes", budget.wanted_bytes},
            {"bytes", budget.bytes},
            {"wanted_us", budget.wanted_us},
            {"model_us", budget.us},
            {"harm", budget.harm}};
}

Json kept_stats(const KeptReport& kept) {
    return {{"reason", reason_code(kept.reason)}, {"bytes", kept.bytes}, {"saved_us", or_null(kept.saved_us)}};
}

Json filter_stats(const FilterReport& filter) {
    return {{"name", to_text(filter.filter)},
            {"reason", reason_code(filter.reason)},
            {"usual_error_px", or_null(filter.usual_error_px)},
            {"usual_resolved_px", or_null(filter.usual_resolved_px)}};
}

Json parts_stats(const BytesByPart& parts, std::uint64_t kept_bytes) {
    return {{"depths", parts.depths}, {"triangles", parts.triangles},         {"prefiltered", parts.prefiltered},
            {"bounds", parts.bounds}, {"static_copies", parts.static_copies}, {"tints", parts.tints},
            {"kept", kept_bytes}};
}

/// Adds a light's memory to that of all lights.
void add_parts(const LightReport& light, BytesByPart& sum, std::uint64_t& kept_bytes) {
    sum.depths += light.counts.parts.depths;
    sum.triangles += light.counts.parts.triangles;
    sum.prefiltered += light.counts.parts.prefiltered;
    sum.bounds += light.counts.parts.bounds;
    sum.static_copies += light.counts.parts.static_copies;
    sum.tints += light.counts.parts.tints;
    kept_bytes += light.kept.bytes;
}

Json light_stats(const FrameReport& report, const LightReport& light) {
    return {{"name", light.name},
            {"kind", to_text(light.kind)},
            {"state", to_text(light.state)},
            {"reason", reason_code(light.reason)},
            {"predicted_error_px", light.predicted_error_px},
            {"keeps_max_error", light.keeps_max_error},
            {"resolved_px", light.resolved.px},
            {"resolved_m", light.resolved.m},
            {"keeps_narrowest_caster", light.resolved.keeps_narrowest},
            {"filter", light.filter.filter == ShadowFilter::automatic ? Json(nullptr) : filter_stats(light.filter)},
            {"views", light.counts.views},
            {"views_drawn", light.counts.views_drawn},
            {"texels", light.counts.texels},
            {"bytes", light.counts.bytes},
            {"bytes_by_part", parts_stats(light.counts.parts, light.kept.bytes)},
            {"draws", light.counts.draws},
            {"draw_commands", light.counts.draw_commands},
            {"clears", light.counts.clears},
            {"triangles", light.counts.triangles},
            {"full_triangles", light.counts.full_triangles},
            {"cpu_us", light.cpu_us},
            {"gpu_us", or_null(light.gpu_us)},
            {"kept", light.kept.bytes > 0 ? kept_stats(light.kept) : Json(nullptr)},
            {"budget", light.budget ? budget_stats(*light.budget) : Json(nullptr)},
            {"why", why_stats(report, light)}};
}

}  // namespace

Json frame_stats(const FrameReport& report, std::uint64_t index, double time_s) {
    std::uint64_t views = 0, draws = 0, draw_commands = 0, clears = 0, triangles = 0, full_triangles = 0, bytes = 0;
    BytesByPart parts;
    std::uint64_t kept_bytes = 0;
    Json lights = Json::array(), dropped = Json::array();
    for (const LightReport& light : report.lights) {
        views += light.counts.views_drawn;
        draws += light.counts.draws;
        draw_commands += light.counts.draw_commands;
        clears += light.counts.clears;
        triangles += light.counts.triangles;
        full_triangles += light.counts.full_triangles;
        bytes += light.counts.bytes;
        add_parts(light, parts, kept_bytes);
        lights.push_back(light_stats(report, light));
    }
    for (const DroppedEntity& entity : report.dropped)
        dropped.push_back({{"name", entity.name}, {"reason", reason_code(entity.reason)}});
    Json shadow = {{"cpu_us", report.shadow_cpu_us},
                   {"gpu_us", or_null(report.shadow_gpu_us)},
                   {"still", report.still},
                   {"views", views},
                   {"draws", draws},
                   {"draw_commands", draw_commands},
                   {"clears", clears},
                   {"triangles", triangles},
                   {"full_triangles", full_triangles},
                   {"bytes", bytes},
                   {"bytes_by_part", parts_stats(parts, kept_bytes)},
                   {"ray_bytes", report.rays.bytes},
                   {"ray_picture_bytes", report.rays.list_bytes + report.rays.place_bytes},
                   {"sheet_bytes", report.rays.sheet_bytes}};
    return {{"index", index},
            {"time_s", time_s},
            {"cpu_us", report.cpu_us},
            {"gpu_us", or_null(report.gpu_us)},
            {"programs_compiled", report.programs_compiled},
            {"samples", report.samples},
            {"shadow", std::move(shadow)},
            {"lights", std::move(lights)},
            {"dropped", std::move(dropped)}};
}

void StatsFile::add(const FrameReport& report, std::uint64_t index, double time_s, const GameState* game) {
    frames_.push_back(frame_stats(report, index, time_s));
    if (!game) return;
    frames_.back()["game"] = {{"phase", to_text(game->phase)},
                              {"time_s", game->time_s()},
                              {"feet_m", {game->feet_m.x, game->feet_m.y, game->feet_m.z}},
                              {"light", game->light},
                              {"seen", game->seen}};
}

std::optional<Error> StatsFile::write(const std::filesystem::path& file) const {
    Json document = {{"device", device_}, {"frames", frames_}};
    if (!truth_.is_null()) document["truth"] = truth_;
    constexpr int kIndent = 1;
    // Names come from files: text that is not UTF-8 is replaced, not thrown at the user.
    const std::string text = document.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
    return write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace gnomon::game
