#include "systems/shadow/frame/instance_layers.h"

#include <algorithm>
#include <span>

namespace gnomon::shadow {
namespace {

constexpr auto kEvery = static_cast<ShadowLayers>(~ShadowLayers{0});

/// Takes the values at rising indices out, and makes room at rising indices of the result.
void splice(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added,
            std::vector<ShadowLayers>& values) {
    const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    for (std::size_t gone = 0; gone < removed.size(); ++gone) {
        const std::size_t next = gone + 1 < removed.size() ? removed[gone + 1] : values.size();
        std::move(at(removed[gone] + 1u), at(next), at(removed[gone] - gone));
    }
    const std::size_t kept = values.size() - removed.size();
    values.resize(kept + added.size());
    std::size_t end = kept;
    for (std::size_t left = added.size(); left > 0; --left) {
        const std::size_t from = added[left - 1] + 1u - left;  // as many of the kept ones lie before it
        std::move_backward(at(from), at(end), at(end + left));
        end = from;
    }
}

bool follows(const ListSplice& step, const SceneSnapshot& scene, std::uint64_t list_version, std::size_t count) {
    return list_version != 0 && step.from_version == list_version && step.to_version == scene.list_version &&
           count - step.removed.size() + step.added.size() == scene.instances.size();
}

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
    if (follows(step, scene, list_version_, casts_.size())) {
        for (std::vector<ShadowLayers>* values : {&casts_, &shows_, &allows_})
            splice(step.removed, step.added, *values);
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
