#include "systems/shadow/frame/instance_layers.h"

namespace gnomon::shadow {
namespace {

constexpr auto kEvery = static_cast<ShadowLayers>(~ShadowLayers{0});

}  // namespace

void InstanceLayers::read(const InstanceItem& item, std::size_t i) {
    casts_[i] = item.casts ? item.cast_layers : 0;
    shows_[i] = item.visible && item.receives ? item.receive_layers : 0;
    allows_[i] = item.visible ? shows_[i] : kEvery;
}

void InstanceLayers::update(const SceneSnapshot& scene) {
    const std::size_t count = scene.instances.size();
    if (scene.list_version != 0 && scene.list_version == list_version_ && casts_.size() == count) return;
    const ListSplice& step = scene.list_splice;
    if (step.leads(list_version_, scene.list_version) && step.count == casts_.size()) {
        for (std::vector<ShadowLayers>* values : {&casts_, &shows_, &allows_}) apply_moves(step.moves, count, *values);
        for (const std::uint32_t i : step.added) read(scene.instances[i], i);
    } else {
        for (std::vector<ShadowLayers>* values : {&casts_, &shows_, &allows_}) values->resize(count);
        for (std::size_t i = 0; i < count; ++i) read(scene.instances[i], i);
    }
    list_version_ = scene.list_version;
    shown_by_all_ = kEvery;
    for (const ShadowLayers allowed : allows_) shown_by_all_ &= allowed;
}

}  // namespace gnomon::shadow
