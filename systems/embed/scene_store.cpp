#include "systems/embed/scene_store.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "engine/math/finite.h"
#include "systems/embed/air_box.h"
#include "systems/embed/mesh_of.h"
#include "systems/extract/drawable_basis.h"
#include "systems/extract/scene_tree.h"

namespace gnomon::embed {
namespace {

/// Mesh of everything that the engine draws itself: it has no triangles.
constexpr std::uint32_t kDrawableMesh = 0;

ecs::Entity entity_of(CasterId id) { return {id.index, id.version}; }

bool same_place(const ConsumerItem& a, const ConsumerItem& b) {
    return a.position_ws_m == b.position_ws_m && a.rotation_ws == b.rotation_ws && a.projection == b.projection &&
           a.fov_y_rad == b.fov_y_rad && a.half_height_m == b.half_height_m && a.near_m == b.near_m &&
           a.far_m == b.far_m && a.viewport_px == b.viewport_px && a.entity == b.entity;
}

}  // namespace

SceneStore::SceneStore() : library_(empty_library()) {
    library_.meshes.emplace_back().name = "drawable";  // kDrawableMesh
}

Result<MeshId> SceneStore::add_mesh(const MeshDesc& desc) {
    const auto mesh = embed::add_mesh(desc, library_);
    if (!mesh) return mesh.error();
    return meshes_.add(mesh.value());
}

MeshId SceneStore::add_box(std::string_view name, const Bounds& bounds_ms) {
    return meshes_.add(embed::add_box(name, bounds_ms, library_));
}

void SceneStore::change_box(MeshId mesh, const Bounds& bounds_ms) {
    const std::uint32_t* index = meshes_.find(mesh);
    if (!index || !library_.meshes[*index].indices.empty()) return;
    embed::change_box(*index, bounds_ms, library_);
    changed_boxes_.push_back(*index);
}

void SceneStore::remove(MeshId mesh) {
    const std::uint32_t* index = meshes_.find(mesh);
    if (!index) return;
    remove_mesh(*index, library_);
    meshes_.remove(mesh);
    instances_anew_ = true;
}

CasterId SceneStore::add_caster(const CasterDesc& desc) { return came_.emplace_back(casters_.add({.desc = desc})); }

CasterId SceneStore::add_drawable(const DrawableDesc& desc) {
    return came_.emplace_back(casters_.add({.desc = {.casts = desc.casts,
                                                     .receives = desc.receives,
                                                     .cast_layers = desc.cast_layers,
                                                     .receive_layers = desc.receive_layers},
                                            .draw = desc.draw,
                                            .bounds = desc.bounds}));
}

CasterId SceneStore::add_air(const AirDesc& desc) {
    return came_.emplace_back(casters_.add({.desc = in_air(desc), .air = true}));
}

void SceneStore::set_air(CasterId id, const AirDesc& desc) {
    Caster* caster = casters_.find(id);
    if (caster && caster->air) change(id, *caster, in_air(desc));
}

void SceneStore::redraw(CasterId id, const Bounds& bounds, double moves_at_most_m) {
    Caster* caster = casters_.find(id);
    if (!caster || !caster->draw) return;
    caster->bounds = bounds;
    const bool known = moves_at_most_m >= 0.0 && std::isfinite(caster->moved_m + moves_at_most_m);
    if (known)
        caster->moved_m += moves_at_most_m;
    else
        ++caster->motion_since;
    if (!caster->moved && !caster->marked) changed_.push_back(id);
    caster->moved = true;
}

void SceneStore::set_caster(CasterId id, const CasterDesc& desc) {
    Caster* caster = casters_.find(id);
    if (caster && !caster->draw && !caster->air) change(id, *caster, desc);
}

void SceneStore::change(CasterId id, Caster& caster, const CasterDesc& desc) {
    const bool moved = caster.desc.mesh != desc.mesh || caster.desc.world_from_mesh != desc.world_from_mesh;
    const bool marked = caster.desc.casts != desc.casts || caster.desc.receives != desc.receives ||
                        caster.desc.cast_layers != desc.cast_layers ||
                        caster.desc.receive_layers != desc.receive_layers;
    if (!moved && !marked) return;
    if (caster.desc.mesh != desc.mesh) exchange_mesh(id, caster);
    caster.desc = desc;
    if (!caster.moved && !caster.marked) changed_.push_back(id);
    caster.moved |= moved;
    caster.marked |= marked;
}

/// Marks a caster to be listed again, with another mesh.
void SceneStore::exchange_mesh(CasterId id, Caster& caster) {
    if (caster.instance == kNone) {
        instances_anew_ = true;
        return;
    }
    went_.push_back(std::exchange(caster.instance, kNone));
    came_.push_back(id);
}

void SceneStore::set_transform(CasterId id, const glm::dmat4& world_from_mesh) {
    Caster* caster = casters_.find(id);
    if (!caster || caster->draw || caster->air || caster->desc.world_from_mesh == world_from_mesh) return;
    caster->desc.world_from_mesh = world_from_mesh;
    if (!caster->moved && !caster->marked) changed_.push_back(id);
    caster->moved = true;
}

void SceneStore::remove(CasterId id) {
    const Caster* caster = casters_.find(id);
    if (!caster) return;
    if (caster->instance != kNone)
        went_.push_back(caster->instance);
    else if (std::any_of(dropped_.begin(), dropped_.end(), [&](const Dropped& d) { return d.caster == id; }))
        instances_anew_ = true;
    casters_.remove(id);
}

std::uint32_t SceneStore::mesh_index(MeshId id) const {
    const std::uint32_t* index = meshes_.find(id);
    return index ? *index : kNone;
}

const std::function<void(const DrawableView&)>* SceneStore::draw_of(std::uint32_t instance) const {
    const ecs::Entity entity = snapshot_.instances[instance].entity;
    const Caster* caster = casters_.find({entity.index, entity.version});
    return caster && caster->draw ? &caster->draw : nullptr;
}

/// Returns why a caster cannot be placed; DropReason::instances_full, which no caster has, if it can.
DropReason SceneStore::fault_of(const Caster& caster) const {
    const CasterDesc& desc = caster.desc;
    if (caster.draw) {
        const math::Aabb box{caster.bounds.min_m, caster.bounds.max_m};
        return math::is_finite(box) && !math::is_empty(box) ? DropReason::instances_full
                                                            : DropReason::non_finite_transform;
    }
    if (caster.air) return fault_of_air(desc.world_from_mesh);
    const std::uint32_t* mesh = meshes_.find(desc.mesh);
    if (!mesh) return DropReason::unknown_mesh;
    if (std::binary_search(lacking_.begin(), lacking_.end(), *mesh)) return DropReason::meshes_full;
    if (std::binary_search(lost_.begin(), lost_.end(), *mesh)) return DropReason::buffer_lost;
    const math::Aabb& bounds_ms = library_.meshes[*mesh].bounds_ms;
    if (!math::is_finite(bounds_ms) || math::is_empty(bounds_ms)) return DropReason::non_finite_transform;
    if (!math::is_finite(desc.world_from_mesh)) return DropReason::non_finite_transform;
    const std::optional<glm::dmat3> basis = drawable_basis(glm::dmat3(desc.world_from_mesh));
    if (!basis) return DropReason::zero_scale;
    const math::Aabb box = math::transformed(bounds_ms, *basis, glm::dvec3(desc.world_from_mesh[3]));
    return math::is_finite(box) && !math::is_empty(box) ? DropReason::instances_full : DropReason::zero_scale;
}

/// Writes a usable caster into its item.
void SceneStore::put(Caster& caster, CasterId id, InstanceItem& item) const {
    const CasterDesc& desc = caster.desc;
    item.entity = entity_of(id);
    item.gpu_slot = id.index;
    item.drawable = {.drawn = static_cast<bool>(caster.draw), .since = caster.motion_since, .moved_m = caster.moved_m};
    if (item.drawable.drawn) {
        item.mesh = kDrawableMesh;
        item.bounds_ws = {caster.bounds.min_m, caster.bounds.max_m};
        item.translation_ws_m = math::centre(item.bounds_ws);
        item.drawable.by_depth = true;
    } else if (caster.air) {
        put_air(desc.world_from_mesh, item);
    } else {
        item.mesh = *meshes_.find(desc.mesh);
        item.mesh_version = library_.version_of(item.mesh);
        item.drawable.by_depth = library_.meshes[item.mesh].indices.empty();
        item.basis = *drawable_basis(glm::dmat3(desc.world_from_mesh));
        item.translation_ws_m = glm::dvec3(desc.world_from_mesh[3]);
        item.bounds_ws = math::transformed(library_.meshes[item.mesh].bounds_ms, item.basis, item.translation_ws_m);
    }
    item.winding.mirrored = glm::determinant(item.basis) < 0.0;
    item.casts = desc.casts;
    item.receives = desc.receives;
    item.cast_layers = desc.cast_layers;
    item.receive_layers = desc.receive_layers;
    item.version = caster.version;
}

/// Lists the casters with meshes that changed as changed.
void SceneStore::note_changed_meshes() {
    if (changed_boxes_.empty()) return;
    std::sort(changed_boxes_.begin(), changed_boxes_.end());
    casters_.each([&](CasterId id, Caster& caster) {
        const std::uint32_t* mesh = meshes_.find(caster.desc.mesh);
        if (!mesh || !std::binary_search(changed_boxes_.begin(), changed_boxes_.end(), *mesh)) return;
        if (!caster.moved && !caster.marked) changed_.push_back(id);
        caster.moved = true;
    });
    changed_boxes_.clear();
}

/// Applies changed casters in place. Returns false if one became usable or
/// stopped being so: the list has to be made again.
bool SceneStore::put_changes() {
    const auto lacks = [&](CasterId id) {
        const Caster* caster = casters_.find(id);
        return caster && (caster->instance == kNone || fault_of(*caster) != DropReason::instances_full);
    };
    if (std::any_of(changed_.begin(), changed_.end(), lacks)) return false;
    for (const CasterId id : changed_) {
        Caster* caster = casters_.find(id);
        if (!caster || (!caster->moved && !caster->marked)) continue;
        if (caster->moved) caster->version = snapshot_.version;
        if (caster->marked) snapshot_.renew_list();
        put(*caster, id, snapshot_.instances[caster->instance]);
        snapshot_.changed_instances.push_back(caster->instance);
        caster->moved = caster->marked = false;
    }
    return true;
}

/// Takes casters in and out that came or went. Returns false if one cannot be placed, or there are many: the list has
/// to be made again.
bool SceneStore::splice_casters() {
    if (came_.empty() && went_.empty()) return true;
    if (!is_worth_splicing(came_.size() + went_.size(), snapshot_)) return false;
    splice_.clear();
    std::sort(came_.begin(), came_.end(), [](CasterId a, CasterId b) { return a.index < b.index; });
    std::sort(went_.begin(), went_.end());
    for (const CasterId id : came_) {
        Caster* caster = casters_.find(id);
        if (!caster) continue;
        if (fault_of(*caster) != DropReason::instances_full) return false;
        caster->moved = caster->marked = false;
        caster->version = snapshot_.version;
        put(*caster, id, splice_.added.emplace_back());
    }
    splice_.removed = went_;
    if (splice_.empty()) return true;
    note_casters(splice_instances(snapshot_, splice_));
    return true;
}

/// Notes where the casters of changed indices are, and what the list holds.
void SceneStore::note_casters(IndexRange changed) {
    for (std::uint32_t i = changed.first; i < changed.end; ++i) {
        const ecs::Entity entity = snapshot_.instances[i].entity;
        casters_.find({entity.index, entity.version})->instance = i;
    }
    // What the list had not and nothing added has, it has not now: then no instance is looked at.
    const bool is_new = changed.first == 0 && changed.end == snapshot_.instances.size();
    const auto holds = [&](bool before, const auto& is) {
        const bool may_hold = is_new || before || std::any_of(splice_.added.begin(), splice_.added.end(), is);
        return may_hold && std::any_of(snapshot_.instances.begin(), snapshot_.instances.end(), is);
    };
    snapshot_.drawables.any_by_depth =
        holds(snapshot_.drawables.any_by_depth, [](const InstanceItem& item) { return item.drawable.by_depth; });
    snapshot_.drawables.any_drawn =
        holds(snapshot_.drawables.any_drawn, [](const InstanceItem& item) { return item.drawable.drawn; });
    snapshot_.air.any = holds(snapshot_.air.any, is_air);
    snapshot_.gpu_slot_count = casters_.bound();
    if (std::exchange(shapes_version_, library_.version) == library_.version) return;
    snapshot_.meshes.shapes.clear();
    for (const assets::Mesh& mesh : library_.meshes) snapshot_.meshes.shapes.push_back(mesh.shape);
}

void SceneStore::list_instances() {
    snapshot_.instances.clear();
    snapshot_.changed_instances.clear();
    std::erase_if(dropped_, [](const Dropped& dropped) { return static_cast<bool>(dropped.caster); });
    casters_.each([&](CasterId id, Caster& caster) {
        const DropReason fault = fault_of(caster);
        if (fault != DropReason::instances_full) {
            dropped_.push_back({id, {}, reason_code(fault)});
            caster.instance = kNone;
            caster.moved = caster.marked = false;
            return;
        }
        const bool is_new = caster.instance == kNone;
        if (is_new || caster.moved) caster.version = snapshot_.version;
        if (is_new || caster.moved || caster.marked)
            snapshot_.changed_instances.push_back(static_cast<std::uint32_t>(snapshot_.instances.size()));
        put(caster, id, snapshot_.instances.emplace_back());
        caster.moved = caster.marked = false;
    });
    note_casters({0, static_cast<std::uint32_t>(snapshot_.instances.size())});
    snapshot_.renew_list();
    build_tree(snapshot_);
}

bool SceneStore::put_consumers(std::span<const ConsumerItem> consumers) {
    bool any = consumers.size() != snapshot_.consumers.size();
    snapshot_.consumers.resize(consumers.size());
    for (std::size_t i = 0; i < consumers.size(); ++i) {
        if (same_place(snapshot_.consumers[i], consumers[i])) continue;
        snapshot_.consumers[i] = consumers[i];
        any = true;
    }
    return any;
}

void SceneStore::update(std::span<const ConsumerItem> consumers, std::span<const std::uint32_t> lacking,
                        std::span<const std::uint32_t> lost) {
    snapshot_.changed_instances.clear();
    for (const auto& [now, then] : {std::pair(lacking, &lacking_), std::pair(lost, &lost_)}) {
        if (std::equal(now.begin(), now.end(), then->begin(), then->end())) continue;
        then->assign(now.begin(), now.end());
        instances_anew_ = true;
    }
    note_changed_meshes();
    ++snapshot_.version;
    bool any = put_consumers(consumers);
    if (lights_anew_) list_lights();
    any |= std::exchange(lights_anew_, false);
    if (std::exchange(lights_set_, false)) any |= put_lights();
    if (!instances_anew_ && !(splice_casters() && put_changes())) instances_anew_ = true;
    any |= !changed_.empty() || instances_anew_ || snapshot_.list_version == snapshot_.version;
    changed_.clear();
    came_.clear();
    went_.clear();
    if (!any) {
        --snapshot_.version;  // set to equal values
        return;
    }
    if (std::exchange(instances_anew_, false)) {
        list_instances();
    } else {
        std::sort(snapshot_.changed_instances.begin(), snapshot_.changed_instances.end());
        refit_tree(snapshot_);
    }
}

}  // namespace gnomon::embed
