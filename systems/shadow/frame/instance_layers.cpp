#include "systems/shadow/frame/instance_layers.h"

namespace gnomon::shadow {

void InstanceLayers::update(const SceneSnapshot& scene) {
    const std::size_t count = scene.instances.size();
    if (scene.list_version != 0 && scene.list_version == list_version_ && casts_.size() == count) return;
    list_version_ = scene.list_version;
    casts_.resize(count);
    shows_.resize(count);
    shown_by_all_ = static_cast<ShadowLayers>(~ShadowLayers{0});
    for (std::size_t i = 0; i < count; ++i) {
        const InstanceItem& item = scene.instances[i];
        casts_[i] = item.casts ? item.cast_layers : 0;
        shows_[i] = item.visible && item.receives ? item.receive_layers : 0;
        if (item.visible) shown_by_all_ &= shows_[i];
    }
}

}  // namespace gnomon::shadow
