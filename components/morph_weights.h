#pragma once
#include <vector>

namespace gnomon {

/// Weight of each morph target of the entity's mesh: 0 not applied, 1 applied in full, any finite number allowed.
/// Targets beyond the list count as 0. The entity with the lowest index sets the weights of all that share its mesh
/// (see Skin).
struct MorphWeights {
    std::vector<float> weights = {};
};

}  // namespace gnomon
