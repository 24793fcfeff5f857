#include <nlohmann/json.hpp>

#include "bench/compare/filter_comparison.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Spread& spread) {
    if (spread.count == 0) return nullptr;
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"count", spread.count}};
}

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json whole(const Figure& count) { return count ? Json(static_cast<std::uint64_t>(*count)) : Json(nullptr); }

Json figures_json(const FilterRows& rows, std::size_t resolution, std::size_t light) {
    Json all = Json::array();
    for (std::size_t v = 0; v < rows.variants.size(); ++v) {
        const RowFigures& f = rows.figures[resolution][v][light];
        all.push_back({{"name", rows.variants[v].name},
                       {"filter", rows.variants[v].row->name},
                       {"taps", whole(f.taps)},
                       {"bytes", whole(f.bytes)},
                       {"wrong", to_json(f.wrong)},
                       {"mean_error", to_json(f.mean_error)},
                       {"disk_error", to_json(f.disk_error)},
                       {"drawn", to_json(f.gpu_ratio)},
                       {"kept", to_json(f.kept_ratio)}});
    }
    return all;
}

Json fronts_json(const FilterRows& rows, std::size_t resolution, std::size_t light) {
    Json all = Json::array();
    for (const RowTruth truth : kRowTruths)
        for (const RowCost cost : kRowCosts) {
            Json best = Json::array(), beaten = Json::array();
            const std::vector<std::uint8_t> front = rows.front(resolution, light, truth, cost);
            for (std::size_t v = 0; v < front.size(); ++v)
                if (rows.is_judged(resolution, v, light, truth))
                    (front[v] ? best : beaten).push_back(rows.variants[v].name);
            all.push_back({{"truth", truth == RowTruth::point ? "point" : "disk"},
                           {"cost", cost == RowCost::drawn ? "drawn" : "kept"},
                           {"front", best},
                           {"beaten", beaten}});
        }
    return all;
}

}  // namespace

std::string filter_rows_json(const FilterRows& rows) {
    Json json;
    json["scene"] = rows.scene;
    json["device"] = rows.device;
    json["size_px"] = {rows.size_px.x, rows.size_px.y};
    json["disk"] = disk_source();
    json["lights"] = Json::array();
    for (std::size_t l = 0; l < rows.lights.size(); ++l)
        for (std::size_t r = 0; r < rows.resolutions_px.size(); ++r)
            json["lights"].push_back({{"name", rows.lights[l]},
                                      {"resolution_px", rows.resolutions_px[r]},
                                      {"rows", figures_json(rows, r, l)},
                                      {"fronts", fronts_json(rows, r, l)}});
    json["never_best"] = rows.never_best();
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
