#include <optional>
#include <utility>
#include <vector>

#include "engine/math/aabb.h"
#include "gnomon/frame.h"
#include "systems/extract/drawable_basis.h"
#include "systems/extract/placed_light.h"
#include "systems/extract/scene_tree.h"
#include "systems/visibility/caster_trees.h"
#include "systems/visibility/light_queries.h"

namespace gnomon {

struct VisibilityQueries::State {
    explicit State(const assets::MeshLibrary& meshes) : library(&meshes) { scene.list_version = scene.version = 1; }

    /// Trees over the casters; made by the first query.
    struct Rays {
        explicit Rays(const assets::MeshLibrary& library) : trees(library) {}
        visibility::CasterTrees trees;
        visibility::LightQueries queries{trees};
    };

    /// Brings the tree over the casters to where they are.
    void settle() {
        if (relisted || !has_tree(scene)) {
            ++scene.version;
            scene.renew_list();
            build_tree(scene);
        } else if (!scene.changed_instances.empty()) {
            ++scene.version;
            refit_tree(scene);
        }
        relisted = false;
        scene.changed_instances.clear();
    }

    const assets::MeshLibrary* library;
    SceneSnapshot scene;                   // instances alone
    bool relisted = false;                 // casters came, or began or ceased to cast
    std::vector<visibility::Place> places;  // scratch
    std::unique_ptr<Rays> rays;
};

VisibilityQueries::VisibilityQueries(const assets::MeshLibrary& library) : state_(std::make_unique<State>(library)) {}
VisibilityQueries::VisibilityQueries(const VisibilityQueries& other)
    : state_(std::make_unique<State>(*other.state_->library)) {
    state_->scene = other.state_->scene;
    state_->relisted = other.state_->relisted;
}
VisibilityQueries& VisibilityQueries::operator=(const VisibilityQueries& other) {
    return *this = VisibilityQueries(other);
}
VisibilityQueries::VisibilityQueries(VisibilityQueries&&) noexcept = default;
VisibilityQueries& VisibilityQueries::operator=(VisibilityQueries&&) noexcept = default;
VisibilityQueries::~VisibilityQueries() = default;

std::size_t VisibilityQueries::add_caster(std::uint32_t mesh) {
    State& s = *state_;
    InstanceItem item;
    item.mesh = mesh;
    item.mesh_version = s.library->version_of(mesh);
    item.bounds_ws = s.library->meshes[mesh].bounds_ms;
    s.scene.instances.push_back(item);
    s.relisted = true;
    return s.scene.instances.size() - 1;
}

void VisibilityQueries::place(std::size_t caster, const WorldTransform& at) {
    State& s = *state_;
    InstanceItem& item = s.scene.instances[caster];
    const std::optional<glm::dmat3> basis = drawable_basis(at.basis);
    const math::Aabb& bounds_ms = s.library->meshes[item.mesh].bounds_ms;
    const math::Aabb bounds_ws = basis ? math::transformed(bounds_ms, *basis, at.translation_ws_m) : math::Aabb{};
    const bool casts = math::is_finite(bounds_ws);
    s.relisted |= casts != item.casts;
    item.casts = casts;
    if (!casts || (item.basis == *basis && item.translation_ws_m == at.translation_ws_m)) return;
    item.basis = *basis;
    item.translation_ws_m = at.translation_ws_m;
    item.bounds_ws = bounds_ws;
    s.scene.changed_instances.push_back(static_cast<std::uint32_t>(caster));
}

void VisibilityQueries::ask(const Light& light, const WorldTransform& light_at, std::span<const LitPlace> places,
                            std::span<float> shares, const VisibilityOptions& options) {
    State& s = *state_;
    s.settle();
    if (!s.rays) s.rays = std::make_unique<State::Rays>(*s.library);
    s.places.clear();
    for (const LitPlace& place : places) s.places.push_back({place.position_m, place.radius_m});
    s.rays->queries.ask(s.scene, placed(light, light_at), s.places,
                        {options.samples, options.nearest_m, options.threads}, shares);
}

}  // namespace gnomon
