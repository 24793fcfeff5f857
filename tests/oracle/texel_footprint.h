#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "gnomon/light.h"
#include "tests/oracle/edge_exceptions.h"

namespace gnomon::oracle {

/// Vertices snap to this part of a texel, or pixel (rasterisers with 8 sub-texel bits).
inline constexpr double kRasterSnap = 1.0 / 256.0;

/// A texel on a plane: its sides, carried along the ray.
struct Footprint {
    glm::dvec3 middle, u_m, v_m, normal, ray;
    glm::dvec3 at(double u_texel, double v_texel) const {
        const glm::dvec3 across = u_m * u_texel + v_m * v_texel;
        return middle + across - ray * (glm::dot(across, normal) / glm::dot(ray, normal));
    }
    /// Returns the least distance of a caster from the plane, along the ray, that depths under a filter resolve.
    double least_m(const TexelThere& texel) const {
        const double rise_m =
            (std::abs(glm::dot(u_m, normal)) + std::abs(glm::dot(v_m, normal))) / glm::dot(ray, normal);
        return 2.0 * (texel.filter_texel + kRasterSnap) * rise_m + texel.depth_m;
    }
};

/// Returns the unit vector from a point toward a light.
inline glm::dvec3 toward(const LightItem& light, const ConsumerItem& consumer, const PrimaryHits& hits,
                         const glm::dvec3& point_rel_m) {
    if (light.kind == LightKind::directional) return light.rotation_ws[2];
    return glm::normalize(light.position_ws_m - consumer.position_ws_m + hits.camera_rel_m - point_rel_m);
}

/// Returns whether a pixel's truth is certain. It is not ambiguous, and the camera sees the same plane wherever snapping
/// may move the pixel's centre.
inline bool shows_one_surface(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                              const LightTruth& truth, std::size_t pixel) {
    if (truth.ambiguous[pixel]) return false;
    const glm::dvec2 centre(pixel % hits.size_px.x, pixel / hits.size_px.x);
    for (const double x : {-kRasterSnap, kRasterSnap})
        for (const double y : {-kRasterSnap, kRasterSnap})
            if (!tracer.sees_plane(consumer, centre + glm::dvec2(x, y), hits.triangle[pixel])) return false;
    return true;
}

}  // namespace gnomon::oracle
