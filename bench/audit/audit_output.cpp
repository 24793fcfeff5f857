#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/audit/audit.h"
#include "bench/text/printf_string.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;
using oracle::PlacedTriangle;

/// Most lines of other triangles in a table. The JSON has all.
constexpr std::size_t kShownTriangles = 20;

std::string words(const PlacedTriangle& triangle) {
    return triangle.exists() ? formatted("instance %u triangle %u", triangle.instance, triangle.triangle) : "nothing";
}
const char* words(bool lit) { return lit ? "lit" : "dark"; }
const char* verdict(double share, double most) { return share <= most ? "" : "  ABOVE ITS BOUND"; }

std::string line(const Audit& audit, const AuditedLight& light, const ShadowDisagreement& at) {
    return formatted("  %s, %s, pixel %u %u, at %.9g %.9g %.9g m, %s: traced %s (%s), asked %s\n", audit.scene.c_str(),
                     light.name.c_str(), at.at_px.x, at.at_px.y, at.point_ws_m.x, at.point_ws_m.y, at.point_ws_m.z,
                     words(at.surface).c_str(), words(at.traced_lit), words(at.occluder).c_str(),
                     words(at.queried_lit));
}

std::size_t in_one_plane(const Audit& audit) {
    return static_cast<std::size_t>(std::count_if(audit.other_triangles.begin(), audit.other_triangles.end(),
                                                  [](const OtherTriangle& at) { return at.in_one_plane; }));
}

std::string triangle_lines(const Audit& audit) {
    const std::size_t plane = in_one_plane(audit), surface = audit.other_triangles.size() - plane;
    std::string text = formatted("other surface: %zu of %zu pixels, %.5f %%%s; other triangle in one plane: %zu\n",
                                 surface, audit.surface_px, kPercent * other_surface_share(audit),
                                 verdict(other_surface_share(audit), kMostOtherSurface), plane);
    std::size_t shown = 0;
    for (const OtherTriangle& at : audit.other_triangles) {
        if (at.in_one_plane || shown == kShownTriangles) continue;
        text += formatted("  pixel %u %u: drawn %s, traced %s\n", at.at_px.x, at.at_px.y, words(at.drawn).c_str(),
                          words(at.traced).c_str());
        ++shown;
    }
    if (shown < surface) text += formatted("  and %zu more, in the file of --json\n", surface - shown);
    return text;
}

Json to_json(const PlacedTriangle& triangle) {
    if (!triangle.exists()) return nullptr;
    return {{"instance", triangle.instance}, {"triangle", triangle.triangle}};
}

Json to_json(const AuditedLight& light) {
    Json disagreements = Json::array();
    for (const ShadowDisagreement& at : light.disagreements)
        disagreements.push_back({{"pixel", {at.at_px.x, at.at_px.y}},
                                 {"point_m", {at.point_ws_m.x, at.point_ws_m.y, at.point_ws_m.z}},
                                 {"surface", to_json(at.surface)},
                                 {"occluder", to_json(at.occluder)},
                                 {"traced", words(at.traced_lit)},
                                 {"asked", words(at.queried_lit)}});
    return {{"name", light.name},
            {"kind", shadow::light_kind_row(light.kind).name},
            {"compared_px", light.compared_px},
            {"ambiguous_px", light.ambiguous_px},
            {"ambiguous_disagreeing_px", light.ambiguous_disagreeing_px},
            {"disagreeing", disagreeing_share(light)},
            {"disagreements", std::move(disagreements)}};
}

Json to_json(const Audit& audit) {
    Json lights = Json::array(), others = Json::array();
    for (const AuditedLight& light : audit.lights) lights.push_back(to_json(light));
    for (const OtherTriangle& at : audit.other_triangles)
        others.push_back({{"pixel", {at.at_px.x, at.at_px.y}},
                          {"drawn", to_json(at.drawn)},
                          {"traced", to_json(at.traced)},
                          {"in_one_plane", at.in_one_plane}});
    return {{"scene", audit.scene},
            {"camera", audit.camera},
            {"device", audit.device},
            {"size_px", {audit.size_px.x, audit.size_px.y}},
            {"sound", is_sound(audit)},
            {"surface_px", audit.surface_px},
            {"other_surface", other_surface_share(audit)},
            {"other_triangles", std::move(others)},
            {"lights", std::move(lights)}};
}

}  // namespace

std::string audit_table(const Audit& audit) {
    std::string text = formatted("scene   %s\ncamera  %s\npicture %u x %u\n", audit.scene.c_str(), audit.camera.c_str(),
                                 audit.size_px.x, audit.size_px.y);
    text +=
        formatted("%-18s %9s %9s %9s %9s %10s\n", "light", "compared", "differ", "differ%", "ambiguous", "of these");
    for (const AuditedLight& light : audit.lights) {
        text += formatted("%-18.18s %9zu %9zu %9.5f %9zu %10zu%s\n", light.name.c_str(), light.compared_px,
                          light.disagreements.size(), kPercent * disagreeing_share(light), light.ambiguous_px,
                          light.ambiguous_disagreeing_px, verdict(disagreeing_share(light), kMostDisagreeing));
        for (const ShadowDisagreement& at : light.disagreements) text += line(audit, light, at);
    }
    return text + triangle_lines(audit) + "\n";
}

std::string audit_summary(const std::vector<Audit>& audits) {
    std::size_t lights = 0, compared = 0, differ = 0, ambiguous = 0, surfaces = 0, others = 0, planes = 0, unsound = 0;
    double worst_light = 0.0, worst_picture = 0.0;
    for (const Audit& audit : audits) {
        surfaces += audit.surface_px;
        others += audit.other_triangles.size() - in_one_plane(audit);
        planes += in_one_plane(audit);
        worst_picture = std::max(worst_picture, other_surface_share(audit));
        unsound += !is_sound(audit);
        for (const AuditedLight& light : audit.lights) {
            ++lights;
            compared += light.compared_px;
            differ += light.disagreements.size();
            ambiguous += light.ambiguous_px;
            worst_light = std::max(worst_light, disagreeing_share(light));
        }
    }
    const auto percent = [](std::size_t part, std::size_t whole) {
        return whole == 0 ? 0.0 : kPercent * static_cast<double>(part) / static_cast<double>(whole);
    };
    std::string text = formatted(
        "%zu pictures, %zu lights: the two ways differ at %zu of %zu pixels, %.6f %% (of one light %.6f %% "
        "at most, %.6f %% allowed); %zu ambiguous ones are left out\n",
        audits.size(), lights, differ, compared, percent(differ, compared), kPercent * worst_light,
        kPercent * kMostDisagreeing, ambiguous);
    text += formatted(
        "picture and ray show different surfaces at %zu of %zu pixels, %.5f %% (of one picture %.5f %% "
        "at most, %.5f %% allowed), and different triangles of one plane at %zu, %.5f %%\n",
        others, surfaces, percent(others, surfaces), kPercent * worst_picture, kPercent * kMostOtherSurface, planes,
        percent(planes, surfaces));
    return text + (unsound == 0 ? std::string("sound\n") : formatted("%zu pictures are NOT SOUND\n", unsound));
}

std::string audit_json(const std::vector<Audit>& audits) {
    Json json = Json::array();
    for (const Audit& audit : audits) json.push_back(to_json(audit));
    return Json{{"audits", std::move(json)}}.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
