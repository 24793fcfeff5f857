#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "bench/common/units.h"
#include "bench/scaling/light_count.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kCellLength = 96;

std::string milliseconds(const Spread& us) {
    char text[kCellLength];
    std::snprintf(text, sizeof text, "%.2f (%.2f–%.2f)", us.median / kUsPerMs, us.min / kUsPerMs, us.max / kUsPerMs);
    return text;
}

std::string number(double value, const char* format) {
    char text[kCellLength];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string pair_of(std::uint32_t on, std::uint32_t off) { return std::to_string(on) + " / " + std::to_string(off); }

std::string table_line(std::initializer_list<std::string> cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
}

std::string counts_of(const DemandRow& row, DemandMotion motion) {
    const DemandFigures &on = row.of(motion, DemandMode::economy), &off = row.of(motion, DemandMode::redrawn);
    return table_line({std::to_string(row.lights), std::to_string(row.shadowed), std::to_string(on.lights_given),
                       std::to_string(on.views), pair_of(on.views_drawn, off.views_drawn), pair_of(on.draws, off.draws),
                       number(static_cast<double>(on.bytes) / kBytesPerMiB, "%.1f")});
}

std::string times_of(const DemandRow& row, DemandMotion motion) {
    const DemandFigures &none = row.of(motion, DemandMode::without), &on = row.of(motion, DemandMode::economy),
                        &off = row.of(motion, DemandMode::redrawn);
    return table_line({std::to_string(row.lights), milliseconds(none.shadow_cpu_us), milliseconds(on.shadow_cpu_us),
                       milliseconds(off.shadow_cpu_us), milliseconds(none.frame_us), milliseconds(on.frame_us),
                       milliseconds(off.frame_us),
                       number(on.frame_ratio, "%.2f") + " / " + number(off.frame_ratio, "%.2f")});
}

nlohmann::ordered_json to_json(const Spread& s) {
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}, {"count", s.count}};
}

nlohmann::ordered_json to_json(const DemandFigures& f) {
    return {{"frame_us", to_json(f.frame_us)},
            {"shadow_cpu_us", to_json(f.shadow_cpu_us)},
            {"frame_ratio", f.frame_ratio},
            {"lights_given", f.lights_given},
            {"views", f.views},
            {"views_drawn", f.views_drawn},
            {"draws", f.draws},
            {"bytes", f.bytes},
            {"passes", f.passes}};
}

}  // namespace

std::string demand_markdown(const Demand& demand) {
    std::string text = "Device: " + demand.device + ". Picture: " + std::to_string(demand.size_px.x) + " × " +
                       std::to_string(demand.size_px.y) + ". " + std::to_string(demand.rounds) + " rounds of " +
                       std::to_string(demand.frames) + " frames.\n";
    for (const DemandMotion motion : kDemandMotions) {
        text += "\n### " + std::string(to_text(motion)) + "\n\n";
        text +=
            "| lights | shadowed | with views | views | drawn on / off | draws on / off | MiB |\n"
            "|---|---|---|---|---|---|---|\n";
        for (const DemandRow& row : demand.rows) text += counts_of(row, motion);
        text +=
            "\n| lights | stages, ms: none | on | off | frame, ms: none | on | off | × none: on / off |\n"
            "|---|---|---|---|---|---|---|---|\n";
        for (const DemandRow& row : demand.rows) text += times_of(row, motion);
    }
    text += "\n### programs\n\n| lights | without shadows | with |\n|---|---|---|\n";
    for (const DemandRow& row : demand.rows)
        text += "| " + std::to_string(row.lights) + " | " + std::to_string(row.programs_without) + " | " +
                std::to_string(row.programs) + " |\n";
    return text;
}

std::string demand_json(const Demand& demand) {
    nlohmann::ordered_json json;
    json["device"] = demand.device;
    json["size_px"] = {demand.size_px.x, demand.size_px.y};
    json["rounds"] = demand.rounds;
    json["frames"] = demand.frames;
    json["rows"] = nlohmann::ordered_json::array();
    for (const DemandRow& row : demand.rows)
        for (const DemandMotion motion : kDemandMotions)
            for (const DemandMode mode : kDemandModes) {
                nlohmann::ordered_json entry{
                    {"lights", row.lights},     {"shadowed", row.shadowed},  {"programs_without", row.programs_without},
                    {"programs", row.programs}, {"motion", to_text(motion)}, {"mode", to_text(mode)}};
                entry.update(to_json(row.of(motion, mode)));
                json["rows"].push_back(std::move(entry));
            }
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
