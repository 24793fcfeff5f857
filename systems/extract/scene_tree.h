#pragma once
#include <cstdint>
#include <limits>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Rebuilds scene.tree from the bounds of all instances. Needed after one was added, removed or reordered, except by
/// splice_instances().
void build_tree(SceneSnapshot& scene);

/// Refits scene.tree to scene.changed_instances and sets its version to the scene's. Costs nothing without changes.
void refit_tree(SceneSnapshot& scene);

/// Returns true if scene.tree has the scene's version. Otherwise searches visit every instance, with the same result.
inline bool has_tree(const SceneSnapshot& scene) {
    return scene.tree_version == scene.version && scene.tree.size() == scene.instances.size();
}

/// Calls visit(i) for each instance with bounds that are not outside, in no particular order; classify as in
/// BoundsTree::visit.
template <class Classify, class Visit>
void visit_instances(const SceneSnapshot& scene, Classify&& classify, Visit&& visit) {
    if (has_tree(scene)) {
        scene.tree.visit(classify, visit);
        return;
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (classify(scene.instances[i].bounds_ws) != math::Overlap::outside) visit(i);
}

/// Does the same with tests that parts of a box inherit; classify as in BoundsTree::visit with `open`.
template <class Classify, class Visit>
void visit_instances(const SceneSnapshot& scene, math::OpenTests open, Classify&& classify, Visit&& visit) {
    if (has_tree(scene)) {
        scene.tree.visit(open, classify, visit);
        return;
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        math::OpenTests of_item = open;
        if (classify(scene.instances[i].bounds_ws, of_item) != math::Overlap::outside) visit(i);
    }
}

/// Returns the lowest value of any instance; infinity without one. rank and value as in BoundsTree::lowest.
template <class Rank, class Value>
double lowest_of_instances(const SceneSnapshot& scene, Rank&& rank, Value&& value) {
    if (has_tree(scene)) return scene.tree.lowest(rank, value);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (rank(scene.instances[i].bounds_ws) < lowest) lowest = value(i, lowest);
    return lowest;
}

}  // namespace gnomon
