#include "systems/extract/extract.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "components/mesh_ref.h"
#include "components/name.h"
#include "components/shadow_caster.h"
#include "engine/math/frustum.h"
#include "systems/extract/flat_range.h"
#include "systems/extract/scene_tree.h"

namespace gnomon {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

DropReason drop_reason(TransformFault fault) {
    switch (fault) {
        case TransformFault::zero_rotation:
            return DropReason::zero_rotation;
        case TransformFault::parent_missing:
            return DropReason::parent_missing;
        case TransformFault::parent_cycle:
            return DropReason::parent_cycle;
        case TransformFault::none:
        case TransformFault::not_finite:
            break;
    }
    return DropReason::non_finite_transform;
}

/// Direction only: a light's or camera's scale and shear do not count. Columns right, up, back; orthonormal.
glm::dmat3 orientation(const glm::dmat3& basis) {
    const glm::dvec3 back = basis[2];
    if (!(glm::length(back) > 0.0)) return glm::dmat3(1.0);
    const glm::dvec3 z =
        glm::normalize(back / glm::max(std::abs(back.x), glm::max(std::abs(back.y), std::abs(back.z))));
    const glm::dvec3 across = glm::cross(basis[1], z);
    if (!(glm::length(across) > 0.0)) return math::basis_from_back(z);
    const glm::dvec3 x = glm::normalize(across);
    return {x, glm::cross(z, x), z};
}

bool usable(const Light& light) {
    const bool numbers = std::isfinite(light.intensity) && light.intensity >= 0.0f && std::isfinite(light.range_m) &&
                         light.range_m >= 0.0f && light.colour.r >= 0.0f && light.colour.g >= 0.0f &&
                         light.colour.b >= 0.0f && std::isfinite(light.colour.r + light.colour.g + light.colour.b);
    // Shaders multiply them in float: infinite light is no number where nothing of it arrives.
    if (!numbers || !std::isfinite(light.intensity * (light.colour.r + light.colour.g + light.colour.b))) return false;
    return light.kind != LightKind::spot ||
           (light.outer_cone_rad > 0.0f && light.outer_cone_rad <= glm::half_pi<float>() * 1.000001f &&
            light.inner_cone_rad >= 0.0f && light.inner_cone_rad <= light.outer_cone_rad);
}

bool usable(const Camera& camera) {
    if (!(camera.near_m < camera.far_m)) return false;
    if (camera.projection == CameraProjection::orthographic)
        return camera.half_height_m > 0.0 && std::isfinite(camera.half_height_m) && std::isfinite(camera.far_m) &&
               std::isfinite(camera.near_m);
    return camera.near_m > 0.0 && camera.fov_y_rad > 0.0 && camera.fov_y_rad < glm::pi<double>();
}

/// Where joints place the mesh, its own transform does not count.
bool place_bent(InstanceItem& item, const PoseItem& pose) {
    item.basis = glm::dmat3(1.0);
    item.translation_ws_m = pose.origin_ws_m;
    item.bounds_ws = {pose.bounds_ms.min + pose.origin_ws_m, pose.bounds_ms.max + pose.origin_ws_m};
    item.mirrored = pose.mirroring == assets::Mirroring::all;
    item.folded = pose.mirroring == assets::Mirroring::some;
    return !math::is_empty(item.bounds_ws) && math::is_finite(item.bounds_ws);
}

bool place(InstanceItem& item, const WorldTransform& world, const assets::Mesh& mesh, const PoseItem* pose) {
    if (pose && pose->skinned) return place_bent(item, *pose);
    item.basis = world.basis;
    item.translation_ws_m = world.translation_ws_m;
    item.bounds_ws = math::transformed(pose ? pose->bounds_ms : mesh.bounds_ms, world.basis, world.translation_ws_m);
    const double determinant = glm::determinant(world.basis);
    item.mirrored = determinant < 0.0;
    return determinant != 0.0 && !math::is_empty(item.bounds_ws) && math::is_finite(item.bounds_ws);
}

LightItem light_item(const ecs::Registry& registry, ecs::Entity e, const Light& light, const WorldTransform& world) {
    LightItem item;
    item.entity = e;
    item.name = name_of(registry, e);
    item.kind = light.kind;
    item.position_ws_m = world.translation_ws_m;
    item.rotation_ws = orientation(world.basis);
    item.colour = light.colour;
    item.intensity = light.intensity;
    item.range_m = light.range_m;
    item.inner_cone_rad = light.inner_cone_rad;
    item.outer_cone_rad = std::min(static_cast<double>(light.outer_cone_rad), glm::half_pi<double>());
    if (const LightShadow* shadow = registry.get<LightShadow>(e)) {
        item.has_shadow = true;
        item.shadow = *shadow;
    }
    return item;
}

ConsumerItem consumer_item(const ecs::Registry& registry, ecs::Entity e, const Camera& camera,
                           const WorldTransform& world, glm::uvec2 viewport_px) {
    return {e,
            name_of(registry, e),
            world.translation_ws_m,
            orientation(world.basis),
            camera.projection,
            camera.fov_y_rad,
            camera.half_height_m,
            camera.near_m,
            camera.far_m,
            viewport_px};
}

template <class Item>
void sort_by_entity(std::vector<Item>& items) {
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.entity.index < b.entity.index; });
}

/// None at all where no mesh has one: then nobody looks for any.
void list_shapes(const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    snapshot.shapes.clear();
    const auto has_shape = [](const assets::Mesh& mesh) { return mesh.shape != nullptr && !mesh.deformer; };
    if (std::none_of(library.meshes.begin(), library.meshes.end(), has_shape)) return;
    for (const assets::Mesh& mesh : library.meshes) snapshot.shapes.push_back(has_shape(mesh) ? mesh.shape : nullptr);
}

/// Reports and files name lights: a repeated name gets .1, .2, …
void make_names_unique(std::vector<LightItem>& lights) {
    std::set<std::string> taken;
    for (LightItem& light : lights) {
        const std::string wish = light.name;
        for (int n = 1; !taken.insert(light.name).second; ++n) light.name = wish + "." + std::to_string(n);
    }
}

/// Orthographic cameras look no farther than there is something to see.
void narrow_flat_views(const ecs::Registry& registry, SceneSnapshot& snapshot) {
    for (ConsumerItem& consumer : snapshot.consumers) {
        if (consumer.projection != CameraProjection::orthographic) continue;
        const Camera& camera = *registry.get<Camera>(consumer.entity);
        consumer.near_m = camera.near_m;
        consumer.far_m = camera.far_m;
        const ViewRange range = flat_range(snapshot, consumer);
        consumer.near_m = range.near_m;
        consumer.far_m = range.far_m;
    }
}

}  // namespace

std::string name_of(const ecs::Registry& registry, ecs::Entity e) {
    const Name* name = registry.get<Name>(e);
    return name && !name->text.empty() ? name->text : "entity" + std::to_string(e.index);
}

template <class T>
bool Extractor::read_changes(ecs::Registry& registry, ecs::ChangeCursor& cursor, bool structural) {
    const ecs::Changes changes = registry.changes<T>(cursor);
    bool anew = !changes.complete;
    for (const ecs::Change& change : changes.entries) {
        if (structural || change.kind != ecs::ChangeKind::changed)
            anew = true;
        else
            moved_.push_back(change.entity);
    }
    return anew;
}

void Extractor::list_instance(const ecs::Registry& registry, const assets::MeshLibrary& library, ecs::Entity entity,
                              SceneSnapshot& snapshot) {
    const MeshRef& ref = *registry.get<MeshRef>(entity);
    if (ref.mesh >= library.meshes.size()) {
        unusable_.push_back({entity, name_of(registry, entity), DropReason::unknown_mesh});
        return;
    }
    const assets::Mesh& mesh = library.meshes[ref.mesh];
    if (mesh.indices.empty()) return;
    InstanceItem item;
    item.entity = entity;
    item.mesh = ref.mesh;
    item.visible = ref.visible;
    item.receives = ref.receives_shadow;
    item.receive_layers = ref.shadow_layers;
    if (const ShadowCaster* caster = registry.get<ShadowCaster>(entity)) {
        item.casts = caster->enabled;
        item.cast_layers = caster->layers;
    }
    if (!place(item, *registry.get<WorldTransform>(entity), mesh, pose_of(snapshot, ref.mesh))) {
        unusable_.push_back({entity, name_of(registry, entity), DropReason::zero_scale});
        return;
    }
    snapshot.instances.push_back(item);
}

void Extractor::assign_slots(SceneSnapshot& snapshot) {
    for (ecs::Entity& owner : slot_owner_) {
        const bool listed = owner.index < instance_of_.size() && instance_of_[owner.index] != kNone &&
                            snapshot.instances[instance_of_[owner.index]].entity == owner;
        if (!listed) owner = ecs::kNull;
    }
    std::uint32_t next_free = 0;
    for (InstanceItem& item : snapshot.instances) {
        if (item.entity.index >= slot_of_.size()) slot_of_.resize(item.entity.index + 1u, kNone);
        std::uint32_t& slot = slot_of_[item.entity.index];
        if (slot == kNone || slot_owner_[slot] != item.entity) {
            while (next_free < slot_owner_.size() && slot_owner_[next_free] != ecs::kNull) ++next_free;
            if (next_free == slot_owner_.size()) slot_owner_.push_back(ecs::kNull);
            slot = next_free;
            slot_owner_[slot] = item.entity;
        }
        item.gpu_slot = slot;
    }
    snapshot.gpu_slot_count = static_cast<std::uint32_t>(slot_owner_.size());
}

void Extractor::make_lists(const ecs::Registry& registry, const assets::MeshLibrary& library,
                           const TransformReport& transforms, SceneSnapshot& snapshot) {
    const std::vector<InstanceItem> before = std::move(snapshot.instances);
    snapshot.instances.clear();
    snapshot.lights.clear();
    snapshot.consumers.clear();
    list_shapes(library, snapshot);
    poses_.list(registry, library, snapshot);
    unusable_.clear();
    registry.each<MeshRef, WorldTransform>(
        [&](ecs::Entity e, const MeshRef&, const WorldTransform&) { list_instance(registry, library, e, snapshot); });
    registry.each<Light, WorldTransform>([&](ecs::Entity e, const Light& light, const WorldTransform& world) {
        if (usable(light))
            snapshot.lights.push_back(light_item(registry, e, light, world));
        else
            unusable_.push_back({e, name_of(registry, e), DropReason::absurd_light});
    });
    registry.each<Camera, WorldTransform>([&](ecs::Entity e, const Camera& camera, const WorldTransform& world) {
        if (!camera.active) return;
        if (usable(camera))
            snapshot.consumers.push_back(consumer_item(registry, e, camera, world, viewport_px_));
        else
            unusable_.push_back({e, name_of(registry, e), DropReason::absurd_camera});
    });
    sort_by_entity(snapshot.instances);
    sort_by_entity(snapshot.lights);
    sort_by_entity(snapshot.consumers);
    make_names_unique(snapshot.lights);

    instance_of_.assign(instance_of_.size(), kNone);
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        const std::uint32_t index = snapshot.instances[i].entity.index;
        if (index >= instance_of_.size()) instance_of_.resize(index + 1u, kNone);
        instance_of_[index] = i;
    }
    assign_slots(snapshot);
    for (LightItem& light : snapshot.lights) light.version = snapshot.version;
    bent_.clear();
    // Whoever is exactly as before keeps its version, so that its light's maps hold.
    std::size_t old = 0;
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        InstanceItem& item = snapshot.instances[i];
        while (old < before.size() && before[old].entity.index < item.entity.index) ++old;
        const InstanceItem* was = old < before.size() && before[old].entity == item.entity ? &before[old] : nullptr;
        const PoseItem* pose = pose_of(snapshot, item.mesh);
        if (pose) bent_.push_back(i);
        const bool placed = was && !(pose && pose->version == snapshot.version) && was->mesh == item.mesh &&
                            was->gpu_slot == item.gpu_slot && was->basis == item.basis &&
                            was->translation_ws_m == item.translation_ws_m;
        item.version = placed ? was->version : snapshot.version;
        const bool same = placed && was->receives == item.receives && was->receive_layers == item.receive_layers &&
                          was->casts == item.casts && was->cast_layers == item.cast_layers;
        // One that touch_moved() had already moved when it gave up equals itself, but is not on the device.
        if (!same || was->version == snapshot.version) snapshot.changed_instances.push_back(i);
    }
    snapshot.dropped = unusable_;
    for (const QuarantinedEntity& q : transforms.quarantined)
        snapshot.dropped.push_back({q.entity, name_of(registry, q.entity), drop_reason(q.fault)});
    sort_by_entity(snapshot.dropped);
}

/// Instances that are bent otherwise than in the last frame. False if one cannot be used any more.
bool Extractor::touch_bent(const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    for (const std::uint32_t i : bent_) {
        InstanceItem& item = snapshot.instances[i];
        const PoseItem& pose = *pose_of(snapshot, item.mesh);
        const bool moved = pose.skinned && item.translation_ws_m != pose.origin_ws_m;
        if (!moved && pose.version != snapshot.version) continue;
        if (!place(item, {item.basis, item.translation_ws_m}, library.meshes[item.mesh], &pose)) return false;
        item.version = snapshot.version;
        snapshot.changed_instances.push_back(i);
    }
    return true;
}

/// Entities whose WorldTransform alone changed, updated in place. False if one cannot be used any more.
bool Extractor::touch_moved(const ecs::Registry& registry, const assets::MeshLibrary& library,
                            SceneSnapshot& snapshot) {
    for (const ecs::Entity e : moved_) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        if (!world) continue;
        if (e.index < instance_of_.size() && instance_of_[e.index] != kNone) {
            InstanceItem& item = snapshot.instances[instance_of_[e.index]];
            const PoseItem* pose = pose_of(snapshot, item.mesh);
            if (pose && pose->skinned) continue;  // touch_bent() has seen to it
            if (!place(item, *world, library.meshes[item.mesh], pose)) return false;
            if (item.version != snapshot.version) snapshot.changed_instances.push_back(instance_of_[e.index]);
            item.version = snapshot.version;
        }
        for (LightItem& light : snapshot.lights) {
            if (light.entity != e) continue;
            light.position_ws_m = world->translation_ws_m;
            light.rotation_ws = orientation(world->basis);
            light.version = snapshot.version;
        }
        for (ConsumerItem& consumer : snapshot.consumers) {
            if (consumer.entity != e) continue;
            consumer.position_ws_m = world->translation_ws_m;
            consumer.rotation_ws = orientation(world->basis);
        }
    }
    return true;
}

void Extractor::update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                       glm::uvec2 viewport_px, SceneSnapshot& snapshot) {
    moved_.clear();
    snapshot.changed_instances.clear();
    bool anew = !started_ || transforms.quarantined != quarantined_;
    anew |= read_changes<WorldTransform>(registry, cursors_.world, false);
    anew |= read_changes<MeshRef>(registry, cursors_.mesh, true);
    anew |= read_changes<ShadowCaster>(registry, cursors_.caster, true);
    anew |= read_changes<Light>(registry, cursors_.light, true);
    anew |= read_changes<LightShadow>(registry, cursors_.shadow, true);
    anew |= read_changes<Camera>(registry, cursors_.camera, true);
    anew |= read_changes<Name>(registry, cursors_.name, true);
    anew |= read_changes<Skin>(registry, cursors_.skin, true);
    anew |= read_changes<MorphWeights>(registry, cursors_.weights, false);
    const bool resized = viewport_px != viewport_px_;
    if (resized) {
        viewport_px_ = viewport_px;
        for (ConsumerItem& consumer : snapshot.consumers) consumer.viewport_px = viewport_px;
        snapshot.tree_version = ++snapshot.version;
    }
    // A mesh scaled to nothing, or back to something, changes who is listed at all.
    for (const ecs::Entity e : moved_) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        const bool listed = e.index < instance_of_.size() && instance_of_[e.index] != kNone;
        const bool placed = world && registry.has<MeshRef>(e) && !registry.has<Skin>(e);
        if (placed && listed != (glm::determinant(world->basis) != 0.0)) anew = true;
    }
    if (!anew && moved_.empty()) {
        if (resized) narrow_flat_views(registry, snapshot);
        return;
    }
    started_ = true;
    quarantined_ = transforms.quarantined;
    ++snapshot.version;
    const bool bends = !anew && poses_.follows(moved_);
    if (bends) poses_.update(registry, library, snapshot);
    if (anew || (bends && !touch_bent(library, snapshot)) || !touch_moved(registry, library, snapshot)) {
        snapshot.changed_instances.clear();
        make_lists(registry, library, transforms, snapshot);
        snapshot.list_version = snapshot.version;
        build_tree(snapshot);
    } else {
        refit_tree(snapshot);
    }
    narrow_flat_views(registry, snapshot);
    std::sort(snapshot.changed_instances.begin(), snapshot.changed_instances.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                  return snapshot.instances[a].gpu_slot < snapshot.instances[b].gpu_slot;
              });
}

}  // namespace gnomon
