#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/math/aabb.h"
#include "systems/debug/debug_view.h"

/// Lines in the world, for debug views.
namespace gnomon::debug {

/// Corners of a box-like volume. Corner i: bit 0 selects along the first axis, bit 1 along the second, bit 2 along the
/// third.
using Corners = std::array<glm::dvec3, 8>;

Corners corners_of(const math::Aabb& box);

/// Computes the corners of a map's volume in the world; bit 2 set is the near side. Handles warped maps.
Corners corners_of(const shadow::ShadowView& view);

/// Collects lines for one camera: positions are relative to it, subtracted in double, then rounded.
class LineDrawing {
public:
    explicit LineDrawing(const ConsumerItem& camera) : eye_ws_m_(camera.position_ws_m) {}
    void add(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m, const glm::vec3& srgb);
    /// Adds the twelve edges.
    void add(const Corners& corners, const glm::vec3& srgb);
    std::vector<LineVertex> take() { return std::move(vertices_); }

private:
    glm::dvec3 eye_ws_m_;
    std::vector<LineVertex> vertices_;
};

}  // namespace gnomon::debug
