#include <nlohmann/json.hpp>

#include "bench/common/units.h"
#include "bench/embed/embed_costs.h"
#include "bench/text/printf_string.h"

namespace gnomon::bench {
namespace {

using Way = EmbedWay;

constexpr std::array<EmbedWayInfo, kEmbedWays> kWays = {{
    {"passes_without", Way::count, "light passes of gnomon::Frame, without shadows"},
    {"passes", Way::passes_without, "the same passes with shadows"},
    {"mask", Way::passes, "gnomon::Shadows::render() with a mask"},
    {"shader_without", Way::count, "a deferred shader of all lights, without shadows"},
    {"lookup", Way::passes, "the same shader with lookups of these lights' kind and filter"},
    {"lookup_all", Way::passes, "the same shader with lookups of every kind and usual filter"},
    {"moving_frame", Way::count, "every light moves: a whole frame of gnomon::Frame"},
    {"moving_mask", Way::moving_frame, "every light moves: surfaces, mask, a shader that reads it"},
    {"moving_lookup", Way::moving_frame, "every light moves: surfaces, maps, a shader with lookups"},
}};

/// Returns a way's figures. Software devices give the process's time on all cores, which other processes leave as it
/// is.
std::string figures(const EmbedRow::Times& times, bool is_software) {
    std::string text = formatted("%9.3f %9.3f", (is_software ? times.device.cpu_us : times.device.us).median / kUsPerMs,
                                 times.call_us.median / kUsPerMs);
    const Spread& ratio = is_software ? times.device.cpu_ratio : times.device.ratio;
    return text + (ratio.count > 0 ? formatted("  x %5.2f (%.2f-%.2f)", ratio.median, ratio.min, ratio.max) : "");
}

}  // namespace

const EmbedWayInfo& info_of(EmbedWay way) { return kWays[static_cast<std::size_t>(way)]; }

std::string embed_legend() {
    std::string text =
        "ms: median of what the device takes; software devices: of the process's time on all cores. call ms: the "
        "calling thread's time on the processor until the "
        "call returns. x: median (min-max) of one ratio per round. Maps of lookups have edges of powers of two.\n";
    for (const EmbedWayInfo& way : kWays)
        text += formatted("%-16s %s%s%s\n", way.key, way.words, way.base == Way::count ? "" : "; x: of ",
                          way.base == Way::count ? "" : info_of(way.base).key);
    return text;
}

std::string embed_table(const EmbedCosts& costs) {
    std::string text = formatted("scene   %s\ndevice  %s\npicture %u x %u\ntimes   %s\n", costs.scene.c_str(),
                                 costs.device.c_str(), costs.size_px.x, costs.size_px.y, costs.method.c_str());
    for (const EmbedRow& row : costs.rows) {
        text += formatted(
            "\n%u %s, filter %s (%s), %u maps; %.1f %% of the surfaces in shadow, mask and lookup differ on "
            "%.3f %%\n%-16s %9s %9s\n",
            row.lights, row.kind.c_str(), row.filter.c_str(), row.used_filter.c_str(), row.maps, 100.0 * row.shadowed,
            100.0 * row.differs, "", "ms", "call ms");
        for (std::size_t w = 0; w < kEmbedWays; ++w) {
            if (row.ways[w].device.us.count == 0) continue;
            text += formatted("%-16s %s\n", kWays[w].key, figures(row.ways[w], costs.is_software).c_str());
        }
    }
    text += "\nWhat the rows and columns mean: bench embed --help\n";
    if (costs.whole_text_compile_s > 0.0)
        text += formatted("the shader of lookup_all compiled in %.1f s\n", costs.whole_text_compile_s);
    if (costs.starved > 0) text += formatted("%u calls during which the device may have been idle\n", costs.starved);
    return text;
}

std::string embed_json(const EmbedCosts& costs) {
    nlohmann::ordered_json json;
    json["scene"] = costs.scene;
    json["device"] = costs.device;
    json["is_software"] = costs.is_software;
    json["size_px"] = {costs.size_px.x, costs.size_px.y};
    json["method"] = costs.method;
    json["starved"] = costs.starved;
    json["whole_text_compile_s"] = costs.whole_text_compile_s;
    json["rows"] = nlohmann::ordered_json::array();
    for (const EmbedRow& row : costs.rows) {
        nlohmann::ordered_json& out = json["rows"].emplace_back();
        out = {{"kind", row.kind}, {"filter", row.filter},     {"used_filter", row.used_filter}, {"lights", row.lights},
               {"maps", row.maps}, {"shadowed", row.shadowed}, {"differs", row.differs}};
        for (std::size_t w = 0; w < kEmbedWays; ++w) {
            const EmbedRow::Times& times = row.ways[w];
            if (times.device.us.count == 0) continue;
            nlohmann::ordered_json& way = out[kWays[w].key];
            way["us"] = to_json(times.device.us);
            way["cpu_us"] = to_json(times.device.cpu_us);
            way["call_us"] = to_json(times.call_us);
            if (times.device.ratio.count == 0) continue;
            way["ratio"] = to_json(times.device.ratio);
            way["cpu_ratio"] = to_json(times.device.cpu_ratio);
        }
    }
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
