#include "systems/shadow/culling/lamp_offsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "engine/core/signature.h"
#include "engine/math/frustum.h"
#include "engine/math/shape_tree.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/triangle_distance.h"
#include "systems/shadow/frame/cpu_timer.h"

namespace gnomon::shadow {
namespace {

/// Rounding error of a lamp's height above a triangle's plane, per metre of the coordinates. The corners relative to
/// the lamp and the plane through them round a dozen times.
constexpr double kPlaneUnits = 64.0 * 0x1p-53;
/// Cosine of normals below which two triangles are opposite sides of one plane. A float mesh does not resolve smaller
/// differences.
constexpr double kOpposite = -1.0 + 0x1p-20;
/// Number of rounds of projections onto all planes. They suffice for a wedge of 15 degrees.
constexpr int kRounds = 64;
/// Share of the target height that may be missing at the end of the projections.
constexpr double kDone = 0x1p-10;
/// How often the target height is halved where triangles leave less room.
constexpr int kHalvings = 8;
/// Largest offset of a lamp, in target heights: enough for a wedge of 15 degrees.
constexpr double kFarthest = 8.0;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Returns true if any part of the mesh may be nearer to the lamp than clear_m. `from_lamp_m`: vector from the lamp to
/// the mesh's origin. NaN: returns true.
bool may_touch(const math::ShapeTree& shape, const InstanceItem& item, const glm::dvec3& from_lamp_m, double clear_m,
               std::vector<glm::dvec3>& scratch) {
    std::array<math::Plane, 6> planes;
    double sum = 0.0;
    for (int i = 0; i < 6; ++i) {
        glm::dvec3 inward(0.0);
        inward[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
        planes[static_cast<std::size_t>(i)] = {inward * item.basis, glm::dot(inward, from_lamp_m) + clear_m};
        sum += glm::dot(planes[static_cast<std::size_t>(i)].normal, glm::dvec3(1.0)) + from_lamp_m[i / 2];
    }
    if (!std::isfinite(sum)) return true;
    constexpr double kNone = 1.0;  // above every value of the constant ramp
    return shape.lowest({}, planes, kNone, scratch) < kNone;
}

}  // namespace

/// Finds casters with a part near the lamp. They are visited by rising index, so that the result does not depend on the
/// tree's shape.
void LampOffsets::find_near(const SceneSnapshot& scene, const LightItem& light, double share) {
    const glm::dvec3& lamp_ws_m = light.position_ws_m;
    near_.clear(scene.instances.size());
    const auto touches = [&](const math::Aabb& box_ws) {
        const bool near = math::distance(box_ws, lamp_ws_m) <= share * math::farthest_distance(box_ws, lamp_ws_m);
        return near ? math::Overlap::partial : math::Overlap::outside;
    };
    visit_instances(scene, touches, [&](std::uint32_t i) {
        const InstanceItem& item = scene.instances[i];
        if (!casts_under(light, item)) return;
        const math::ShapeTree* shape = shape_of(scene.meshes, item.mesh);
        const double clear_m = share * math::farthest_distance(item.bounds_ws, lamp_ws_m);
        if (!shape || may_touch(*shape, item, item.translation_ws_m - lamp_ws_m, clear_m, scratch_)) near_.add(i);
    });
}

/// Adds a plane, unless it is the opposite side of a plane already added and the lamp lies in both. The first face
/// decides the lamp's side.
void LampOffsets::add_side(Side side) {
    for (const Side& other : sides_)
        if (side.in_plane && other.in_plane && glm::dot(side.normal, other.normal) < kOpposite) return;
    sides_.push_back(side);
}

void LampOffsets::find_sides(const GpuScene& gpu, const LightItem& light, const InstanceItem& item, double share) {
    const double reach_m = math::farthest_distance(item.bounds_ws, light.position_ws_m);
    const double size_m = largest(item.translation_ws_m) + largest(light.position_ws_m) + reach_m;
    visit_triangles(gpu, item, light.position_ws_m, [&](const Corners& c) {
        const double corner_m = std::max({glm::length(c[0]), glm::length(c[1]), glm::length(c[2])});
        const double clear_m = std::max(kClearOfPlanes * reach_m, share * corner_m);
        if (!(distance_to(c) < clear_m)) return;
        const glm::dvec3 across = glm::cross(c[1] - c[0], c[2] - c[0]) * (item.winding.mirrored ? -1.0 : 1.0);
        const double area = glm::length(across);
        if (!(area > 0.0)) return;
        const double height_m = -glm::dot(across, c[0]) / area;
        const bool in_plane = std::abs(height_m) <= kPlaneUnits * size_m;
        const double side = in_plane || height_m > 0.0 ? 1.0 : -1.0;
        add_side({across * (side / area), std::abs(height_m), clear_m, in_plane});
    });
}

/// Computes the offset that lifts the lamp to the target height above all planes, by projections onto them in turn.
/// Where there is less room, the height is a part of the target. 0: there is no room.
glm::dvec3 LampOffsets::step_m() const {
    double share = 1.0;
    for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
        glm::dvec3 step(0.0);
        double lacking = HUGE_VAL, clear_m = 0.0;
        for (int round = 0; round < kRounds && lacking > kDone * clear_m; ++round) {
            lacking = 0.0;
            for (const Side& side : sides_) {
                const double gap_m = share * side.clear_m - side.height_m - glm::dot(side.normal, step);
                clear_m = std::max(clear_m, share * side.clear_m);
                lacking = std::max(lacking, gap_m);
                if (gap_m > 0.0) step += side.normal * gap_m;
            }
        }
        if (lacking <= kDone * clear_m && glm::length(step) <= kFarthest * clear_m) return step;
    }
    return glm::dvec3(0.0);
}

glm::dvec3 LampOffsets::place_of(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light, double share,
                                 KeptPlace& kept) {
    find_near(scene, light, share);
    Signature signature;
    signature.add(share);
    bool any = false;
    for (int i = 0; i < 3; ++i) signature.add(light.position_ws_m[i]);
    near_.for_each([&](std::uint32_t i) {
        const InstanceItem& item = scene.instances[i];
        signature.add(std::uint64_t{item.entity.version} << 32 | item.entity.index);
        signature.add(item.version);
        signature.add(item.mesh_version);
        any = true;
    });
    if (!any) return light.position_ws_m;
    // Without a version of the scene it is unknown whether casters moved.
    if (scene.version != 0 && kept.signature == signature.value()) return kept.place_ws_m;
    sides_.clear();
    near_.for_each([&](std::uint32_t i) { find_sides(gpu, light, scene.instances[i], share); });
    kept = {signature.value(), light.position_ws_m + step_m()};
    return kept.place_ws_m;
}

void LampOffsets::update(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const ShadowRequest> requests,
                         std::vector<glm::dvec3>& lamps_ws_m, std::span<double> cpu_us) {
    kept_.resize(scene.lights.size());
    lamps_ws_m.resize(scene.lights.size());
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const LightItem& light = scene.lights[i];
        lamps_ws_m[i] = light.position_ws_m;
        if (light_facts(light.kind).parallel || requests[i].skip != Reason::none) continue;
        const LightTimer time(cpu_us, i);
        const double share = requests[i].rays.used ? kClearOfPlanes : kClearOfClipping;
        lamps_ws_m[i] = place_of(scene, gpu, light, share, kept_[i]);
    }
}

}  // namespace gnomon::shadow
