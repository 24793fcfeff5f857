#pragma once
#include <cstdint>
#include <limits>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Makes scene.tree anew from the bounds of all instances: after any was added, removed or put elsewhere in the list.
void build_tree(SceneSnapshot& scene);

/// Refits scene.tree to the instances that scene.changed_instances names, and takes it to the scene's version. Costs
/// nothing where that is empty.
void refit_tree(SceneSnapshot& scene);

/// Whether scene.tree is of this version of the scene; else whoever searches looks at every instance, to the same
/// effect.
inline bool has_tree(const SceneSnapshot& scene) {
    return scene.tree_version == scene.version && scene.tree.size() == scene.instances.size();
}

/// Calls visit(i) for each instance whose bounds do not lie outside; classify as in BoundsTree::visit. In no order.
template <class Classify, class Visit>
void visit_instances(const SceneSnapshot& scene, Classify&& classify, Visit&& visit) {
    if (has_tree(scene)) {
        scene.tree.visit(classify, visit);
        return;
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (classify(scene.instances[i].bounds_ws) != math::Overlap::outside) visit(i);
}

/// The lowest value of any instance, infinite without one; rank and value as in BoundsTree::lowest.
template <class Rank, class Value>
double lowest_of_instances(const SceneSnapshot& scene, Rank&& rank, Value&& value) {
    if (has_tree(scene)) return scene.tree.lowest(rank, value);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (rank(scene.instances[i].bounds_ws) < lowest) lowest = value(i, lowest);
    return lowest;
}

}  // namespace gnomon
