#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Layers of all instances, two bytes each. Searches of the tree read these in random order, and an InstanceItem has
/// 208 bytes.
class InstanceLayers {
public:
    /// Reads the scene's instances: none if its list_version is that of the last call, and new ones alone after a
    /// ListSplice.
    void update(const SceneSnapshot& scene);
    /// Returns casts_under() of an instance.
    bool casts_under(const LightItem& light, std::uint32_t i) const { return (light.shadow.layers & casts_[i]) != 0; }
    /// Returns receives_under() of an instance that is visible; false of others.
    bool shows_shadows_of(const LightItem& light, std::uint32_t i) const {
        return (light.shadow.layers & shows_[i]) != 0;
    }
    /// Returns true if all visible instances show the light's shadows.
    bool all_show_shadows_of(const LightItem& light) const { return (light.shadow.layers & shown_by_all_) != 0; }

private:
    void read(const InstanceItem& item, std::size_t i);

    std::vector<ShadowLayers> casts_, shows_;  // 0: none
    std::vector<ShadowLayers> allows_;         // shows_, but of what is not visible all
    ShadowLayers shown_by_all_ = 0;            // in which all visible instances are
    std::uint64_t list_version_ = 0;           // the scene's at the last update()
};

}  // namespace gnomon::shadow
