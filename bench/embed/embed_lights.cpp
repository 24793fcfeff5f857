#include "bench/embed/embed_lights.h"

#include <cmath>
#include <numbers>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {
namespace {

constexpr double kMove_m = 0.01, kMove_rad = 0.002;
constexpr std::uint32_t kMoves = 16;                   // steps after which a lamp is back on its ring
constexpr double kLampHeight = 0.65, kLampRing = 0.4;  // shares of the box, and of half its sides
constexpr double kSunClimb_rad = 0.9, kFirst_rad = 0.4;
constexpr double kTurn_rad = 2.0 * std::numbers::pi * 5.0 / 8.0;  // from light to light: neighbours lie far apart
constexpr float kCone_rad = 0.75f, kLamp_cd = 400.0f, kSun_lx = 60.0f;

}  // namespace

std::vector<EmbedCase> embed_cases(bool quick) {
    using enum LightKind;
    constexpr EmbedCase kKinds[] = {{directional, "suns", ShadowFilter::automatic, &LookupOptions::suns},
                                    {spot, "spots", ShadowFilter::automatic, &LookupOptions::spots},
                                    {point, "points", ShadowFilter::automatic, &LookupOptions::points}};
    std::vector<EmbedCase> cases;
    for (const EmbedCase& kind : kKinds) {
        cases.push_back(kind);
        if (quick && kind.part != &LookupOptions::spots) continue;
        cases.push_back(kind);
        cases.back().filter = ShadowFilter::pcf_grid;
    }
    return cases;
}

std::string EmbedCase::name() const { return std::string(kind_name) + " " + filter_name(filter); }

std::string filter_name(ShadowFilter filter) {
    return filter == ShadowFilter::automatic ? "default" : std::string(shadow::filter_row(filter).name);
}

math::Aabb bounds_of(const SceneSnapshot& scene) {
    math::Aabb bounds;
    for (const InstanceItem& item : scene.instances) bounds = math::merged(bounds, item.bounds_ws);
    return bounds;
}

PlacedLight placed_light(const EmbedCase& of, std::uint32_t i, std::uint32_t turn, const math::Aabb& bounds) {
    const double angle = kFirst_rad + kTurn_rad * i + kMove_rad * turn;
    const glm::dvec3 ring(std::cos(angle), 0.0, std::sin(angle));
    const bool is_sun = light_facts(of.kind).parallel;
    PlacedLight place;
    place.light.kind = of.kind;
    place.light.intensity = is_sun ? kSun_lx : kLamp_cd;
    place.light.outer_cone_rad = kCone_rad;
    place.light.source_radius_m = of.settings.source_radius_m;
    place.light.sun_radius_rad = of.settings.sun_radius_rad;
    place.shadow = of.settings.shadow;
    place.shadow.filter = of.filter;
    place.tuning = of.settings.tuning;
    place.tuning.reuse.keep_visibility = false;  // masks and lookups do not keep what pixels saw
    const glm::dvec3 middle = math::centre(bounds), half = 0.5 * (bounds.max - bounds.min);
    place.position_m = middle + kLampRing * ring * half + glm::dvec3(kMove_m * (turn % kMoves), 0.0, 0.0);
    place.position_m.y = bounds.min.y + kLampHeight * (bounds.max.y - bounds.min.y);
    place.direction = is_sun ? -(std::cos(kSunClimb_rad) * ring + glm::dvec3(0.0, std::sin(kSunClimb_rad), 0.0))
                             : glm::dvec3(middle.x, bounds.min.y, middle.z) - place.position_m;
    return place;
}

}  // namespace gnomon::bench
