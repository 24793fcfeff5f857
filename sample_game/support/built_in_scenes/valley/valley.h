#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::game {

struct Valley {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// Makes a scene of kilometres as binary glTF. Some thirty houses stand along a lane; hamlets, woods and hills reach up
/// to 2.1 km. Light: a sun alone. Cameras: "lane" among the houses and "meadow" before the village, both at eye height,
/// and "hill" above it. Things of centimetres (fence, leaves) stand beside them. Same bytes every time.
Valley make_valley();

}  // namespace gnomon::game
