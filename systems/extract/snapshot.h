#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/camera.h"
#include "components/light.h"
#include "components/light_shadow.h"
#include "components/shadow_tuning.h"
#include "engine/assets/deformer.h"
#include "engine/ecs/entity.h"
#include "engine/math/aabb.h"
#include "engine/math/bounds_tree.h"
#include "engine/math/shape_tree.h"
#include "systems/extract/sampled_depths.h"

/// Struct 1 of the frame: everything later stages know of the world, in world-space double.
/// Fill it from another ECS and the rest of Gnomon works unchanged.
namespace gnomon {

/// A camera that wants shadows in its picture.
struct ConsumerItem {
    ecs::Entity entity = {};
    std::string name = {};
    glm::dvec3 position_ws_m{0.0};
    glm::dmat3 rotation_ws{1.0};  // columns right, up, back; orthonormal, right-handed
    CameraProjection projection = CameraProjection::perspective;
    double fov_y_rad = 0.9;
    double half_height_m = 5.0;
    double near_m = 0.05;
    double far_m = 1.0e9;  // may be infinite for perspective; else depths are spread over all of it (flat_range.h)
    glm::uvec2 viewport_px{1280, 720};
    bool operator==(const ConsumerItem&) const = default;
};

struct LightItem {
    ecs::Entity entity = {};
    std::string name = {};  // unique within the snapshot
    LightKind kind = LightKind::point;
    glm::dvec3 position_ws_m{0.0};
    glm::dmat3 rotation_ws{1.0};  // columns right, up, back; the light shines along -back
    glm::vec3 colour{1.0f};
    float intensity = 0.0f;
    double range_m = 0.0;  // 0: unlimited
    double inner_cone_rad = 0.0, outer_cone_rad = 0.0;
    float source_radius_m = 0.0f;  // of a spot or a point
    float sun_radius_rad = 0.0f;   // of a sun
    bool has_shadow = false;       // a LightShadow component exists
    LightShadow shadow = {};
    ShadowTuning tuning = {};         // the defaults where there is no LightShadow
    std::uint64_t version = 0;        // grows whenever any of the above changed
    std::uint64_t shape_version = 0;  // grows whenever any but name, colour and intensity did: what shadows follow from
};

/// How a mesh that bends (assets::Mesh::deformer) is bent in this frame, by its deformer's joints and targets.
struct PoseItem {
    std::uint32_t mesh = 0;
    bool skinned = false;  // instances then stand at origin_ws_m, unturned: joints alone place them
    glm::dvec3 origin_ws_m{0.0};
    std::vector<glm::dmat4x3> joints = {};  // from the mesh at rest to the space of its instances
    std::vector<float> weights = {};        // per target
    math::Aabb bounds_ms = {};              // holds every bent vertex
    assets::Mirroring mirroring = assets::Mirroring::none;
    std::uint64_t version = 0;  // grows whenever joints or weights changed
    std::uint64_t since = 0;    // the version in which the mesh first had a pose
    double bent_m = 0.0;  // sum, over all its versions, of the most that each moved any vertex by, in the space of
                          // its instances: between two of them none moved by more than the difference
    assets::MeshPose pose() const { return {joints, weights}; }
};

/// One placed mesh.
struct InstanceItem {
    ecs::Entity entity = {};
    std::uint32_t mesh = 0;
    std::uint32_t gpu_slot = 0;  // index of its record in the instance buffer; stable while the entity lives
    glm::dmat3 basis{1.0};
    glm::dvec3 translation_ws_m{0.0};
    math::Aabb bounds_ws = {};  // finite, not empty
    bool casts = false;
    bool receives = true;
    ShadowLayers cast_layers = kAllShadowLayers;
    ShadowLayers receive_layers = kAllShadowLayers;
    bool visible = true;
    bool mirrored = false;  // negative determinant
    bool folded = false;    // its pose mirrors some of it, not all: no side of it is known to be outside
    std::uint64_t version =
        0;  // grows whenever mesh, placement or pose changed: what maps show of it. It need not for the rest
};

/// Whether it stands in the light's way at all, and whether that light's shadows fall on it.
inline bool casts_under(const LightItem& light, const InstanceItem& item) {
    return item.casts && (light.shadow.layers & item.cast_layers) != 0;
}
inline bool receives_under(const LightItem& light, const InstanceItem& item) {
    return item.receives && (light.shadow.layers & item.receive_layers) != 0;
}

enum class DropReason : std::uint8_t {
    non_finite_transform,
    zero_rotation,
    parent_missing,
    parent_cycle,
    unknown_mesh,
    zero_scale,
    absurd_light,
    absurd_camera,
    instances_full,  // the device holds no record of it: not drawn, and lights whose caster it is are lit
};
const char* reason_code(DropReason reason);

struct SceneSnapshot;
/// How the mesh is bent; null: as it is at rest.
const PoseItem* pose_of(const SceneSnapshot& scene, std::uint32_t mesh);

/// An entity that could not be used this frame, and why. The others are unaffected.
struct DroppedEntity {
    ecs::Entity entity = {};
    std::string name = {};
    DropReason reason = DropReason::non_finite_transform;
};

/// Persists over frames; extraction applies only what changed.
/// Orders are those of entity indices, so that the same world gives the same snapshot.
struct SceneSnapshot {
    std::vector<ConsumerItem> consumers;
    std::vector<ConsumerItem> pictures;  // cameras that draw, where they are not those that shadows are fitted to;
                                         // empty: the consumers
    std::vector<LightItem> lights;
    std::vector<InstanceItem> instances;
    std::vector<PoseItem> poses;  // by rising mesh, at most one for each: all instances of a mesh are bent alike
    std::vector<DroppedEntity> dropped;
    std::vector<std::uint32_t> changed_instances;  // indices of those to upload this frame, by rising gpu_slot
    std::uint32_t gpu_slot_count = 0;              // upper bound of all gpu_slots
    std::uint64_t version = 0;                     // grows whenever anything changed, by 1 if changed_instances are all
                                                   // whose version grew with it; 0: nobody counts, all is new always
    std::uint64_t list_version = 0;  // the version since which an index means the same instance, that is seen and casts
                                     // as it did; 0: not known
    math::BoundsTree tree;           // over the instances' bounds, by systems/extract/scene_tree.h; may be left out
    /// By mesh: boxes around its triangles, in its own space, as assets::Mesh::shape has them. Null, or none at all:
    /// the instances' bounds stand for it, as they must where a mesh changes.
    std::vector<std::shared_ptr<const math::ShapeTree>> shapes;
    SampledDepths sampled_depths;  // measured, not extracted: by systems/lighting/depth_sampler.h; may be left out
    /// By what the picture's radiance is multiplied before the tone curve, where that is known: lights are then left
    /// out of shadowing whose shadows nobody could see (systems/shadow/culling/contribution_culling.h). Empty: none is.
    std::optional<double> exposure = {};
    std::uint64_t tree_version = 0;  // the version it is of; of another one it is not used
};

}  // namespace gnomon
