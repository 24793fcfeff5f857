#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "gnomon/core.h"

/// Scenes for the tests of gnomon/core.h, and their truth: rays against the boxes. Knows nothing else of Gnomon.
namespace gnomon::core {

/// Columns right, up, back of what looks along `ahead`.
inline glm::dmat3 looking(const glm::dvec3& ahead) {
    const glm::dvec3 back = -glm::normalize(ahead);
    const glm::dvec3 up = std::abs(back.y) > 0.99 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

/// Cameras, lights and boxes that a test changes as it likes.
struct OwnScene {
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Box> boxes;

    Scene scene() const { return {cameras, lights, boxes}; }
    void add_camera(const glm::dvec3& from, const glm::dvec3& to) {
        Camera camera;
        camera.position_ws_m = from;
        camera.rotation_ws = looking(to - from);
        camera.viewport_px = {1280, 720};
        cameras.push_back(camera);
    }
    Light& add_light(LightKind kind, const glm::dvec3& from, const glm::dvec3& to) {
        Light light;
        light.id = lights.size() + 1;
        light.kind = kind;
        light.position_ws_m = from;
        light.rotation_ws = looking(to - from);
        light.range_m = 40.0f;
        light.outer_cone_rad = 0.9f;
        lights.push_back(light);
        return lights.back();
    }
    void move(const glm::dvec3& by) {
        for (Camera& camera : cameras) camera.position_ws_m += by;
        for (Light& light : lights) light.position_ws_m += by;
        for (Box& box : boxes) box.min_ws_m += by, box.max_ws_m += by;
    }
};

/// Makes ground in tiles, pillars on it, one light of each kind above it: sun 0, spot 1, point 2.
inline OwnScene courtyard() {
    OwnScene own;
    own.add_camera({0.0, 4.0, 14.0}, {0.0, 0.0, 0.0});
    own.add_light(LightKind::directional, {30.0, 50.0, 20.0}, {});
    own.add_light(LightKind::spot, {6.0, 9.0, 4.0}, {0.0, 0.0, 0.0});
    own.add_light(LightKind::point, {-1.5, 3.0, 1.0}, {0.0, 0.0, 0.0});
    for (int x = -4; x < 4; ++x)
        for (int z = -4; z < 4; ++z) {
            Box tile;
            tile.min_ws_m = {5.0 * x, -0.2, 5.0 * z};
            tile.max_ws_m = tile.min_ws_m + glm::dvec3(5.0, 0.2, 5.0);
            own.boxes.push_back(tile);
        }
    for (int i = 0; i < 12; ++i) {
        Box pillar;
        pillar.min_ws_m = {-9.0 + 3.1 * (i % 6), 0.0, -6.0 + 5.3 * (i / 6)};
        pillar.max_ws_m = pillar.min_ws_m + glm::dvec3(0.6, 1.0 + 0.2 * i, 0.5);
        own.boxes.push_back(pillar);
    }
    return own;
}

/// Returns the distance along a ray at which it enters the box; infinity if it does not before `to_m`.
inline double entry_m(const Box& box, const glm::dvec3& from, const glm::dvec3& along, double to_m) {
    double enters = 0.0, leaves = to_m;
    for (int i = 0; i < 3; ++i) {
        if (along[i] == 0.0) {
            if (from[i] < box.min_ws_m[i] || from[i] > box.max_ws_m[i]) return std::numeric_limits<double>::infinity();
            continue;
        }
        const double a = (box.min_ws_m[i] - from[i]) / along[i], b = (box.max_ws_m[i] - from[i]) / along[i];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves ? enters : std::numeric_limits<double>::infinity();
}

/// Unit vector toward the light, and the distance to it.
struct Way {
    glm::dvec3 toward;
    double distance_m;
};
inline Way way_to(const Light& light, const glm::dvec3& p) {
    if (light.kind == LightKind::directional) return {light.rotation_ws[2], 1.0e4};
    const double distance_m = glm::length(light.position_ws_m - p);
    return {(light.position_ws_m - p) / distance_m, distance_m};
}

inline bool reaches(const Light& light, const glm::dvec3& p) {
    if (light.kind == LightKind::directional) return true;
    const Way way = way_to(light, p);
    if (light.range_m > 0.0f && way.distance_m > static_cast<double>(light.range_m)) return false;
    return light.kind == LightKind::point ||
           glm::dot(way.toward, light.rotation_ws[2]) >= std::cos(static_cast<double>(light.outer_cone_rad));
}

inline bool sees(const Camera& camera, const glm::dvec3& p) {
    const glm::dvec3 d = (p - camera.position_ws_m) * camera.rotation_ws;
    const double half = camera.projection == Projection::orthographic ? camera.half_height_m
                                                                      : std::tan(0.5 * camera.fov_y_rad) * -d.z;
    const double aspect = static_cast<double>(camera.viewport_px.x) / camera.viewport_px.y;
    return -d.z >= camera.near_m && -d.z <= camera.far_m && std::abs(d.y) <= half && std::abs(d.x) <= half * aspect;
}

inline bool holds(const glm::dvec3& place) {
    return place.x >= 0.0 && place.x <= 1.0 && place.y >= 0.0 && place.y <= 1.0 && place.z >= 0.0 && place.z <= 1.0;
}

/// Returns the view that serves a point, as docs/how-to/other_graphics_apis.md lets a lookup find it; null: none.
inline const View* serving(std::span<const View> views, const LightFit& fit, const Camera& camera, const glm::dvec3& p) {
    const View* best = nullptr;
    double deepest = 0.0;
    const double ahead_m = glm::dot(p - camera.position_ws_m, -camera.rotation_ws[2]);
    for (const View& view : views) {
        if (view.kind == ViewKind::orthographic) {
            if (view.to_m > 0.0 && ahead_m > view.to_m) continue;
            if (holds(map_place(view, p))) return &view;
            continue;
        }
        if (fit.faces_share > 0.0 && fit.faces_share < 1.0) return &views.back();
        const double ahead = glm::dot(view.eye_ws_m - p, view.axis_back);
        if (ahead > deepest) deepest = ahead, best = &view;
    }
    return best;
}

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
    glm::dvec3 inside(const glm::dvec3& low, const glm::dvec3& high) {
        const double x = number(low.x, high.x), y = number(low.y, high.y);
        return {x, y, number(low.z, high.z)};
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace gnomon::core
