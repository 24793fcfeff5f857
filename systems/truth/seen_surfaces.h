#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/visibility/caster_trees.h"

/// Surfaces that a camera sees, by rays in double: the places for the truth about lights.
namespace gnomon::truth {

inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// Surface at each pixel centre, rows bottom to top.
struct SeenSurfaces {
    glm::uvec2 size_px{0, 0};
    glm::dvec3 camera_ws_m{0.0};
    std::vector<std::uint32_t> instance;    // index in the snapshot; kNoSurface: none
    std::vector<glm::dvec3> position_ws_m;  // on the triangle's plane, to double's rounding
    std::vector<glm::dvec3> normal_ws;      // unit length, geometric, on the visible side
    std::size_t count() const { return instance.size(); }
    /// Resizes for a picture without any surface.
    void reset(glm::uvec2 size, const glm::dvec3& camera);
};

/// Finds the nearest front face (any face of double-sided materials) of visible instances through each pixel centre,
/// between near and far plane. Masked texels and blended materials are transparent.
class SurfaceTracer {
public:
    /// Refers to its arguments, which must outlive the tracer. `trees`: of this scene, with
    /// TreesOf::casters_and_visible, or TreesOf::visible where any surface transmits light without being blended.
    SurfaceTracer(const SceneSnapshot& scene, const visibility::CasterTrees& trees, const ConsumerItem& camera)
        : scene_(scene), trees_(trees), camera_(camera) {}

    /// Fills one row of `seen`. Several threads may trace different rows. `hint`: instance to test first, set to an
    /// instance that was hit; it affects only time.
    void trace_row(std::uint32_t row, std::uint32_t& hint, SeenSurfaces& seen) const;
    /// Fills `found` with what is seen through each place of the picture. `at_px`: integers are pixels' middles.
    void trace(std::span<const glm::dvec2> at_px, std::uint32_t& hint, SeenSurfaces& found) const;
    /// Returns the width of a pixel across its ray at a place in the picture, m.
    double pixel_width_m(const glm::dvec3& at_ws_m) const;

private:
    void trace(std::span<const glm::dvec2> at_px, std::size_t first, std::uint32_t& hint, SeenSurfaces& seen) const;

    const SceneSnapshot& scene_;
    const visibility::CasterTrees& trees_;
    const ConsumerItem& camera_;
};

}  // namespace gnomon::truth
