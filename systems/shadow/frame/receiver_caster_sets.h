#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/math/frustum.h"
#include "systems/shadow/frame/index_range.h"
#include "systems/shadow/frame/index_set.h"
#include "systems/shadow/frame/instance_layers.h"
#include "systems/shadow/frame/lit_area.h"
#include "systems/shadow/frame/occluder.h"
#include "systems/shadow/frame/receiver_mask.h"
#include "systems/shadow/frame/split_scratch.h"

namespace gnomon::shadow {

/// Receiver hull in light space, for one light frustum: a sun's whole view, a spot's cone, or a face of the cube around
/// a light. Only casters between the light and the hull can darken these receivers.
struct ReceiverHull {
    bool parallel = false;        // the light comes along -axes[2]; else from the origin
    glm::dvec3 origin_ws_m{0.0};  // origin of the outline's coordinates
    glm::dmat3 axes{1.0};         // columns u, v, toward the light; orthonormal
    IndexRange receiver_points;   // into ReceiverCasterSets::receiver_points_ws: corners inside this frustum
    std::uint32_t receivers = 0;  // number of receivers with such corners, once for each camera view
    std::uint32_t consumers = 0;  // consumer_bit() of each camera view that sees any of them
    IndexRange outline;           // into ReceiverCasterSets::outlines: convex polygon around the points in light space,
                                  // metres along u and v (parallel), or tangents
    double slack = 0.0;           // bound on the rounding error of its corners, same unit
    double far_m = 0.0;           // largest distance of the points along -axes[2]
    double reach_m = 0.0;         // largest distance of the points from the origin; infinite if parallel
};

/// Share of the way to a box of air's farthest seen point up to which the air does not count for errors. It adds about
/// that share of what the box adds to a pixel.
inline constexpr double kAirShare = 1.0 / 8.0;

/// One light's potential receivers (PSR) and casters (PSC), as ranges of ReceiverCasterSets' arrays.
struct LightSets {
    IndexRange receivers;        // into receiver_items
    IndexRange casters;          // into caster_items, for all views of the light
    IndexRange receiver_points;  // into receiver_points_ws: corners of receivers clipped to camera frusta and light
    IndexRange error_points;     // into error_points_ws; empty: receiver_points
    IndexRange hulls;            // one for a sun or a single spot view, one per face of a cube
};

/// Struct 3. Visible lit receivers, and the casters that can darken these.
struct ReceiverCasterSets {
    std::vector<LightSets> lights;              // one per light; empty ranges where it is skipped
    std::vector<math::Frustum> camera_frusta;   // one per camera view; near plane at its nearest receiver
    std::vector<double> nearest_surface_m;      // one per camera view, view depth; empty: no receiver is air
    std::vector<Occluder> occluders;            // seen by the only camera view; several: none
    std::vector<std::uint32_t> receiver_items;  // indices into SceneSnapshot::instances
    std::vector<std::uint32_t> caster_items;    // indices into SceneSnapshot::instances
    std::vector<glm::dvec3> receiver_points_ws;
    /// Corners of the parts that errors are stated for, and that cascades begin at: those of surfaces, and those of air
    /// from kAirShare on. Empty while no receiver is air.
    std::vector<glm::dvec3> error_points_ws;
    std::vector<ReceiverHull> hulls;
    std::vector<glm::dvec2> outlines;
    std::vector<LitArea> lit_areas;  // one per light, for each camera view that draws

    void clear();
};

/// One light's sets, with the arrays that contain them.
struct LightSetsView {
    const ReceiverCasterSets& arrays;
    const LightSets& ranges;
    std::span<const std::uint32_t> receivers() const { return slice(arrays.receiver_items, ranges.receivers); }
    std::span<const std::uint32_t> casters() const { return slice(arrays.caster_items, ranges.casters); }
    std::span<const glm::dvec3> receiver_points_ws() const {
        return slice(arrays.receiver_points_ws, ranges.receiver_points);
    }
    std::span<const glm::dvec3> error_points_ws() const {
        return ranges.error_points.count > 0 ? slice(arrays.error_points_ws, ranges.error_points)
                                             : receiver_points_ws();
    }
    std::span<const ReceiverHull> hulls() const { return slice(arrays.hulls, ranges.hulls); }
    std::span<const glm::dvec2> outline(const ReceiverHull& receiver_hull) const {
        return slice(arrays.outlines, receiver_hull.outline);
    }
};

inline void ReceiverCasterSets::clear() {
    lights.clear();
    camera_frusta.clear();
    nearest_surface_m.clear();
    occluders.clear();
    receiver_items.clear();
    caster_items.clear();
    receiver_points_ws.clear();
    error_points_ws.clear();
    hulls.clear();
    outlines.clear();
    lit_areas.clear();
}

/// Appends one light's sets, ranges of `from`, to the arrays of `to`. Returns their ranges there.
LightSets append_sets(const ReceiverCasterSets& from, const LightSets& sets, ReceiverCasterSets& to);

/// Gives the arrays of `sets` room for as much as those of `all`.
void reserve_as(const ReceiverCasterSets& all, ReceiverCasterSets& sets);

/// Reused storage of one thread's searches for receivers and casters; its contents are meaningless between two.
struct SetScratch {
    const InstanceLayers* layers = nullptr;     // StageStorage::layers
    IndexSet marks, receivers;                  // sets of instances
    std::vector<std::uint32_t> candidates;      // receivers that a camera sees, camera by camera
    std::vector<IndexRange> camera_candidates;  // range of `candidates` for each camera
    SplitScratch split;
    std::vector<glm::dvec3> points_ws;
    std::vector<std::uint32_t> surfaces;  // candidates of one camera that are no air
    std::vector<std::uint32_t> seen;      // receivers that no occluder hides
    ReceiverMask mask;
    std::vector<glm::dvec2> points, polygon, clipped, outline;
    std::vector<std::uint32_t> items, mesh_starts;
};

}  // namespace gnomon::shadow
