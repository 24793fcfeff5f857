#pragma once
#include <vector>

namespace gnomon {

/// How far each morph target of the entity's mesh is taken, 0 not at all, 1 in full; any finite number goes. Targets
/// beyond the list count as 0. As for Skin, the entity with the lowest index speaks for all of one mesh.
struct MorphWeights {
    std::vector<float> weights = {};
};

}  // namespace gnomon
