#include "bench/flicker/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "systems/extract/volumes.h"

namespace gnomon::bench {
namespace {

constexpr double kTurn_rad = 6.283185307179586;
constexpr double kPan_rad = kTurn_rad / 6.0;  // over the whole path, half to each side
// Way of the walk, as a share of the distance to what is seen: in the courtyard about as far as 300 frames of
// walking.
constexpr double kWalkShare = 0.5;
constexpr double kZoom = 2.0;  // the last frame's picture shows half as much each way
constexpr double kBorderShare = 1.0e-9;

constexpr std::array kPaths{CameraPath{"pan", "turns by 60 degrees about the vertical"},
                            CameraPath{"walk", "walks level half way to what it looks at"},
                            CameraPath{"roll", "rolls once about its own axis"},
                            CameraPath{"zoom", "zooms in to half the angle's tangent"}};

/// Returns half the height of what the camera sees at a depth before it.
double half_height_m(const ConsumerItem& c, double depth_m) {
    return half_extent(c).y * (c.projection == CameraProjection::orthographic ? 1.0 : depth_m);
}

/// Returns a point right of, above and behind the camera.
glm::dvec3 seen_from(const ConsumerItem& c, const glm::dvec3& point_ws_m) {
    return (point_ws_m - c.position_ws_m) * c.rotation_ws;
}

}  // namespace

std::span<const CameraPath> camera_paths() { return kPaths; }

Result<std::vector<std::string>> chosen_names(const std::vector<std::string>& wanted,
                                              const std::vector<std::string>& known, const char* what) {
    for (const std::string& name : wanted) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        std::string all;
        for (const std::string& k : known) all += (all.empty() ? "" : " | ") + k;
        return Error{std::string("--") + what + " takes " + all + ", not '" + name + "'", "", "",
                     std::string("bench.") + what};
    }
    return wanted.empty() ? known : wanted;
}

ConsumerItem on_path(const ConsumerItem& start, std::string_view path, double share, double distance_m) {
    ConsumerItem c = start;
    if (path == "pan") {
        const auto turn = glm::angleAxis(kPan_rad * share, glm::dvec3(0.0, 1.0, 0.0));
        c.rotation_ws = glm::mat3_cast(turn) * start.rotation_ws;
    } else if (path == "walk") {
        glm::dvec3 level = -start.rotation_ws[2] * glm::dvec3(1.0, 0.0, 1.0);
        // Looking straight down or up, one walks to where the picture's top is.
        if (!(glm::length(level) > kBorderShare)) level = start.rotation_ws[1] * glm::dvec3(1.0, 0.0, 1.0);
        c.position_ws_m += glm::normalize(level) * (kWalkShare * distance_m * share);
    } else if (path == "roll") {
        const auto turn = glm::angleAxis(kTurn_rad * share, start.rotation_ws[2]);
        c.rotation_ws = glm::mat3_cast(turn) * start.rotation_ws;
    } else {
        const double scale = std::pow(kZoom, -share);
        c.fov_y_rad = 2.0 * std::atan(std::tan(0.5 * start.fov_y_rad) * scale);
        c.half_height_m *= scale;
    }
    return c;
}

Transform transform_of(const ConsumerItem& consumer) {
    return {.translation_m = consumer.position_ws_m, .rotation = glm::quat_cast(consumer.rotation_ws)};
}

void place_camera(const ConsumerItem& consumer, ecs::Registry& world) {
    world.patch<Transform>(consumer.entity, [&](Transform& t) { t = transform_of(consumer); });
    world.patch<Camera>(consumer.entity, [&](Camera& camera) {
        camera.fov_y_rad = consumer.fov_y_rad;
        camera.half_height_m = consumer.half_height_m;
    });
}

glm::dvec2 place_px(const ConsumerItem& c, const glm::dvec3& point_ws_m) {
    const glm::dvec3 p = seen_from(c, point_ws_m);
    const double half_y = half_height_m(c, -p.z);
    const glm::dvec2 ndc(p.x / (half_y * aspect(c)), p.y / half_y);
    return (ndc + 1.0) * 0.5 * glm::dvec2(c.viewport_px) - 0.5;
}

double pixel_width_m(const ConsumerItem& c, const glm::dvec3& point_ws_m) {
    return 2.0 * half_height_m(c, -seen_from(c, point_ws_m).z) / c.viewport_px.y;
}

oracle::ExactRay ray_through(const ConsumerItem& c, const glm::dvec2& place, const glm::dvec3& origin_ws_m) {
    const bool flat = c.projection == CameraProjection::orthographic;
    const double half_y = half_extent(c).y;
    const glm::dvec3 lateral =
        c.rotation_ws[0] * (place.x * half_y * aspect(c)) + c.rotation_ws[1] * (place.y * half_y);
    const glm::dvec3 start = c.position_ws_m - origin_ws_m;
    return flat ? oracle::make_ray(start + lateral, -c.rotation_ws[2])
                : oracle::make_ray(start, lateral - c.rotation_ws[2]);
}

bool in_view(const ConsumerItem& c, const glm::dvec3& point_ws_m) {
    const glm::dvec3 p = seen_from(c, point_ws_m);
    const double half_y = half_height_m(c, -p.z) * (1.0 - kBorderShare);
    return -p.z > c.near_m && -p.z < c.far_m && std::abs(p.y) < half_y && std::abs(p.x) < half_y * aspect(c);
}

}  // namespace gnomon::bench
