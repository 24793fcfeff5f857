#include "systems/extract/extract.h"

#include <algorithm>
#include <array>

#include "gnomon/components.h"
#include "systems/extract/camera_view.h"
#include "systems/extract/flat_range.h"
#include "systems/extract/names.h"
#include "systems/extract/scene_tree.h"

namespace gnomon {
namespace {

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

template <class Item>
void sort_by_entity(std::vector<Item>& items) {
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.entity.index < b.entity.index; });
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
    for (std::vector<ecs::Entity>* list : {&came_, &moved_, &shown_, &fogged_, &edited_, &named_}) list->clear();
    Lists anew;
    anew.instances |= read_changes<WorldTransform>(registry, cursors_.world, &moved_, &came_);
    anew.instances |= read_changes<MorphWeights>(registry, cursors_.weights, &moved_, nullptr);
    anew.instances |= read_changes<Skin>(registry, cursors_.skin, nullptr, nullptr);
    anew.instances |= read_changes<MeshRef>(registry, cursors_.mesh, &shown_, &came_);
    anew.instances |= read_changes<ShadowCaster>(registry, cursors_.caster, &shown_, &shown_);
    anew.instances |= read_changes<FogVolume>(registry, cursors_.fog, &fogged_, &came_);
    anew.views |= read_changes<Light>(registry, cursors_.light, &edited_, nullptr);
    anew.views |= read_changes<LightShadow>(registry, cursors_.shadow, &edited_, &edited_);
    anew.views |= read_changes<ShadowTuning>(registry, cursors_.tuning, &edited_, &edited_);
    anew.views |= read_changes<Camera>(registry, cursors_.camera, &edited_, nullptr);
    anew.views |= read_changes<Name>(registry, cursors_.name, &named_, &named_);
    return anew;
}

/// Lists lights, cameras and dropped entities. The cost does not grow with the instances.
void Extractor::list_views(const ecs::Registry& registry, const TransformReport& transforms, SceneSnapshot& snapshot) {
    views_.list(registry, viewport_px_, snapshot);
    snapshot.dropped = instances_.unusable();
    for (DroppedEntity& dropped : snapshot.dropped) dropped.name = name_of(registry, dropped.entity);
    snapshot.dropped.insert(snapshot.dropped.end(), views_.unusable().begin(), views_.unusable().end());
    for (const QuarantinedEntity& q : transforms.quarantined)
        snapshot.dropped.push_back({q.entity, name_of(registry, q.entity), drop_reason(q.fault)});
    sort_by_entity(snapshot.dropped);
}

/// Updates lights and cameras that moved or were written.
LightsAndCameras::Effect Extractor::touch_views(const ecs::Registry& registry, SceneSnapshot& snapshot) {
    using Effect = LightsAndCameras::Effect;
    Effect effect = Effect::none;
    for (const std::vector<ecs::Entity>* touched : {&came_, &moved_, &edited_})
        for (const ecs::Entity e : *touched) effect = std::max(effect, views_.touch(registry, e, snapshot));
    return std::max(effect, views_.rename(registry, named_, snapshot));
}

/// Applies all written entities in place, as snapshot.version. Returns the lists to rebuild instead.
Extractor::Touched Extractor::touch(const ecs::Registry& registry, const assets::MeshLibrary& library,
                                    SceneSnapshot& snapshot) {
    constexpr Touched kAllAnew{true, {true, true}};
    using Splice = InstanceExtractor::Splice;
    instances_.append_exchanged(registry, moved_, shown_, snapshot, came_);
    instances_.append_exchanged_fog(registry, fogged_, snapshot, came_);
    if (poses_.depends_on(registry, came_)) return kAllAnew;
    const Splice splice = instances_.splice(registry, library, came_, snapshot);
    if (splice == Splice::impossible) return kAllAnew;
    const bool bends = poses_.follows(moved_);
    if (bends) poses_.update(registry, library, snapshot);
    if ((bends && !instances_.bend(library, snapshot)) || !instances_.move(registry, library, moved_, snapshot))
        return kAllAnew;
    const bool shown = instances_.mark(registry, shown_, snapshot);
    const bool fogged = instances_.change_fog(registry, fogged_, snapshot);
    const LightsAndCameras::Effect effect = touch_views(registry, snapshot);
    return {splice == Splice::done || shown || fogged || !moved_.empty() || effect != LightsAndCameras::Effect::none,
            {false, effect == LightsAndCameras::Effect::listing}};
}

void Extractor::update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                       glm::uvec2 viewport_px, SceneSnapshot& snapshot, std::span<const std::uint32_t> lacking) {
    snapshot.changed_instances.clear();
    Lists anew = read_all(registry);
    anew.instances |= instances_.any_mesh_changed(library, lacking, snapshot);
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
    const auto is_empty = [](const auto* list) { return list->empty(); };
    const std::array lists{&came_, &moved_, &shown_, &fogged_, &edited_, &named_};
    if (changed || !std::all_of(lists.begin(), lists.end(), is_empty)) {
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
        if (anew.instances) {
            poses_.list(registry, library, snapshot);
            instances_.list(registry, library, snapshot);
        }
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
