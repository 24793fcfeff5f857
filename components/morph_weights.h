#pragma once
#include <vector>

namespace gnomon {

/// Weight of each morph target of the entity's mesh. 0: not applied. 1: applied in full. Any finite number is allowed.
/// Targets beyond the list count as 0. Among entities that share a mesh, the one with the lowest index sets the weights
/// (see Skin).
struct MorphWeights {
    std::vector<float> weights = {};
};

}  // namespace gnomon
