#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/place_moves.h"
#include "engine/math/aabb.h"
#include "engine/math/bounds_tree.h"
#include "engine/math/shape_tree.h"
#include "engine/mesh/deformer.h"
#include "gnomon/components.h"
#include "gnomon/frame.h"
#include "gnomon/light.h"
#include "gnomon/shadow_tuning.h"

/// Struct 1 of the frame: all that later stages know of the world, in world space, in double. Filled from another ECS
/// it makes the rest of Gnomon work unchanged.
namespace gnomon {

/// Camera with shadows in its picture.
struct ConsumerItem {
    ecs::Entity entity = {};
    std::string name = {};
    glm::dvec3 position_ws_m{0.0};
    glm::dmat3 rotation_ws{1.0};  // columns right, up, back; orthonormal, right-handed
    CameraProjection projection = CameraProjection::perspective;
    double fov_y_rad = 0.9;
    double half_height_m = 5.0;
    double near_m = 0.05;
    /// May be infinite for perspective; orthographic depths are spread over the whole range (flat_range.h).
    double far_m = 1.0e9;
    glm::uvec2 viewport_px{1280, 720};
    bool operator==(const ConsumerItem&) const = default;
};

/// Sides of an area light, metres: of a rectangle both; the width is also the length of a tube.
struct SourceSides {
    float width_m = 1.0f, height_m = 1.0f;
};

struct LightItem : SourceSides {
    ecs::Entity entity = {};
    std::string name = {};  // unique within the snapshot
    LightKind kind = LightKind::point;
    glm::dvec3 position_ws_m{0.0};
    glm::dmat3 rotation_ws{1.0};  // columns right, up, back; the light shines along -back
    glm::vec3 colour{1.0f};
    float intensity = 0.0f;
    double range_m = 0.0;  // 0: unlimited
    double inner_cone_rad = 0.0, outer_cone_rad = 0.0;
    float source_radius_m = 0.0f;  // lamps
    float sun_radius_rad = 0.0f;   // sun
    bool has_shadow = false;       // a LightShadow component exists
    LightShadow shadow = {};
    ShadowTuning tuning = {};  // the defaults where there is no LightShadow
    // Grows whenever any of the above but name, colour and intensity changed: what shadows follow from.
    std::uint64_t shape_version = 0;
};

/// Pose of a deformable mesh (assets::Mesh::deformer) in this frame.
struct PoseItem {
    std::uint32_t mesh = 0;
    std::uint64_t mesh_version = 0;  // InstanceItem::mesh_version
    bool skinned = false;  // joints alone place its instances, which then stand at origin_ws_m without rotation
    glm::dvec3 origin_ws_m{0.0};
    std::vector<glm::dmat4x3> joints = {};  // from mesh space at rest to the space of its instances
    std::vector<float> weights = {};        // one per target
    math::Aabb bounds_ms = {};              // contains every vertex in the pose
    assets::Mirroring mirroring = assets::Mirroring::none;
    std::uint64_t version = 0;  // grows when joints or weights change
    std::uint64_t since = 0;    // version at which the mesh first had a pose
    double bent_m = 0.0;  // sum over all versions of the largest movement of a vertex, in the instances' space. The
                          // difference between two versions bounds the movement between them
    assets::MeshPose pose() const { return {joints, weights}; }
};

/// Kind of caster without known triangles, and its motion where the engine draws it.
struct DrawableMotion {
    bool by_depth = false;    // it is one: drawn by the engine, or a mesh in buffers of the engine's
    bool drawn = false;       // drawn by the engine
    std::uint64_t since = 0;  // grows whenever its movement is unknown
    /// Sum over all versions of the largest movement of a point. The difference between two versions with the same
    /// `since` bounds the movement between them.
    double moved_m = 0.0;
};

/// Which side of an instance's triangles faces outward.
struct Winding {
    bool mirrored = false;  // negative determinant
    bool folded = false;    // the pose mirrors a part of the mesh: no side is known to face outward
    bool operator==(const Winding&) const = default;
};

/// InstanceItem::mesh of what has none.
inline constexpr std::uint32_t kNoMesh = 0xffffffffu;

/// Placed mesh, or a box of air: a receiver without a surface.
struct InstanceItem {
    ecs::Entity entity = {};
    std::uint32_t mesh = 0;      // kNoMesh: air
    std::uint32_t gpu_slot = 0;  // index of its record in the instance buffer; stable while the entity lives
    glm::dmat3 basis{1.0};
    glm::dvec3 translation_ws_m{0.0};
    math::Aabb bounds_ws = {};  // finite, not empty
    bool casts = false;
    bool receives = true;
    ShadowLayers cast_layers = kAllShadowLayers;
    ShadowLayers receive_layers = kAllShadowLayers;
    bool visible = true;
    bool shadow_catcher = false;  // what is seen of it are the shadows on it
    Winding winding = {};
    DrawableMotion drawable = {};
    std::uint64_t version = 0;       // grows when mesh, place or pose changes, which maps depend on
    std::uint64_t mesh_version = 0;  // assets::MeshLibrary::version_of(mesh): another mesh may take the number
};

/// Returns true if the item is a box of air: it receives anywhere in its bounds, and neither casts nor shows a surface.
inline bool is_air(const InstanceItem& item) { return item.mesh == kNoMesh; }

/// Returns true if the instance casts under this light (first function), or receives its shadows (second).
inline bool casts_under(const LightItem& light, const InstanceItem& item) {
    return item.casts && (light.shadow.layers & item.cast_layers) != 0;
}
inline bool receives_under(const LightItem& light, const InstanceItem& item) {
    return item.receives && (light.shadow.layers & item.receive_layers) != 0;
}

/// Returns true if cameras see the instance's own surface.
inline bool shows_surface(const InstanceItem& item) { return item.visible && !item.shadow_catcher && !is_air(item); }

/// What a box of air shows of lights. Only boxes that show something have one.
struct FogItem {
    std::uint32_t instance = 0;     // index into SceneSnapshot::instances
    glm::dvec3 half_extent_m{0.0};  // along the columns of InstanceItem::basis
    float extinction_per_m = 0.0f;  // above 0
    glm::vec3 albedo{0.0f};
    float anisotropy = 0.0f;
};

/// Air of a scene.
struct SceneAir {
    bool any = false;           // is_air() holds for some instance
    std::vector<FogItem> fogs;  // by rising instance
};

/// Mesh that may be drawn into maps in place of another one (assets::MeshProxy).
struct ProxyItem {
    std::uint32_t mesh = 0;
    double bound_m = 0.0;  // in mesh space
};

/// What is known of meshes, by mesh.
struct MeshFacts {
    /// Boxes around each mesh's triangles, in mesh space (assets::Mesh::shape). Null or missing: the instances' bounds
    /// are used, as they must be for deformable meshes.
    std::vector<std::shared_ptr<const math::ShapeTree>> shapes;
    std::vector<std::vector<ProxyItem>> proxies;  // each by rising bound; empty: no mesh has any
    /// Boxes inside of rigid, opaque meshes (assets::Mesh::inner_ms); empty: none, or others draw the instances.
    std::vector<math::Aabb> inner_boxes_ms;
};

/// Returns the boxes around the mesh's triangles; null: its bounds are all that is known.
inline const math::ShapeTree* shape_of(const MeshFacts& meshes, std::uint32_t mesh) {
    return mesh < meshes.shapes.size() ? meshes.shapes[mesh].get() : nullptr;
}

/// Returns the mesh's proxies, by rising bound.
inline std::span<const ProxyItem> proxies_of(const MeshFacts& meshes, std::uint32_t mesh) {
    return mesh < meshes.proxies.size() ? std::span<const ProxyItem>(meshes.proxies[mesh])
                                        : std::span<const ProxyItem>();
}

/// Returns the box inside of the mesh; empty: none is known.
inline math::Aabb inner_box_of(const MeshFacts& meshes, std::uint32_t mesh) {
    return mesh < meshes.inner_boxes_ms.size() ? meshes.inner_boxes_ms[mesh] : math::Aabb{};
}

struct SceneSnapshot;
/// Returns the mesh's pose; null: at rest.
const PoseItem* pose_of(const SceneSnapshot& scene, std::uint32_t mesh);

/// Instances of drawables that a list has.
struct DrawableKinds {
    bool any_drawn = false;     // DrawableMotion::drawn is set for some instance
    bool any_by_depth = false;  // DrawableMotion::by_depth is set for some instance
};

/// Step from one list of instances to another by which instances came and went, and none changed what it shows or
/// casts.
struct ListSplice {
    std::uint64_t from_version = 0, to_version = 0;  // list_version before and after. 0: no such step
    std::size_t count = 0;                           // instances before
    std::vector<std::uint32_t> added;                // indices after, rising
    std::vector<PlaceMove> moves;                    // instances with another index than before
    /// Returns whether it is the step between two versions of a list that are both known.
    bool leads(std::uint64_t from, std::uint64_t to) const {
        return from != 0 && to != 0 && from == from_version && to == to_version;
    }
};

/// Persists across frames; extraction applies only changes. Lists are sorted by entity index, so that equal worlds give
/// equal snapshots.
struct SceneSnapshot {
    MeshFacts meshes = {};
    std::vector<ConsumerItem> consumers;
    /// Cameras that draw, if shadows are fitted to other cameras; empty: the consumers draw.
    std::vector<ConsumerItem> pictures;
    std::vector<LightItem> lights;
    std::vector<InstanceItem> instances;
    std::vector<PoseItem> poses;  // sorted by mesh, at most one per mesh: all instances of a mesh share a pose
    std::vector<DroppedEntity> dropped;
    std::vector<std::uint32_t> changed_instances;  // instances to upload in this frame, sorted by gpu_slot
    std::uint32_t gpu_slot_count = 0;              // upper bound of all gpu_slots
    DrawableKinds drawables = {};
    SceneAir air = {};
    std::uint64_t version = 0;  // grows with every change; by 1 if changed_instances has all instances with a new
                                // version. 0: changes are not counted, and everything is always new
    /// Latest version at which an index got another instance, or an instance changed what it shows or casts. 0:
    /// unknown.
    std::uint64_t list_version = 0;
    ListSplice list_splice = {};  // how list_version came from the one before, where instances only came and went
    /// Notes that any instance may differ from the list before, in number or in what it shows or casts.
    void renew_list() {
        list_version = version;
        list_splice.to_version = 0;
    }
    math::BoundsTree tree;           // over the instances' bounds, built by systems/extract/scene_tree.h; optional
    std::uint64_t tree_version = 0;  // version of the tree; unused if it differs from `version`
};

}  // namespace gnomon
