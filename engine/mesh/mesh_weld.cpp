#include "engine/mesh/mesh_weld.h"

#include <bit>

namespace gnomon::assets {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFU;

/// Large odd constant of Fibonacci hashing: 2^64 / golden ratio (Knuth, The Art of Computer Programming 3, 6.4).
constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

struct Key {
    std::uint32_t x = 0, y = 0, z = 0;
    bool operator==(const Key&) const = default;
};

Key key_of(const glm::vec3& position) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value + 0.0f); };  // -0 + 0 is +0
    return {bits(position.x), bits(position.y), bits(position.z)};
}

std::uint64_t hash_of(const Key& key) {
    std::uint64_t hash = ((std::uint64_t{key.x} << 32) | key.y) * kGolden;
    hash = (hash ^ (hash >> 29) ^ key.z) * kGolden;
    return hash ^ (hash >> 32);
}

}  // namespace

std::vector<std::uint32_t> weld_by_position(const std::vector<Vertex>& vertices) {
    const std::size_t slots = std::bit_ceil(vertices.size() * 2 + 1);
    std::vector<std::uint32_t> first_of_slot(slots, kFree);  // vertex that opened the slot
    std::vector<std::uint32_t> welded(vertices.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Key key = key_of(vertices[i].position_ms);
        std::size_t slot = hash_of(key) & (slots - 1);
        while (first_of_slot[slot] != kFree && key_of(vertices[first_of_slot[slot]].position_ms) != key) {
            slot = (slot + 1) & (slots - 1);
        }
        if (first_of_slot[slot] == kFree) {
            first_of_slot[slot] = static_cast<std::uint32_t>(i);
            welded[i] = count++;
        } else {
            welded[i] = welded[first_of_slot[slot]];
        }
    }
    return welded;
}

}  // namespace gnomon::assets
