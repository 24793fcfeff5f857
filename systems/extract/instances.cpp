#include "systems/extract/instances.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "gnomon/components.h"
#include "systems/extract/drawable_basis.h"
#include "systems/extract/fog_items.h"
#include "systems/extract/names.h"
#include "systems/extract/scene_tree.h"

namespace gnomon {
namespace {

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

enum class Marks : std::uint8_t { same, changed, recorded };

/// Updates what an instance shows and casts, without its place. `recorded`: its record on the device changed, too.
Marks put_marks(const ecs::Registry& registry, const MeshRef& ref, InstanceItem& item) {
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
        return Marks::recorded;
    const bool seen_alike = was.visible == item.visible && was.shadow_catcher == item.shadow_catcher;
    return seen_alike ? Marks::same : Marks::changed;
}

bool earlier(const InstanceItem& a, const InstanceItem& b) { return a.entity.index < b.entity.index; }

/// Lets go of the shapes of meshes that went.
void free_shapes(const assets::MeshLibrary& library, MeshFacts& meshes) {
    for (std::size_t m = 0; m < meshes.shapes.size(); ++m) {
        if (meshes.shapes[m] == library.meshes[m].shape) continue;
        meshes.shapes[m] = nullptr;
        if (m < meshes.inner_boxes_ms.size()) meshes.inner_boxes_ms[m] = {};
    }
}

/// Returns whether nothing is seen through the mesh.
bool is_opaque(const assets::MeshLibrary& library, const assets::Mesh& mesh) {
    return std::all_of(mesh.submeshes.begin(), mesh.submeshes.end(), [&](const assets::Submesh& submesh) {
        return assets::is_opaque(library.materials[submesh.material]);
    });
}

/// Lists the boxes inside of rigid, opaque meshes. The list is empty if no mesh has one.
void list_inner_boxes(const assets::MeshLibrary& library, MeshFacts& meshes) {
    meshes.inner_boxes_ms.clear();
    const auto hides = [&](const assets::Mesh& mesh) {
        return !math::is_empty(mesh.inner_ms) && !mesh.deformer && is_opaque(library, mesh);
    };
    if (std::none_of(library.meshes.begin(), library.meshes.end(), hides)) return;
    for (const assets::Mesh& mesh : library.meshes)
        meshes.inner_boxes_ms.push_back(hides(mesh) ? mesh.inner_ms : math::Aabb{});
}

/// Lists the shapes of rigid meshes. The list is empty if no mesh has one, so that users can skip it.
void list_shapes(const assets::MeshLibrary& library, MeshFacts& meshes) {
    meshes.shapes.clear();
    const auto has_shape = [](const assets::Mesh& mesh) { return mesh.shape != nullptr && !mesh.deformer; };
    if (std::none_of(library.meshes.begin(), library.meshes.end(), has_shape)) return;
    for (const assets::Mesh& mesh : library.meshes) meshes.shapes.push_back(has_shape(mesh) ? mesh.shape : nullptr);
}

/// Lists the proxies of rigid meshes. The list is empty if no mesh has one.
void list_proxies(const assets::MeshLibrary& library, MeshFacts& meshes) {
    meshes.proxies.clear();
    const auto has_some = [](const assets::Mesh& mesh) { return !mesh.proxies.empty() && !mesh.deformer; };
    if (std::none_of(library.meshes.begin(), library.meshes.end(), has_some)) return;
    for (const assets::Mesh& mesh : library.meshes) {
        std::vector<ProxyItem>& proxies = meshes.proxies.emplace_back();
        if (!has_some(mesh)) continue;
        for (const assets::MeshProxy& proxy : mesh.proxies)
            proxies.push_back({proxy.mesh, static_cast<double>(proxy.bound_m)});
    }
}

}  // namespace

/// Appends the entity's item, without slot and version. Returns false if it has none, noted in unusable_ with a reason.
bool InstanceExtractor::append(const ecs::Registry& registry, const assets::MeshLibrary& library, ecs::Entity entity,
                               const SceneSnapshot& snapshot, std::vector<InstanceItem>& items) {
    const auto refuse = [&](DropReason reason) {
        unusable_.push_back({entity, name_of(registry, entity), reason});
        return false;
    };
    const bool has_fog = registry.has<FogVolume>(entity);
    if (has_fog && !is_fog(registry, entity)) refuse(DropReason::absurd_fog);
    if (!registry.has<MeshRef>(entity)) {
        if (!is_fog(registry, entity)) return false;
        const std::optional<InstanceItem> fog = fog_instance(registry, entity);
        if (!fog) return refuse(DropReason::zero_scale);
        items.push_back(*fog);
        return true;
    }
    const MeshRef& ref = *registry.get<MeshRef>(entity);
    if (ref.mesh >= library.meshes.size()) return refuse(DropReason::unknown_mesh);
    const assets::Mesh& mesh = library.meshes[ref.mesh];
    if (mesh.indices.empty() && !library.is_removed(ref.mesh)) return false;
    if (std::binary_search(lacking_.begin(), lacking_.end(), ref.mesh)) return refuse(DropReason::meshes_full);
    if (mesh.indices.empty()) return refuse(DropReason::unknown_mesh);
    InstanceItem item;
    item.entity = entity;
    item.mesh = ref.mesh;
    item.mesh_version = library.version_of(ref.mesh);
    put_marks(registry, ref, item);
    if (!place(item, *registry.get<WorldTransform>(entity), mesh, pose_of(snapshot, ref.mesh)))
        return refuse(DropReason::zero_scale);
    items.push_back(item);
    return true;
}

std::uint32_t InstanceExtractor::listed_at(ecs::Entity e) const {
    return e.index < instance_of_.size() ? instance_of_[e.index] : kNone;
}

bool InstanceExtractor::is_listed(ecs::Entity e, const SceneSnapshot& snapshot) const {
    const std::uint32_t at = listed_at(e);
    return at != kNone && snapshot.instances[at].entity == e;
}

/// Notes where the instances from `first` on are.
void InstanceExtractor::note_places(IndexRange changed, const SceneSnapshot& snapshot) {
    for (std::uint32_t i = changed.first; i < changed.end; ++i) {
        const std::uint32_t index = snapshot.instances[i].entity.index;
        if (index >= instance_of_.size()) instance_of_.resize(index + 1u, kNone);
        instance_of_[index] = i;
    }
}

void InstanceExtractor::note_bent(const SceneSnapshot& snapshot) {
    bent_.clear();
    if (snapshot.poses.empty()) return;
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i)
        if (pose_of(snapshot, snapshot.instances[i].mesh)) bent_.push_back(i);
}

/// Frees the slots of entities that are no longer listed.
void InstanceExtractor::free_slots(const SceneSnapshot& snapshot) {
    for (ecs::Entity& owner : slot_owner_)
        if (!is_listed(owner, snapshot)) owner = ecs::kNull;
    first_free_slot_ = 0;
}

/// Returns the slot that the entity has, or the lowest free one.
std::uint32_t InstanceExtractor::slot_for(ecs::Entity e) {
    if (e.index >= slot_of_.size()) slot_of_.resize(e.index + 1u, kNone);
    std::uint32_t& slot = slot_of_[e.index];
    if (slot != kNone && slot_owner_[slot] == e) return slot;
    while (first_free_slot_ < slot_owner_.size() && slot_owner_[first_free_slot_] != ecs::kNull) ++first_free_slot_;
    if (first_free_slot_ == slot_owner_.size()) slot_owner_.push_back(ecs::kNull);
    slot = first_free_slot_;
    slot_owner_[slot] = e;
    return slot;
}

bool InstanceExtractor::any_mesh_changed(const assets::MeshLibrary& library, std::span<const std::uint32_t> lacking,
                                         SceneSnapshot& snapshot) {
    const bool others_lack = !std::equal(lacking.begin(), lacking.end(), lacking_.begin(), lacking_.end());
    if (others_lack) lacking_.assign(lacking.begin(), lacking.end());
    if (library.version == library_version_) return others_lack;
    library_version_ = library.version;
    free_shapes(library, snapshot.meshes);
    const auto is_other = [&](const auto& item) {
        return item.mesh != kNoMesh && item.mesh_version != library.version_of(item.mesh);
    };
    const auto waits = [](const DroppedEntity& dropped) {
        return dropped.reason == DropReason::unknown_mesh || dropped.reason == DropReason::meshes_full;
    };
    return others_lack || std::any_of(unusable_.begin(), unusable_.end(), waits) ||
           std::any_of(snapshot.poses.begin(), snapshot.poses.end(), is_other) ||
           std::any_of(snapshot.instances.begin(), snapshot.instances.end(), is_other);
}

void InstanceExtractor::list(const ecs::Registry& registry, const assets::MeshLibrary& library,
                             SceneSnapshot& snapshot) {
    const std::vector<InstanceItem> old_items = std::move(snapshot.instances);
    snapshot.instances.clear();
    snapshot.changed_instances.clear();
    unusable_.clear();
    list_shapes(library, snapshot.meshes);
    list_proxies(library, snapshot.meshes);
    list_inner_boxes(library, snapshot.meshes);
    shapes_version_ = library.version;
    registry.each<MeshRef, WorldTransform>([&](ecs::Entity e, const MeshRef&, const WorldTransform&) {
        append(registry, library, e, snapshot, snapshot.instances);
    });
    registry.each<FogVolume, WorldTransform>([&](ecs::Entity e, const FogVolume&, const WorldTransform&) {
        if (!registry.has<MeshRef>(e)) append(registry, library, e, snapshot, snapshot.instances);
    });
    std::sort(snapshot.instances.begin(), snapshot.instances.end(), earlier);
    instance_of_.assign(instance_of_.size(), kNone);
    note_places({0, static_cast<std::uint32_t>(snapshot.instances.size())}, snapshot);
    free_slots(snapshot);
    for (InstanceItem& item : snapshot.instances) item.gpu_slot = slot_for(item.entity);
    snapshot.gpu_slot_count = static_cast<std::uint32_t>(slot_owner_.size());
    note_bent(snapshot);
    list_fogs(registry, snapshot);
    // An unchanged instance keeps its version, so that maps that show it stay valid.
    std::size_t old = 0;
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        InstanceItem& item = snapshot.instances[i];
        while (old < old_items.size() && old_items[old].entity.index < item.entity.index) ++old;
        const InstanceItem* was =
            old < old_items.size() && old_items[old].entity == item.entity ? &old_items[old] : nullptr;
        const PoseItem* pose = pose_of(snapshot, item.mesh);
        const bool placed = was && !(pose && pose->version == snapshot.version) && was->mesh == item.mesh &&
                            was->mesh_version == item.mesh_version && was->gpu_slot == item.gpu_slot &&
                            was->basis == item.basis && was->translation_ws_m == item.translation_ws_m;
        item.version = placed ? was->version : snapshot.version;
        const bool same = placed && was->receives == item.receives && was->receive_layers == item.receive_layers &&
                          was->casts == item.casts && was->cast_layers == item.cast_layers;
        // An instance that move() already moved before it failed equals itself, but is not on the device.
        if (!same || was->version == snapshot.version) snapshot.changed_instances.push_back(i);
    }
    snapshot.renew_list();
    build_tree(snapshot);
}

InstanceExtractor::Splice InstanceExtractor::splice(const ecs::Registry& registry, const assets::MeshLibrary& library,
                                                    std::span<const ecs::Entity> came_or_went,
                                                    SceneSnapshot& snapshot) {
    if (came_or_went.empty()) return Splice::nothing;
    entities_.assign(came_or_went.begin(), came_or_went.end());
    std::sort(entities_.begin(), entities_.end(), [](ecs::Entity a, ecs::Entity b) {
        return a.index != b.index ? a.index < b.index : a.version < b.version;
    });
    entities_.erase(std::unique(entities_.begin(), entities_.end()), entities_.end());
    if (!is_worth_splicing(entities_.size(), snapshot)) return Splice::impossible;
    const auto was_refused = [&](ecs::Entity e) {
        return std::any_of(unusable_.begin(), unusable_.end(),
                           [&](const auto& dropped) { return dropped.entity == e; });
    };
    if (!unusable_.empty() && std::any_of(entities_.begin(), entities_.end(), was_refused)) return Splice::impossible;
    splice_.clear();
    const std::size_t refused = unusable_.size();
    for (const ecs::Entity e : entities_) {
        if (is_listed(e, snapshot)) splice_.removed.push_back(listed_at(e));
        if ((registry.has<MeshRef>(e) || registry.has<FogVolume>(e)) && registry.has<WorldTransform>(e))
            append(registry, library, e, snapshot, splice_.added);
        if (unusable_.size() > refused) return Splice::impossible;
    }
    if (splice_.empty()) return Splice::nothing;
    for (const std::uint32_t i : splice_.removed) {
        const InstanceItem& item = snapshot.instances[i];
        instance_of_[item.entity.index] = kNone;
        const auto added = std::lower_bound(splice_.added.begin(), splice_.added.end(), item, earlier);
        if (added != splice_.added.end() && added->entity == item.entity) continue;
        slot_owner_[item.gpu_slot] = ecs::kNull;
        first_free_slot_ = std::min(first_free_slot_, item.gpu_slot);
    }
    for (InstanceItem& item : splice_.added) item.gpu_slot = slot_for(item.entity);
    snapshot.gpu_slot_count = static_cast<std::uint32_t>(slot_owner_.size());
    if (std::exchange(shapes_version_, library.version) != library.version) {
        list_shapes(library, snapshot.meshes);
        list_proxies(library, snapshot.meshes);
        list_inner_boxes(library, snapshot.meshes);
    }
    note_places(splice_instances(snapshot, splice_), snapshot);
    note_bent(snapshot);
    const bool may_have_air = snapshot.air.any || std::any_of(splice_.added.begin(), splice_.added.end(), is_air);
    if (may_have_air) list_fogs(registry, snapshot);
    return Splice::done;
}

void InstanceExtractor::append_exchanged(const ecs::Registry& registry, std::span<const ecs::Entity> moved,
                                         std::span<const ecs::Entity> shown, const SceneSnapshot& snapshot,
                                         std::vector<ecs::Entity>& list) const {
    for (const ecs::Entity e : moved) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        const bool listed = registry.has<MeshRef>(e) || is_fog(registry, e);
        const bool placed = world && listed && !registry.has<Skin>(e);
        if (placed && (listed_at(e) != kNone) != drawable_basis(world->basis).has_value()) list.push_back(e);
    }
    for (const ecs::Entity e : shown) {
        const MeshRef* ref = registry.get<MeshRef>(e);
        if (!ref || !registry.has<WorldTransform>(e)) continue;
        const std::uint32_t i = listed_at(e);
        if (i == kNone || snapshot.instances[i].mesh != ref->mesh) list.push_back(e);
    }
}

void InstanceExtractor::append_exchanged_fog(const ecs::Registry& registry, std::span<const ecs::Entity> fogged,
                                             const SceneSnapshot& snapshot, std::vector<ecs::Entity>& list) const {
    for (const ecs::Entity e : fogged)
        if (!registry.has<MeshRef>(e) && is_listed(e, snapshot) != fog_instance(registry, e).has_value())
            list.push_back(e);
}

bool InstanceExtractor::bend(const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    for (const std::uint32_t i : bent_) {
        InstanceItem& item = snapshot.instances[i];
        const PoseItem& pose = *pose_of(snapshot, item.mesh);
        const bool moved = pose.skinned && item.translation_ws_m != pose.origin_ws_m;
        if (!moved && pose.version != snapshot.version) continue;
        if (!place(item, {item.basis, item.translation_ws_m}, library.meshes[item.mesh], &pose)) return false;
        if (item.version != snapshot.version) snapshot.changed_instances.push_back(i);
        item.version = snapshot.version;
    }
    return true;
}

bool InstanceExtractor::move(const ecs::Registry& registry, const assets::MeshLibrary& library,
                             std::span<const ecs::Entity> moved, SceneSnapshot& snapshot) {
    for (const ecs::Entity e : moved) {
        const WorldTransform* world = registry.get<WorldTransform>(e);
        const std::uint32_t i = listed_at(e);
        if (!world || i == kNone) continue;
        InstanceItem& item = snapshot.instances[i];
        const PoseItem* pose = pose_of(snapshot, item.mesh);
        if (pose && pose->skinned) continue;  // bend() updates these
        const bool air = is_air(item);
        if (air ? !put_fog(registry, item) : !place(item, *world, library.meshes[item.mesh], pose)) return false;
        if (item.version != snapshot.version) snapshot.changed_instances.push_back(i);
        item.version = snapshot.version;
    }
    return true;
}

bool InstanceExtractor::mark(const ecs::Registry& registry, std::span<const ecs::Entity> shown,
                             SceneSnapshot& snapshot) {
    bool any = false;
    for (const ecs::Entity e : shown) {
        if (!is_listed(e, snapshot)) continue;
        const std::uint32_t i = listed_at(e);
        InstanceItem& item = snapshot.instances[i];
        if (is_air(item)) continue;
        const Marks marks = put_marks(registry, *registry.get<MeshRef>(e), item);
        any = any || marks != Marks::same;
        if (marks == Marks::recorded && item.version != snapshot.version) snapshot.changed_instances.push_back(i);
    }
    if (any) snapshot.renew_list();
    return any;
}

bool InstanceExtractor::change_fog(const ecs::Registry& registry, std::span<const ecs::Entity> fogged,
                                   SceneSnapshot& snapshot) {
    bool any = false;
    for (const ecs::Entity e : fogged) {
        if (!is_listed(e, snapshot) || !is_air(snapshot.instances[listed_at(e)])) continue;
        const std::uint32_t i = listed_at(e);
        put_fog(registry, snapshot.instances[i]);
        if (snapshot.instances[i].version != snapshot.version) snapshot.changed_instances.push_back(i);
        snapshot.instances[i].version = snapshot.version;
        any = true;
    }
    if (any) snapshot.renew_list();
    if (any) list_fogs(registry, snapshot);
    return any;
}

}  // namespace gnomon
