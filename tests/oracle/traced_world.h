#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/embree.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/triangle_test.h"

/// The triangles of a snapshot in an Embree tree, and queries for their surfaces and casters. See ReferenceTracer.
namespace gnomon::oracle {

struct WorldTriangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};  // relative to the origin, in the mesh's winding
    std::uint32_t instance = 0, mesh = 0, first_index = 0, material = 0;
    ShadowLayers cast_layers = 0, receive_layers = 0;  // 0: casts, receives nothing
    bool visible = false, mirrored = false, double_sided = false, masked = false;
};

/// Returns the normal of the counter-clockwise side, not normalised. It is zero or not finite for degenerate triangles.
inline glm::dvec3 front_normal(const WorldTriangle& t) {
    const glm::dvec3 n = glm::cross(t.b - t.a, t.c - t.a);
    return t.mirrored ? -n : n;
}

struct SurfaceHit {
    std::uint32_t triangle = kNoTriangle;
    double t = 0.0;
};

class TracedWorld {
public:
    TracedWorld(const SceneSnapshot& snapshot, const assets::MeshLibrary& library, const glm::dvec3& origin_ws_m);
    ~TracedWorld();
    TracedWorld(const TracedWorld&) = delete;
    TracedWorld& operator=(const TracedWorld&) = delete;

    const std::vector<WorldTriangle>& triangles() const { return triangles_; }
    const glm::dvec3& origin_ws_m() const { return origin_ws_m_; }

    /// Returns the nearest visible surface with t in [t_min, t_max]; of equal t the lowest triangle number.
    SurfaceHit nearest_surface(const ExactRay& ray, double t_min, double t_max) const;

    /// Returns the number of a caster of these layers that meets the ray at t in (0, t_max), or kNoTriangle. `hint` is
    /// tried first (an occluder of a nearby ray, or kNoTriangle) and changes only the time that is needed.
    std::uint32_t occluder(const ExactRay& ray, double t_max, std::uint32_t start_triangle, std::uint32_t hint,
                           ShadowLayers layers = kAllShadowLayers) const;

    /// Returns the caster among them that the ray meets last; of equal t the lowest triangle number.
    std::uint32_t farthest_occluder(const ExactRay& ray, double t_max, std::uint32_t start_triangle,
                                    ShadowLayers layers) const;

    /// Returns whether the point lies in the triangle's plane, up to the rounding of double.
    bool on_plane(const glm::dvec3& point, std::uint32_t triangle) const;

    /// Decides for one triangle: does it block the ray, or show a surface on it?
    bool blocks(const ExactRay& ray, double t_max, ShadowLayers layers, std::uint32_t start_triangle,
                std::uint32_t triangle, double& t) const;
    bool shows(const ExactRay& ray, double t_min, double t_max, std::uint32_t triangle, double& t) const;

private:
    void add_instance(const InstanceItem& item, std::uint32_t index, const std::vector<glm::dvec3>& positions);
    bool is_there(const WorldTriangle& triangle, const ExactHit& hit) const;
    static void bounds_callback(const RTCBoundsFunctionArguments* args);
    static void intersect_callback(const RTCIntersectFunctionNArguments* args);
    static void occluded_callback(const RTCOccludedFunctionNArguments* args);

    const assets::MeshLibrary& library_;
    glm::dvec3 origin_ws_m_;
    std::vector<WorldTriangle> triangles_;
    double padding_m_ = 0.0;      // width that Embree's boxes are enlarged by
    double plane_error_m_ = 0.0;  // rounding of the distance from a point to a triangle's plane
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

}  // namespace gnomon::oracle
