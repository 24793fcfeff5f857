#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "systems/visibility/light_queries.h"

/// Share of a lamp's light at points of a scene, by the library's visibility queries, for rules that know no entities.
namespace gnomon::game {

/// Shadow casters of a scene, as a snapshot of their own. Copies what it needs: the scene may go afterwards. Walkers
/// let light through: the player cannot hide behind a mesh that bends.
class Occluders {
public:
    /// Copies the casters, except the nodes `left_out`, which never block, e.g. the player's own body.
    Occluders(const assets::SceneData& scene, std::span<const std::int32_t> left_out);
    /// Copies the casters. The copy makes its own trees at its first query.
    Occluders(const Occluders& other) : library_(other.library_), scene_(other.scene_), nodes_(other.nodes_) {}
    Occluders& operator=(const Occluders& other) { return *this = Occluders(other); }
    Occluders(Occluders&&) noexcept = default;
    Occluders& operator=(Occluders&&) noexcept = default;
    ~Occluders() = default;

    /// Puts every caster where its node is now. `poses`: one per node of the scene.
    void place(std::span<const WorldTransform> poses);

    /// Computes the shares of the lamp's light that reach the places (visibility::LightQueries::ask()). Call place()
    /// before.
    void ask(const LightItem& lamp, std::span<const visibility::Place> places, std::span<float> shares);

private:
    struct Queries {
        explicit Queries(const assets::MeshLibrary& library) : trees(library) {}
        visibility::CasterTrees trees;
        visibility::LightQueries queries{trees};
    };
    std::shared_ptr<const assets::MeshLibrary> library_;
    SceneSnapshot scene_;             // instances alone
    std::vector<std::size_t> nodes_;  // node of each instance
    std::unique_ptr<Queries> queries_;
};

}  // namespace gnomon::game
