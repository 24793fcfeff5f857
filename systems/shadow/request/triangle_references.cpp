#include "systems/shadow/request/triangle_references.h"

#include <algorithm>
#include <bit>

namespace gnomon::shadow {

TriangleReferences choose_references(std::uint32_t instances, std::uint32_t triangles,
                                     const TriangleReferences& previous) {
    constexpr int kBits = 32;
    const int instance_bits = std::bit_width(std::max(instances, 1u) - 1), triangle_bits = std::bit_width(triangles);
    const int previous_bits = static_cast<int>(previous.triangle_bits), most_bits = static_cast<int>(kMostTriangleBits);
    if (previous_bits > 0 && triangle_bits <= previous_bits && instance_bits <= kBits - previous_bits) return previous;
    const int room = previous_bits > 0 ? kBits : kBits - static_cast<int>(kSpareBits);
    const int spare = room - instance_bits - triangle_bits;
    if (spare < 0 || triangle_bits > most_bits) return {};
    const int bits = std::clamp(triangle_bits + spare / 2, 1, most_bits);
    return {static_cast<std::uint32_t>(bits)};
}

}  // namespace gnomon::shadow
