#include "systems/extract/splice_instances.h"

#include <algorithm>
#include <span>

namespace gnomon {
namespace {

/// Fills added_at: each added item comes behind all kept ones with an index up to its own.
void place_added(std::span<const InstanceItem> items, InstanceSplice& splice) {
    splice.added_at.clear();
    std::size_t gone = 0;
    for (const InstanceItem& item : splice.added) {
        const auto behind =
            std::upper_bound(items.begin(), items.end(), item.entity.index,
                             [](std::uint32_t index, const InstanceItem& other) { return index < other.entity.index; });
        const auto before = static_cast<std::uint32_t>(behind - items.begin());
        while (gone < splice.removed.size() && splice.removed[gone] < before) ++gone;
        splice.added_at.push_back(static_cast<std::uint32_t>(before - gone + splice.added_at.size()));
    }
}

/// Returns the range of all indices after the step that may have another instance.
IndexRange changed_by(const ListSplice& step, std::size_t count) {
    const auto all = static_cast<std::uint32_t>(count);
    IndexRange changed{all, 0};
    if (!step.added.empty()) changed = {step.added.front(), step.added.back() + 1};
    if (step.moves.empty()) return {std::min(changed.first, all), changed.end};
    const PlaceMove& last = step.moves.back();
    return {std::min(changed.first, step.moves.front().to), std::max(changed.end, last.to + last.count)};
}

}  // namespace

void InstanceSplice::clear() {
    removed.clear();
    added.clear();
    added_at.clear();
}

IndexRange splice_instances(SceneSnapshot& scene, InstanceSplice& splice) {
    for (InstanceItem& item : splice.added) item.version = scene.version;
    place_added(scene.instances, splice);
    ListSplice& step = scene.list_splice;
    step.from_version = scene.list_version;
    step.to_version = scene.version;
    step.count = scene.instances.size();
    step.added = splice.added_at;
    list_moves(static_cast<std::uint32_t>(step.count), splice.removed, splice.added_at, step.moves);
    apply_moves(step.moves, step.count - splice.removed.size() + splice.added.size(), scene.instances);
    for (std::size_t i = 0; i < splice.added.size(); ++i) scene.instances[splice.added_at[i]] = splice.added[i];
    scene.changed_instances = splice.added_at;
    scene.list_version = scene.tree_version = scene.version;
    scene.tree.splice(splice.removed, splice.added_at, [&](std::uint32_t i) { return scene.instances[i].bounds_ws; });
    return changed_by(step, scene.instances.size());
}

}  // namespace gnomon
