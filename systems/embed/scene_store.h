#pragma once
#include <functional>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/shadows.h"
#include "systems/embed/slots.h"
#include "systems/extract/snapshot.h"
#include "systems/extract/splice_instances.h"

namespace gnomon::embed {

/// Scene behind gnomon::Shadows: what was added, as the snapshot that all stages read. `update` applies what was set
/// since the last one, at a cost in proportion to that. Where casters came or went, each caster is looked at.
class SceneStore {
public:
    SceneStore();

    Result<MeshId> add_mesh(const MeshDesc& desc);
    /// Adds a mesh without triangles of its own; what draws it is elsewhere.
    MeshId add_box(std::string_view name, const Bounds& bounds_ms);
    void change_box(MeshId mesh, const Bounds& bounds_ms);
    void remove(MeshId mesh);
    CasterId add_caster(const CasterDesc& desc);
    void set_caster(CasterId caster, const CasterDesc& desc);
    void set_transform(CasterId caster, const glm::dmat4& world_from_mesh);
    void remove(CasterId caster);
    CasterId add_drawable(const DrawableDesc& desc);
    void redraw(CasterId drawable, const Bounds& bounds, double moves_at_most_m);
    CasterId add_air(const AirDesc& desc);
    void set_air(CasterId air, const AirDesc& desc);
    LightId add_light(const LightDesc& desc);
    void set_light(LightId light, const LightDesc& desc);
    void tune(LightId light, const ShadowTuning& tuning);
    void remove(LightId light);

    /// Applies what was set, for these cameras. `lacking`: meshes that the device has no room for. `lost`: meshes in
    /// buffers that are gone. Both are sorted; their casters are dropped. Without a change the snapshot's version
    /// stays.
    void update(std::span<const ConsumerItem> consumers, std::span<const std::uint32_t> lacking = {},
                std::span<const std::uint32_t> lost = {});

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const assets::MeshLibrary& library() const { return library_; }
    std::span<const Dropped> dropped() const { return dropped_; }
    /// Returns the light's index in the snapshot; kNone if the handle names no usable light.
    std::uint32_t light_index(LightId light) const;
    /// Returns the mesh's index in the library; kNone if the handle names none.
    std::uint32_t mesh_index(MeshId mesh) const;
    static constexpr std::uint32_t kNone = ~0u;
    /// Returns the light at an index of the snapshot.
    LightId light_at(std::uint32_t index) const;
    /// Returns how the caster at an index of the snapshot is drawn; null: it is no drawable.
    const std::function<void(const DrawableView&)>* draw_of(std::uint32_t instance) const;

private:
    struct Caster {
        CasterDesc desc;  // for a drawable, mesh and place are unused; for air, mesh and casting
        bool air = false;
        std::function<void(const DrawableView&)> draw = {};  // empty: it has a mesh
        Bounds bounds = {};                                  // box of a drawable
        std::uint64_t motion_since = 0;                      // DrawableMotion::since
        double moved_m = 0.0;                                // DrawableMotion::moved_m
        std::uint32_t instance = kNone;                      // index in the snapshot; kNone: unusable
        std::uint64_t version = 0;                           // InstanceItem::version
        bool moved = true;                                   // its mesh or place was set since the last update
        bool marked = true;                                  // what it casts or receives was
    };
    struct StoredLight {
        LightDesc desc;
        ShadowTuning tuning;
        std::uint32_t item = kNone;  // index in the snapshot; kNone: unusable
        bool set = true;
    };
    DropReason fault_of(const Caster& caster) const;
    void put(Caster& caster, CasterId id, InstanceItem& item) const;
    void change(CasterId id, Caster& caster, const CasterDesc& desc);
    bool put_changes();
    bool splice_casters();
    void note_casters(IndexRange changed);
    void exchange_mesh(CasterId id, Caster& caster);
    void note_changed_meshes();
    void list_instances();
    void list_lights();
    bool put_lights();
    bool put_consumers(std::span<const ConsumerItem> consumers);

    assets::MeshLibrary library_;
    Slots<MeshId, std::uint32_t> meshes_;  // index into library_.meshes
    Slots<CasterId, Caster> casters_;
    Slots<LightId, StoredLight> lights_;
    SceneSnapshot snapshot_;
    std::vector<CasterId> changed_;  // casters with `moved` or `marked`
    std::vector<CasterId> came_;     // casters to list
    std::vector<std::uint32_t> went_;       // indices in the snapshot of those to take out
    std::uint64_t shapes_version_ = ~0ull;  // library_.version when snapshot_.meshes.shapes was made
    InstanceSplice splice_;                 // scratch
    std::vector<Dropped> dropped_;
    std::vector<std::uint32_t> lacking_, lost_;
    std::vector<std::uint32_t> changed_boxes_;  // meshes with content that changed
    bool instances_anew_ = true, lights_anew_ = true, lights_set_ = false;
};

}  // namespace gnomon::embed
