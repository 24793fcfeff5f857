#pragma once
#include <bitset>
#include <cstdint>
#include <span>

#include "gnomon/shadows.h"
#include "systems/extract/snapshot.h"

namespace gnomon::embed {

/// Layers of a view: casters and receivers that share none are not in its world.
struct ViewLayers {
    ShadowLayers cast = kAllShadowLayers, receive = kAllShadowLayers;
    bool operator==(const ViewLayers&) const = default;
};

/// Sets of layers that casters and receivers of a scene have. Two views with other layers may see the same world.
class LayersInUse {
public:
    /// Follows the scene, at a cost where casters came, went or were set.
    void update(const SceneSnapshot& scene);
    /// Returns whether these views see the same casters and receivers.
    bool are_alike(const ViewLayers& a, const ViewLayers& b) const;

private:
    static constexpr std::size_t kSets = 1 + kAllShadowLayers;
    std::bitset<kSets> cast_, receive_;
    std::uint64_t list_version_ = 0;
};

/// Scene as views with layers see it: the same instances at the same indices. Fewer of them cast and receive.
class LayeredScene {
public:
    explicit LayeredScene(const ViewLayers& layers) : layers_(layers) {}

    /// Follows the whole scene, for these cameras. Costs as much as what changed, if no update was left out; else in
    /// proportion to the scene.
    void update(const SceneSnapshot& whole, std::span<const ConsumerItem> consumers);
    const SceneSnapshot& snapshot() const { return scene_; }
    const ViewLayers& layers() const { return layers_; }

private:
    void restrict_layers(InstanceItem& item) const;

    ViewLayers layers_;
    SceneSnapshot scene_;
};

}  // namespace gnomon::embed
