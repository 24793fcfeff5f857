#include "systems/extract/splice_instances.h"

#include <algorithm>
#include <span>

namespace gnomon {
namespace {

/// Takes out the items at rising indices. Returns the first index with another item.
std::size_t take_out(std::vector<InstanceItem>& items, std::span<const std::uint32_t> indices) {
    if (indices.empty()) return items.size();
    std::size_t to = indices.front(), next = 0;
    for (std::size_t from = to; from < items.size(); ++from) {
        if (next < indices.size() && indices[next] == from)
            ++next;
        else
            items[to++] = items[from];
    }
    items.resize(to);
    return indices.front();
}

/// Puts sorted items in, from the back, and lists where they are. Returns the first index with another item.
std::size_t put_in(std::vector<InstanceItem>& items, std::span<const InstanceItem> added,
                   std::vector<std::uint32_t>& added_at) {
    added_at.resize(added.size());
    std::size_t from = items.size(), left = added.size();
    items.resize(from + left);
    while (left > 0) {
        const InstanceItem& item = added[left - 1];
        const std::size_t at = from + left - 1;
        if (from > 0 && items[from - 1].entity.index > item.entity.index) {
            items[at] = items[--from];
            continue;
        }
        items[at] = item;
        added_at[--left] = static_cast<std::uint32_t>(at);
    }
    return added.empty() ? items.size() : added_at.front();
}

}  // namespace

void InstanceSplice::clear() {
    removed.clear();
    added.clear();
    added_at.clear();
}

std::uint32_t splice_instances(SceneSnapshot& scene, InstanceSplice& splice) {
    for (InstanceItem& item : splice.added) item.version = scene.version;
    const std::size_t without = take_out(scene.instances, splice.removed);
    const std::size_t with = put_in(scene.instances, splice.added, splice.added_at);
    scene.changed_instances = splice.added_at;
    scene.list_splice.from_version = scene.list_version;
    scene.list_splice.to_version = scene.version;
    scene.list_splice.removed = splice.removed;
    scene.list_splice.added = splice.added_at;
    scene.list_version = scene.tree_version = scene.version;
    scene.tree.splice(splice.removed, splice.added_at, [&](std::uint32_t i) { return scene.instances[i].bounds_ws; });
    return static_cast<std::uint32_t>(std::min(without, with));
}

}  // namespace gnomon
