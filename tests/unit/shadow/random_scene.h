#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "tests/oracle/fit_stages.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {

/// Random boxes around the origin, one camera, one light; everything times `scale`, then moved by `offset`.
class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : random_(seed) {}

    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    glm::dvec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
    glm::dvec3 direction() {
        glm::dvec3 d;
        do d = vector(1.0);
        while (!(glm::length(d) > 0.05 && glm::length(d) <= 1.0));
        return glm::normalize(d);
    }
    SceneSnapshot scene(LightKind kind, std::size_t boxes = 24) {
        SceneSnapshot s;
        for (std::size_t i = 0; i < boxes; ++i) {
            InstanceItem item;
            item.mesh = static_cast<std::uint32_t>(i % 3);
            item.gpu_slot = static_cast<std::uint32_t>(i);
            const glm::dvec3 centre = vector(10.0), half = glm::abs(vector(1.0)) + 0.05;
            item.bounds_ws = {centre - half, centre + half};
            item.casts = i % 4 != 0;
            item.receives = i % 5 != 0;
            item.visible = i % 7 != 0;
            s.instances.push_back(item);
        }
        ConsumerItem camera;
        camera.position_ws_m = 15.0 * direction();
        camera.rotation_ws = math::basis_from_back(camera.position_ws_m + vector(5.0));
        camera.fov_y_rad = number(0.3, 1.5);
        camera.viewport_px = {640, 360};
        s.consumers.push_back(camera);
        LightItem light;
        light.kind = kind;
        light.intensity = 1.0f;
        light.has_shadow = true;
        light.shadow.resolution_px = 512;
        light.shadow.filter = ShadowFilter::pcf_grid;
        light.position_ws_m = vector(12.0);
        light.rotation_ws = math::basis_from_back(light.position_ws_m + vector(4.0));
        light.range_m = number(0.0, 1.0) < 0.3 ? 0.0 : number(5.0, 40.0);
        light.outer_cone_rad = number(0.1, 1.55);
        s.lights.push_back(light);
        return s;
    }

private:
    std::mt19937_64 random_;
};

inline void place(SceneSnapshot& s, double scale, const glm::dvec3& offset) {
    for (InstanceItem& i : s.instances) i.bounds_ws = {i.bounds_ws.min * scale + offset, i.bounds_ws.max * scale + offset};
    for (ConsumerItem& c : s.consumers) {
        c.position_ws_m = c.position_ws_m * scale + offset;
        c.near_m *= scale;
        c.far_m *= scale;
        c.half_height_m *= scale;
    }
    for (LightItem& l : s.lights) {
        l.position_ws_m = l.position_ws_m * scale + offset;
        l.range_m *= scale;
    }
}

/// Returns whether the light's rays can reach the point, were nothing in the way.
inline bool reaches(const LightItem& light, const glm::dvec3& p) {
    if (light.kind == LightKind::directional) return true;
    const glm::dvec3 to = p - light.position_ws_m;
    if (light.range_m > 0.0 && glm::length(to) > light.range_m) return false;
    return light.kind == LightKind::point || glm::dot(to, -light.rotation_ws[2]) > glm::length(to) * std::cos(light.outer_cone_rad);
}

inline bool seen(const ConsumerItem& c, const glm::dvec3& p_ws) {
    const glm::dvec3 p = (p_ws - c.position_ws_m) * c.rotation_ws;
    const double tan_y = std::tan(0.5 * c.fov_y_rad);
    return -p.z > c.near_m && -p.z < c.far_m && std::abs(p.y) < -p.z * tan_y && std::abs(p.x) < -p.z * tan_y * aspect(c);
}

/// Share of the segment from a (0) to b (1) where it is inside the box; empty (from > to) if it misses.
struct Crossing {
    double from = 0.0, to = 1.0;
};
inline Crossing crossing(const math::Aabb& box, const glm::dvec3& a, const glm::dvec3& b) {
    Crossing c;
    for (int i = 0; i < 3; ++i) {
        double t0 = (box.min[i] - a[i]) / (b[i] - a[i]), t1 = (box.max[i] - a[i]) / (b[i] - a[i]);
        if (t0 > t1) std::swap(t0, t1);
        c.from = std::max(c.from, t0);
        c.to = std::min(c.to, t1);
    }
    return c;
}

/// Returns where the light's rays to `p` come from: the light, or far along the sun's direction.
inline glm::dvec3 source_of(const LightItem& light, const glm::dvec3& p) {
    constexpr double kFar_m = 1e4;
    return light.kind == LightKind::directional ? p + kFar_m * light.rotation_ws[2] : light.position_ws_m;
}

inline glm::dvec3 random_point(RandomScene& random, const math::Aabb& box) {
    return {random.number(box.min.x, box.max.x), random.number(box.min.y, box.max.y), random.number(box.min.z, box.max.z)};
}

}  // namespace gnomon::shadow
