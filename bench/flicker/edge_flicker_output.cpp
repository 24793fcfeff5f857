#include <nlohmann/json.hpp>

#include "bench/flicker/edge_flicker.h"
#include "bench/text/printf_string.h"

namespace gnomon::bench {
namespace {

/// Returns what follows the key: "on" of "antialias=on".
std::string value_of(const std::string& setting) { return setting.substr(setting.find('=') + 1); }

std::string line_of(const EdgeFlicker& r) {
    if (!r.reason.empty()) return formatted("%-6s %-14.14s %s\n", r.path.c_str(), r.light.c_str(), r.reason.c_str());
    const oracle::AreaFlicker &a = r.compared[0], &b = r.compared[1];
    return formatted("%-6s %-14.14s %6u %6zu %6.3f %7.4f %7.4f %6.3f %6.3f %6.3f %8.5f %8.5f %4zu %4zu %4zu %4zu\n",
                     r.path.c_str(), r.light.c_str(), r.points, b.pairs, b.truth, a.mean, b.mean, r.ratio(), a.p99,
                     b.p99, a.uncrossed_mean, b.uncrossed_mean, b.left_out[0], b.left_out[1], b.left_out[2],
                     b.left_out[3]);
}

nlohmann::ordered_json flicker_json(const oracle::AreaFlicker& f) {
    return {{"mean", f.mean}, {"p99", f.p99}, {"uncrossed_mean", f.uncrossed_mean}};
}

nlohmann::ordered_json row_json(const EdgeFlicker& r) {
    const oracle::AreaFlicker& pairs = r.compared[0];
    nlohmann::ordered_json json{{"path", r.path},
                                {"light", r.light},
                                {"kind", r.kind},
                                {"reason", r.reason},
                                {"points", r.points},
                                {"pairs", pairs.pairs},
                                {"truth", pairs.truth},
                                {"uncrossed", pairs.uncrossed},
                                {"outside", pairs.left_out[0]},
                                {"hidden", pairs.left_out[1]},
                                {"unreached", pairs.left_out[2]},
                                {"partial", pairs.left_out[3]},
                                {"compared", {flicker_json(r.compared[0]), flicker_json(r.compared[1])}}};
    json["ratio"] = pairs.mean > 0.0 ? nlohmann::ordered_json(r.ratio()) : nlohmann::ordered_json();
    return json;
}

}  // namespace

std::string edge_flicker_table(const EdgeFlickers& f) {
    const ComparedSettings& compared = f.options.compared;
    const std::string a = value_of(compared[0]), b = value_of(compared[1]);
    std::string text = formatted(
        "scene   %s\ndevice  %s\npicture %u x %u, %u frames per path, %.3g px per frame; jitter: %u phases\n"
        "lights  %s, %s\n\n",
        f.scene.c_str(), f.device.c_str(), f.size_px.x, f.size_px.y, f.options.frames, f.options.step_px, kJitterPhases,
        compared[0].c_str(), compared[1].c_str());
    text += formatted("%-6s %-14s %6s %6s %6s %7.7s %7.7s %6s %6.6s %6.6s %8.8s %8.8s %4s %4s %4s %4s\n", "path",
                      "light", "points", "pairs", "truth", a.c_str(), b.c_str(), "ratio", a.c_str(), b.c_str(),
                      a.c_str(), b.c_str(), "out", "hid", "face", "part");
    text += formatted("%42s %15s %20s %17s %19s\n", "", "mean", "p99", "no edge", "pairs left out");
    for (const EdgeFlicker& row : f.rows) text += line_of(row);
    return text + "\nWhat the columns mean: bench stability --help\n";
}

std::string edge_flicker_legend() {
    return "Columns of the table of --area:\n"
           "  points     of the world beside edges of the light's shadows, each looked up in the nearest pixel\n"
           "  pairs      of frames in a row in which the point's pixel shows its surface alone, crossed in either\n"
           "  truth      mean change of the lit share of the pixel's area\n"
           "  mean, p99  |change of visibility - change of that share|; ratio: of the means\n"
           "  no edge    the same mean over pairs that no edge crosses\n"
           "  left out   pairs with the point out of the picture, hidden, in a pixel that the light does not reach or\n"
           "             face, or in part of a pixel, in one of the frames\n";
}

std::string edge_flicker_json(const EdgeFlickers& f) {
    nlohmann::ordered_json json;
    json["scene"] = f.scene;
    json["device"] = f.device;
    json["size_px"] = {f.size_px.x, f.size_px.y};
    json["frames"] = f.options.frames;
    json["jitter_phases"] = kJitterPhases;
    json["step_px"] = f.options.step_px;
    json["area_side"] = f.options.area_side;
    json["compared"] = f.options.compared;
    json["rows"] = nlohmann::ordered_json::array();
    for (const EdgeFlicker& row : f.rows) json["rows"].push_back(row_json(row));
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
