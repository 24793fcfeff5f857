#pragma once
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <utility>

#include "engine/math/frustum.h"
#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::oracle {

/// A world put together by hand, for which the shadow can be written down.
struct AnalyticScene {
    SceneSnapshot snapshot;
    assets::MeshLibrary library;
    glm::dvec3 offset_m{0.0};

    AnalyticScene() { library.materials.emplace_back(); }

    std::uint32_t add_mesh(const std::vector<glm::vec3>& points, const std::vector<std::uint32_t>& indices,
                           std::uint32_t material = 0) {
        assets::Mesh mesh;
        for (const glm::vec3& p : points) mesh.vertices.push_back({p, {}, {p.x + 0.5f, 0.5f - p.y}});
        mesh.indices = indices;
        mesh.submeshes.push_back({0, static_cast<std::uint32_t>(indices.size()), material});
        library.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(library.meshes.size()) - 1u;
    }
    /// Adds a 1 m square in x and y around the origin, facing +z; u to the right, v down.
    std::uint32_t add_square(std::uint32_t material = 0) {
        return add_mesh({{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}}, {0, 1, 2, 0, 2, 3},
                        material);
    }
    /// Adds a 1 m cube around the origin, facing outward.
    std::uint32_t add_cube(std::uint32_t material = 0) {
        std::vector<glm::vec3> points;
        for (int i = 0; i < 8; ++i)
            points.emplace_back(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
        return add_mesh(points, {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6},
                        material);
    }
    InstanceItem& place(std::uint32_t mesh, const glm::dvec3& at, const glm::dmat3& basis = glm::dmat3(1.0)) {
        InstanceItem item;
        item.mesh = mesh;
        item.basis = basis;
        item.translation_ws_m = at + offset_m;
        item.casts = true;
        item.winding.mirrored = glm::determinant(basis) < 0.0;
        snapshot.instances.push_back(item);
        return snapshot.instances.back();
    }
    /// Places a square floor of `size` metres at y = 0, facing up.
    InstanceItem& place_floor(double size) {
        return place(add_square(), glm::dvec3(0.0), glm::dmat3({size, 0, 0}, {0, 0, -size}, {0, size, 0}));
    }
    /// Looks straight down from y = 50 on a square of `width` metres around the origin; +x right, -z up.
    ConsumerItem view_from_above(std::uint32_t size_px, double width) const {
        ConsumerItem camera;
        camera.projection = CameraProjection::orthographic;
        camera.half_height_m = 0.5 * width;
        camera.near_m = 0.0;
        camera.far_m = 100.0;
        camera.position_ws_m = offset_m + glm::dvec3(0.0, 50.0, 0.0);
        camera.rotation_ws = glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
        camera.viewport_px = {size_px, size_px};
        return camera;
    }
    LightItem sun(const glm::dvec3& toward) const {
        LightItem light;
        light.kind = LightKind::directional;
        light.rotation_ws = math::basis_from_back(toward);
        return light;
    }
    LightItem lamp(const glm::dvec3& at) const {
        LightItem light;
        light.kind = LightKind::point;
        light.position_ws_m = at + offset_m;
        return light;
    }
    LightItem spot(const glm::dvec3& at, const glm::dvec3& back, double half_angle_rad) const {
        LightItem light = lamp(at);
        light.kind = LightKind::spot;
        light.rotation_ws = math::basis_from_back(back);
        light.outer_cone_rad = half_angle_rad;
        return light;
    }
    ReferenceTracer tracer() const { return {snapshot, library, offset_m}; }
};

}  // namespace gnomon::oracle
