#include "systems/extract/source_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace gnomon {
namespace {

/// Returns a place of a surface: `facing` is the cosine at the source times the distance.
SourcePlace on_surface(const glm::dvec3& way_m, double facing_m) {
    const double square_m2 = glm::dot(way_m, way_m);
    if (!(facing_m > 0.0) || !(square_m2 > 0.0)) return {};
    return {way_m * kBeforeSource, facing_m / (square_m2 * std::sqrt(square_m2))};
}

SourcePlace on_plane(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec2& across_m) {
    const glm::dmat3& axes = light.rotation_ws;
    return on_surface(to_middle_m + axes[0] * across_m.x + axes[1] * across_m.y, glm::dot(axes[2], to_middle_m));
}

/// Returns a direction within the cone around a sphere, and the sphere's near side in it.
SourcePlace on_sphere(double radius_m, const glm::dvec3& to_middle_m, const glm::dvec2& at) {
    const double distance_m = glm::length(to_middle_m);
    if (!(distance_m > radius_m)) return {};
    const glm::dvec3 toward = to_middle_m / distance_m;
    const glm::dvec3 helper = std::abs(toward.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(toward, helper)), up = glm::cross(toward, right);
    const double sine = radius_m / distance_m, cap = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
    const double below = std::min(glm::dot(at, at), 1.0) * cap;  // 1 - cosine
    const glm::dvec2 across = at * std::sqrt(cap * (2.0 - below));
    const double beside_m2 = distance_m * distance_m * below * (2.0 - below);
    const double way_m = distance_m * (1.0 - below) - std::sqrt(std::max(radius_m * radius_m - beside_m2, 0.0));
    return {(toward * (1.0 - below) + right * across.x + up * across.y) * (way_m * kBeforeSource), 1.0};
}

SourcePlace on_tube(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec2& at) {
    const double radius_m = light.source_radius_m;
    const glm::dvec3& axis = light.rotation_ws[0];
    const glm::dvec3 to_axis_m = to_middle_m - axis * glm::dot(to_middle_m, axis);
    const double aside_m = glm::length(to_axis_m);
    if (!(aside_m > radius_m)) return {};
    const glm::dvec3 nearest = -to_axis_m / aside_m, around = glm::cross(axis, nearest);
    const double arc_rad = std::acos(radius_m / aside_m), turn_rad = arc_rad * at.y;
    const glm::dvec3 normal = nearest * std::cos(turn_rad) + around * std::sin(turn_rad);
    SourcePlace place =
        on_surface(to_middle_m + axis * (0.5 * static_cast<double>(light.width_m) * at.x) + normal * radius_m,
                   aside_m * std::cos(turn_rad) - radius_m);
    return place;
}

/// Returns how far the source reaches from its middle along a direction, metres.
double extent_m(const LightItem& light, const glm::dvec3& n) {
    const glm::dmat3& axes = light.rotation_ws;
    const double radius_m = light.source_radius_m;
    const auto across = [&](const glm::dvec3& axis) {
        const double along = glm::dot(n, axis);
        return radius_m * std::sqrt(std::max(1.0 - along * along, 0.0));
    };
    switch (light_facts(light.kind).shape) {
        case SourceShape::facing:
            return 0.0;
        case SourceShape::rectangle:
            return 0.5 * (static_cast<double>(light.width_m) * std::abs(glm::dot(n, axes[0])) +
                          static_cast<double>(light.height_m) * std::abs(glm::dot(n, axes[1])));
        case SourceShape::disc:
            return across(axes[2]);
        case SourceShape::sphere:
            return radius_m;
        case SourceShape::tube:
            return 0.5 * static_cast<double>(light.width_m) * std::abs(glm::dot(n, axes[0])) + across(axes[0]);
    }
    return 0.0;
}

}  // namespace

SourcePlace source_place(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec2& at) {
    switch (light_facts(light.kind).shape) {
        case SourceShape::facing:
            return {};
        case SourceShape::rectangle:
            return on_plane(light, to_middle_m, 0.5 * at * glm::dvec2(light.width_m, light.height_m));
        case SourceShape::disc:
            return on_plane(light, to_middle_m, at * static_cast<double>(light.source_radius_m));
        case SourceShape::sphere:
            return on_sphere(light.source_radius_m, to_middle_m, at);
        case SourceShape::tube:
            return on_tube(light, to_middle_m, at);
    }
    return {};
}

bool sees_source(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec3& normal) {
    const SourceShape shape = light_facts(light.kind).shape;
    const glm::dvec3 axis = light.rotation_ws[0];
    const glm::dvec3 way_m =
        shape == SourceShape::tube ? to_middle_m - axis * glm::dot(to_middle_m, axis) : to_middle_m;
    const bool round = shape == SourceShape::tube || shape == SourceShape::sphere;
    if (round && !(glm::length(way_m) > static_cast<double>(light.source_radius_m))) return false;
    return is_shone_on(light, to_middle_m) && glm::dot(normal, to_middle_m) + extent_m(light, normal) > 0.0;
}

glm::dvec2 disk_to_square(const glm::dvec2& disk) {
    const double radius = glm::length(disk);
    const bool wide = std::abs(disk.x) > std::abs(disk.y);
    const double along = wide ? disk.x : disk.y, across = wide ? disk.y : disk.x;
    if (along == 0.0) return {0.0, 0.0};
    const double aside = radius * std::atan(across / std::abs(along)) / glm::quarter_pi<double>();
    const double ahead = std::copysign(radius, along);
    return wide ? glm::dvec2(ahead, aside) : glm::dvec2(aside, ahead);
}

}  // namespace gnomon
