#include "systems/extract/extract.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <optional>

#include "gnomon/components.h"
#include "systems/extract/camera_view.h"
#include "systems/extract/drawable_basis.h"
#include "systems/extract/flat_range.h"
#include "systems/extract/names.h"
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

/// Places an instance by its joints; its own transform is ignored. Returns false if it is unusable.
bool place_bent(InstanceItem& item, const PoseItem& pose) {
    item.basis = glm::dmat3(1.0);
    item.translation_ws_m = pose.origin_ws_m;
    item.bounds_ws = {pose.bounds_ms.min + pose.origin_ws_m, pose.bounds_ms.max + pose.origin_ws_m};
    item.winding.mirrored = pose.mirroring == assets::Mirroring::all;
    item.winding.folded = pose.mirroring == assets::Mirroring::some;
    return !math::is_empty(item.bounds_ws) && math::is_finite(item.bounds_ws);
}

bool place(InstanceItem& item, const WorldTransform& world, const assets::Mesh& mesh, const PoseItem* pose) {
    if (pose && pose->skinned) return place_bent(item, *pose);
    const std::optional<glm::dmat3> basis = drawable_basis(world.basis);
    if (!basis) return false;
    item.basis = *basis;
    item.translation_ws_m = world.translation_ws_m;
    item.bounds_ws = math::transformed(pose ? pose->bounds_ms : mesh.bounds_ms, *basis, world.translation_ws_m);
    item.winding.mirrored = glm::determinant(*basis) < 0.0;
    return !math::is_empty(item.bounds_ws) && math::is_finite(item.bounds_ws);
}

enum class IndexSet : std::uint8_t { same, changed, recorded };

/// Updates what an instance shows and casts, without its place. `recorded`: its record on the device changed, too.
IndexSet put_marks(const ecs::Registry& registry, const MeshRef& ref, InstanceItem& item) {
    const InstanceItem was = item;
    const ShadowCaster* caster = registry.get<ShadowCaster>(item.entity);
    item.visible = ref.visible;
    item.shadow_catcher = ref.shadow_catcher;
    item.receives = ref.receives_shadow;
    item.receive_layers = ref.shadow_layers;
    item.casts = caster && caster->enabled;
    item.cast_layers = caster ? caster->layers : kAllShadowLayers;
    if (was.receives != item.receives || was.receive_layers != item.receive_layers || was.casts != item.casts ||
        was.cast_layers != item.cast_layers)
        return IndexSet::recorded;
    const bool seen_alike = was.visible == item.visible && was.shadow_catcher == item.shadow_catcher;
    return seen_alike ? IndexSet::same : IndexSet::changed;
}

template <class Item>
void sort_by_entity(std::vector<Item>& items) {
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.entity.index < b.entity.index; });
}

/// Lists the shapes of rigid meshes. The list is empty if no mesh has one, so that users can skip it.
void list_shapes(const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    snapshot.shapes.clear();
    const auto has_shape = [](const assets::Mesh& mesh) { return mesh.shape != nullptr && !mesh.deformer; };
    if (std::none_of(library.meshes.begin(), library.meshes.end(), has_shape)) return;
    for (const assets::Mesh& mesh : library.meshes) snapshot.shapes.push_back(has_shape(mesh) ? mesh.shape : nullptr);
}

/// Lets go of the shapes of meshes that went.
void free_shapes(const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    for (std::size_t m = 0; m < snapshot.shapes.size(); ++m)
        if (snapshot.shapes[m] != library.meshes[m].shape) snapshot.shapes[m] = nullptr;
}

/// Limits the range of orthographic cameras to the visible scene.
void narrow_flat_views(const ecs::Registry& registry, std::vector<glm::dvec3>& scratch, SceneSnapshot& snapshot) {
    for (ConsumerItem& consumer : snapshot.consumers) {
        if (consumer.projection != CameraProjection::orthographic) continue;
        const Camera& camera = *registry.get<Camera>(consumer.entity);
        set_range(camera, consumer);
        const ViewRange range = flat_range(snapshot, consumer, scratch);
        consumer.near_m = range.near_m;
        consumer.far_m = range.far_m;
    }
}

}  // namespace

/// Appends entities with a changed T to `written`, and entities that gained or lost a T to `came_or_went`. Returns true
/// if all entities must be checked: a list is missing (null), or the log was incomplete.
template <class T>
bool Extractor::read_changes(ecs::Registry& registry, ecs::ChangeCursor& cursor, std::vector<ecs::Entity>* written,
                             std::vector<ecs::Entity>* came_or_went) {
    const ecs::Changes changes = registry.changes<T>(cursor);
    bool all = !changes.complete;
    for (const ecs::Change& change : changes.entries) {
        std::vector<ecs::Entity>* const list = change.kind == ecs::ChangeKind::changed ? written : came_or_went;
        if (list)
            list->push_back(change.entity);
        else
            all = true;
    }
    return all;
}

/// Reads all logs. Returns the lists that the logs cannot update entity by entity.
Extractor::Lists Extractor::read_all(ecs::Registry& registry) {
    for (std::vector<ecs::Entity>* list : {&moved_, &shown_, &edited_, &named_}) list->clear();
    Lists anew;
    anew.instances |= read_changes<WorldTransform>(registry, cursors_.world, &moved_, nullptr);
    anew.instances |= read_changes<MorphWeights>(registry, cursors_.weights, &moved_, nullptr);
    anew.instances |= read_changes<Skin>(registry, cursors_.skin, nullptr, nullptr);
    anew.instances |= read_changes<MeshRef>(registry, cursors_.mesh, &shown_, nullptr);
    anew.instances |= read_changes<ShadowCaster>(registry, cursors_.caster, &shown_, &shown_);
    anew.views |= read_changes<Light>(registry, cursors_.light, &edited_, nullptr);
    anew.views |= read_changes<LightShadow>(registry, cursors_.shadow, &edited_, &edited_);
    anew.views |= read_changes<ShadowTuning>(registry, cursors_.tuning, &edited_, &edited_);
    anew.views |= read_changes<Camera>(registry, cursors_.camera, &edited_, nullptr);
    anew.views |= read_changes<Name>(registry, cursors_.name, &named_, &named_);
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
    if (mesh.indices.empty() && !library.is_removed(ref.mesh)) return;
    const bool lacks = std::binary_search(lacking_.begin(), lacking_.end(), ref.mesh);
    if (mesh.indices.empty() || lacks) {
        unusable_.push_back(
            {entity, name_of(registry, entity), lacks ? DropReason::meshes_full : DropReason::unknown_mesh});
        return;
    }
    InstanceItem item;
    item.entity = entity;
    item.mesh = ref.mesh;
    item.mesh_version = library.version_of(ref.mesh);
    put_marks(registry, ref, item);
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

void Extractor::list_instances(const ecs::Registry& registry, const assets::MeshLibrary& library,
                               SceneSnapshot& snapshot) {
    const std::vector<InstanceItem> before = std::move(snapshot.instances);
    snapshot.instances.clear();
    snapshot.changed_instances.clear();
    list_shapes(library, snapshot);
    poses_.list(registry, library, snapshot);
    unusable_.clear();
    registry.each<MeshRef, WorldTransform>(
        [&](ecs::Entity e, const MeshRef&, const WorldTransform&) { list_instance(registry, library, e, snapshot); });
    sort_by_entity(snapshot.instances);

    instance_of_.assign(instance_of_.size(), kNone);
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        const std::uint32_t index = snapshot.instances[i].entity.index;
        if (index >= instance_of_.size()) instance_of_.resize(index + 1u, kNone);
        instance_of_[index] = i;
    }
    assign_slots(snapshot);
    bent_.clear();
    // An unchanged instance keeps its version, so that maps that show it stay valid.
    std::size_t old = 0;
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        InstanceItem& item = snapshot.instances[i];
        while (old < before.size() && before[old].entity.index < item.entity.index) ++old;
        const InstanceItem* was = old < before.size() && before[old].entity == item.entity ? &before[old] : nullptr;
        const PoseItem* pose = pose_of(snapshot, item.mesh);
        if (pose) bent_.push_back(i);
        const bool placed = was && !(pose && pose->version == snapshot.version) && was->mesh == item.mesh &&
                            was->mesh_version == item.mesh_version && was->gpu_slot == item.gpu_slot &&
                            was->basis == item.basis && was->translation_ws_m == item.translation_ws_m;
        item.version = placed ? was->version : snapshot.version;
        const bool same = placed && was->receives == item.receives && was->receive_layers == item.receive_layers &&
                          was->casts == item.casts && was->cast_layers == item.cast_layers;
        // An instance that touch_moved() already moved before it failed equals itself, but is not on the device.
        if (!same || was->version == snapshot.version) snapshot.changed_instances.push_back(i);
    }
    snapshot.list_version = snapshot.version;
    build_tree(snapshot);
}

/// Lists lights, cameras and dropped entities. The cost does not grow with the instances.
void Extractor::list_views(const ecs::Registry& registry, const TransformReport& transforms, SceneSnapshot& snapshot) {
    views_.list(registry, viewport_px_, snapshot);
    snapshot.dropped = unusable_;
    for (DroppedEntity& dropped : snapshot.dropped) dropped.name = name_of(registry, dropped.entity);
    snapshot.dropped.insert(snapshot.dropped.end(), views_.unusable().begin(), views_.unusable().end());
    for (const QuarantinedEntity& q : transforms.quarantined)
        snapshot.dropped.push_back({q.entity, name_of(registry, q.entity), drop_reason(q.fault)});
    sort_by_entity(snapshot.dropped);
}

std::uint32_t Extractor::listed_at(ecs::Entity e) const {
    return e.index < instance_of_.size() ? instance_of_[e.index] : kNone;
}

/// Returns true if an instance shows another mesh than it did, or if a dropped entity may have its mesh now.
bool Extractor::any_mesh_changed(const assets::MeshLibrary& library, std::span<const std::uint32_t> lacking,
                                 SceneSnapshot& snapshot) {
    const bool others_lack = !std::equal(lacking.begin(), lacking.end(), lacking_.begin(), lacking_.end());
    if (others_lack) lacking_.assign(lacking.begin(), lacking.end());
    if (library.version == library_version_) return others_lack;
    library_version_ = library.version;
    free_shapes(library, snapshot);
    const auto is_other = [&](const auto& item) { return item.mesh_version != library.version_of(item.mesh); };
    const auto waits = [](const DroppedEntity& dropped) {
        return dropped.reason == DropReason::unknown_mesh || dropped.reason == DropReason::meshes_full;
    };
    return others_lack || std::any_of(unusable_.begin(), unusable_.end(), waits) ||
           std::any_of(snapshot.poses.begin(), snapshot.poses.end(), is_other) ||
           std::any_of(snapshot.instances.begin(), snapshot.instances.end(), is_other);
}

/// Returns true if a written entity became an instance or stopped being one. Reasons: scaled to nothing or back, or
/// another mesh.
bool Extractor::any_came_or_went(const ecs::Registry& registry, const SceneSnapshot& snapshot) const {
    const auto scaled = [&](ecs::Entity e) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        const bool placed = world && registry.has<MeshRef>(e) && !registry.has<Skin>(e);
        return placed && (listed_at(e) != kNone) != drawable_basis(world->basis).has_value();
    };
    const auto exchanged = [&](ecs::Entity e) {
        const MeshRef* ref = registry.get<MeshRef>(e);
        if (!ref || !registry.has<WorldTransform>(e)) return false;
        const std::uint32_t i = listed_at(e);
        return i == kNone || snapshot.instances[i].mesh != ref->mesh;
    };
    return std::any_of(moved_.begin(), moved_.end(), scaled) || std::any_of(shown_.begin(), shown_.end(), exchanged);
}

/// Updates instances with a changed pose. Returns false if one became unusable.
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

/// Updates instances with a changed WorldTransform in place. Returns false if one became unusable.
bool Extractor::touch_moved(const ecs::Registry& registry, const assets::MeshLibrary& library,
                            SceneSnapshot& snapshot) {
    for (const ecs::Entity e : moved_) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        const std::uint32_t i = listed_at(e);
        if (!world || i == kNone) continue;
        InstanceItem& item = snapshot.instances[i];
        const PoseItem* pose = pose_of(snapshot, item.mesh);
        if (pose && pose->skinned) continue;  // touch_bent() updates these
        if (!place(item, *world, library.meshes[item.mesh], pose)) return false;
        if (item.version != snapshot.version) snapshot.changed_instances.push_back(i);
        item.version = snapshot.version;
    }
    return true;
}

/// Updates what written instances show or cast. A new list_version makes users rebuild their lists of casters and
/// visible instances.
bool Extractor::touch_shown(const ecs::Registry& registry, SceneSnapshot& snapshot) {
    bool any = false;
    for (const ecs::Entity e : shown_) {
        const std::uint32_t i = listed_at(e);
        if (i == kNone) continue;
        InstanceItem& item = snapshot.instances[i];
        const IndexSet marks = put_marks(registry, *registry.get<MeshRef>(e), item);
        any = any || marks != IndexSet::same;
        if (marks == IndexSet::recorded && item.version != snapshot.version) snapshot.changed_instances.push_back(i);
    }
    if (any) snapshot.list_version = snapshot.version;
    return any;
}

/// Updates lights and cameras that moved or were written.
LightsAndCameras::Effect Extractor::touch_views(const ecs::Registry& registry, SceneSnapshot& snapshot) {
    using Effect = LightsAndCameras::Effect;
    Effect effect = Effect::none;
    for (const std::vector<ecs::Entity>* touched : {&moved_, &edited_})
        for (const ecs::Entity e : *touched) effect = std::max(effect, views_.touch(registry, e, snapshot));
    return std::max(effect, views_.rename(registry, named_, snapshot));
}

/// Applies all written entities in place, as snapshot.version. Returns the lists to rebuild instead.
Extractor::Touched Extractor::touch(const ecs::Registry& registry, const assets::MeshLibrary& library,
                                    SceneSnapshot& snapshot) {
    constexpr Touched kAllAnew{true, {true, true}};
    if (any_came_or_went(registry, snapshot)) return kAllAnew;
    const bool bends = poses_.follows(moved_);
    if (bends) poses_.update(registry, library, snapshot);
    if ((bends && !touch_bent(library, snapshot)) || !touch_moved(registry, library, snapshot)) return kAllAnew;
    const bool shown = touch_shown(registry, snapshot);
    const LightsAndCameras::Effect effect = touch_views(registry, snapshot);
    return {shown || !moved_.empty() || effect != LightsAndCameras::Effect::none,
            {false, effect == LightsAndCameras::Effect::listing}};
}

void Extractor::update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                       glm::uvec2 viewport_px, SceneSnapshot& snapshot, std::span<const std::uint32_t> lacking) {
    snapshot.changed_instances.clear();
    Lists anew = read_all(registry);
    anew.instances |= any_mesh_changed(library, lacking, snapshot);
    anew.instances |= !started_ || transforms.quarantined != quarantined_;
    const bool resized = viewport_px != viewport_px_;
    if (resized) {
        viewport_px_ = viewport_px;
        for (ConsumerItem& consumer : snapshot.consumers) {
            consumer.viewport_px = viewport_px;
            if (const Camera* camera = registry.get<Camera>(consumer.entity)) fit_frame(*camera, consumer);
        }
        snapshot.tree_version = ++snapshot.version;
    }
    bool changed = anew.instances || anew.views;
    if (changed || !moved_.empty() || !shown_.empty() || !edited_.empty() || !named_.empty()) {
        ++snapshot.version;
        if (!anew.instances) {
            const Touched touched = touch(registry, library, snapshot);
            changed |= touched.any;
            anew.instances |= touched.leaves.instances;
            anew.views |= touched.leaves.views;
        }
        if (!changed) --snapshot.version;  // written with an equal value
    }
    if (changed) {
        started_ = true;
        quarantined_ = transforms.quarantined;
        if (anew.instances) list_instances(registry, library, snapshot);
        if (anew.instances || anew.views) list_views(registry, transforms, snapshot);
        if (!anew.instances) refit_tree(snapshot);
    }
    if (changed || resized) narrow_flat_views(registry, corners_ws_m_, snapshot);
    std::sort(snapshot.changed_instances.begin(), snapshot.changed_instances.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                  return snapshot.instances[a].gpu_slot < snapshot.instances[b].gpu_slot;
              });
}

}  // namespace gnomon
