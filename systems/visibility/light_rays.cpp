#include "systems/visibility/light_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <numeric>

#include "engine/math/finite.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/source_place.h"

namespace gnomon::visibility {
namespace {

/// Returns sample i of n on a spiral with the golden angle: equal areas, evenly distributed (Vogel 1979).
glm::dvec2 on_spiral(std::size_t i, std::size_t n) {
    const double golden_rad = glm::pi<double>() * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(n));
    const double angle_rad = golden_rad * static_cast<double>(i);
    return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)};
}

/// Returns a step close to n / golden ratio that visits all n places before it repeats one.
std::size_t even_step(std::size_t n) {
    auto step = static_cast<std::size_t>(std::lround(static_cast<double>(n) * 0.5 * (std::sqrt(5.0) - 1.0)));
    while (std::gcd(step, n) != 1) ++step;
    return step;
}

std::array<glm::dvec3, 2> axes_across(const glm::dvec3& unit) {
    const glm::dvec3 helper = std::abs(unit.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 first = glm::normalize(glm::cross(unit, helper));
    return {first, glm::cross(unit, first)};
}

}  // namespace

void fill_disk(std::size_t count, std::vector<glm::dvec2>& disk) {
    if (disk.size() == count) return;
    disk.clear();
    for (std::size_t i = 0; i < count; ++i) disk.push_back(on_spiral(i, count));
}

LightRays::LightRays(const LightItem& light, std::span<const glm::dvec2> disk)
    : light_(light), disk_(disk), partner_(even_step(disk.size())) {
    const LightFacts& facts = light_facts(light.kind);
    const auto size = static_cast<double>(std::clamp(source_extent(light), 0.0f, facts.most_source_size));
    area_ = facts.area();
    square_ = facts.shape == SourceShape::rectangle || facts.shape == SourceShape::tube;
    size_ = facts.parallel ? std::tan(size) : size;
    sized_ = size_ > 0.0;
    last_ = facts.parallel ? std::numeric_limits<double>::infinity() : 1.0;
    outer_cosine_ = std::cos(light.outer_cone_rad);
    const glm::dvec3& back = light.rotation_ws[2];
    usable_ = math::is_finite(light.position_ws_m) && math::is_finite(back) && glm::dot(back, back) > 0.0;
}

bool LightRays::reaches(const glm::dvec3& point_ws_m) const {
    const LightFacts& facts = light_facts(light_.kind);
    if (facts.parallel) return true;
    const glm::dvec3 to_light = light_.position_ws_m - point_ws_m;
    const double distance_m = glm::length(to_light);
    if (!(distance_m > 0.0) || (light_.range_m > 0.0 && distance_m > light_.range_m)) return false;
    if (!facts.cone) return is_shone_on(light_, to_light);
    const glm::dvec3& back = light_.rotation_ws[2];
    return glm::dot(to_light, back) >= outer_cosine_ * distance_m * glm::length(back);
}

Reach LightRays::source_ray(const Place& place, const glm::dvec3& middle, const glm::dvec2& at, LightRay& ray) const {
    const SourcePlace source = source_place(light_, middle, at);
    ray.along = source.way_m;
    const double distance_m = glm::length(ray.along);
    const double cosine = place.radius_m > 0.0 || place.normal_ws == glm::dvec3(0.0)
                              ? 1.0
                              : glm::dot(place.normal_ws, ray.along) / distance_m;
    ray.weight = source.weight * cosine;
    if (!(ray.weight > 0.0) || !math::is_finite(ray.along) || !math::is_finite(ray.from_ws_m)) return Reach::none;
    return reaches(ray.from_ws_m) ? Reach::ray : Reach::none;
}

Reach LightRays::ray(const Place& place, std::size_t sample, LightRay& ray) const {
    if (!usable_ || !math::is_finite(place.at_ws_m)) return Reach::none;
    const bool sun = light_facts(light_.kind).parallel;
    glm::dvec3 middle = to_light(light_, place.at_ws_m);
    ray.from_ws_m = place.at_ws_m;
    const bool sphere = place.radius_m > 0.0;
    if (sphere || sized_) {
        const double distance = glm::length(middle);
        if (sphere && !sun && distance <= place.radius_m) return reaches(place.at_ws_m) ? Reach::all : Reach::none;
        if (!(distance > 0.0)) return Reach::none;
        const glm::dvec3 toward = middle / distance;
        const auto [right, up] = axes_across(toward);
        if (sphere) {
            const glm::dvec2& at = disk_[sample];
            const double height = std::sqrt(std::max(1.0 - glm::dot(at, at), 0.0));
            ray.from_ws_m += place.radius_m * (right * at.x + up * at.y + toward * height);
            if (!sun) middle = light_.position_ws_m - ray.from_ws_m;
        }
        const glm::dvec2& at = disk_[sample * partner_ % disk_.size()];
        if (area_) return source_ray(place, middle, square_ ? disk_to_square(at) : at, ray);
        ray.along = middle + size_ * (right * at.x + up * at.y);
        if (weighted(place) && !(glm::dot(ray.along, place.normal_ws) > 0.0)) return Reach::none;
    } else {
        ray.along = middle;
    }
    if (!math::is_finite(ray.along) || !math::is_finite(ray.from_ws_m)) return Reach::none;
    return reaches(ray.from_ws_m) ? Reach::ray : Reach::none;
}

}  // namespace gnomon::visibility
