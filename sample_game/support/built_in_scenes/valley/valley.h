#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::game {

struct Valley {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// A scene of kilometres as binary glTF: a village of some thirty houses along a lane, hamlets, woods and hills up to
/// 2.1 km away, under a sun alone. Things of centimetres (fence, leaves) stand beside the cameras: "lane" at eye height
/// among the houses, "meadow" at eye height before the village, "hill" above it. Same bytes every time.
Valley make_valley();

}  // namespace gnomon::game
