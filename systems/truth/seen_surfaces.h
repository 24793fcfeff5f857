#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/visibility/caster_trees.h"

/// What a camera sees, by rays in double: the places at which the truth about a light is asked.
namespace gnomon::truth {

inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// The surface at each pixel centre, rows bottom to top.
struct SeenSurfaces {
    glm::uvec2 size_px{0, 0};
    glm::dvec3 camera_ws_m{0.0};
    std::vector<std::uint32_t> instance;    // index into the snapshot's; kNoSurface: none
    std::vector<glm::dvec3> position_ws_m;  // on the triangle's plane, to the rounding of double
    std::vector<glm::dvec3> normal_ws;      // unit, geometric, on the side that is seen
    std::size_t count() const { return instance.size(); }
    /// Room for a picture, nothing seen.
    void reset(glm::uvec2 size, const glm::dvec3& camera);
};

/// Nearest front face (any face of double-sided materials) of visible instances through each pixel centre, between near
/// and far plane. Masked texels are looked through; what is blended is not there.
class SurfaceTracer {
public:
    /// `trees`: of this scene, with TreesOf::casters_and_visible. All must outlive the tracer.
    SurfaceTracer(const SceneSnapshot& scene, const visibility::CasterTrees& trees, const ConsumerItem& camera)
        : scene_(scene), trees_(trees), camera_(camera) {}

    /// Fills one row of `seen`. Rows may be traced at once by several threads. `hint`: an instance that is looked at
    /// first, left at one that was seen; it changes only the time that is needed.
    void trace_row(std::uint32_t row, std::uint32_t& hint, SeenSurfaces& seen) const;

private:
    const SceneSnapshot& scene_;
    const visibility::CasterTrees& trees_;
    const ConsumerItem& camera_;
};

}  // namespace gnomon::truth
