#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "gnomon/frame.h"

/// Share of a lamp's light at points of a scene, by the library's visibility queries, for rules that know no entities.
namespace gnomon::game {

/// Shadow casters of a scene. Copies what it needs: the scene may go afterwards. Walkers let light through: the player
/// cannot hide behind a mesh that bends.
class Occluders {
public:
    /// Copies the casters, except the nodes `left_out`, which never block, e.g. the player's own body.
    Occluders(const assets::SceneData& scene, std::span<const std::int32_t> left_out);

    /// Puts every caster where its node is now. `poses`: one per node of the scene.
    void place(std::span<const WorldTransform> poses);

    /// Computes the shares of the lamp's light that reach the places (VisibilityQueries::ask()). Call place() before.
    void ask(const Light& lamp, const WorldTransform& at, std::span<const LitPlace> places, std::span<float> shares);

private:
    std::shared_ptr<const assets::MeshLibrary> library_;
    VisibilityQueries queries_;
    std::vector<std::size_t> nodes_;  // node of each caster
};

}  // namespace gnomon::game
