#include "engine/assets/gltf_triangles.h"

namespace gnomon::assets::gltf {
namespace {
constexpr int kStrip = 5;
constexpr int kFan = 6;
}  // namespace

std::size_t triangle_count(int mode, std::size_t corners) {
    if (mode == kStrip || mode == kFan) return corners < 3 ? 0 : corners - 2;
    return corners / 3;
}

void append_triangles(int mode, const std::vector<std::uint32_t>& corners, std::size_t corner_count,
                      std::uint32_t first_vertex, std::vector<std::uint32_t>& indices) {
    const auto append = [&](std::size_t corner) {
        indices.push_back(first_vertex + (corners.empty() ? static_cast<std::uint32_t>(corner) : corners[corner]));
    };
    const std::size_t triangles = triangle_count(mode, corner_count);
    for (std::size_t i = 0; i < triangles; ++i) {
        if (mode == kStrip) {
            append(i);
            append(i + 1 + i % 2);
            append(i + 2 - i % 2);
        } else if (mode == kFan) {
            append(i + 1);
            append(i + 2);
            append(0);
        } else {
            append(3 * i);
            append(3 * i + 1);
            append(3 * i + 2);
        }
    }
}

}  // namespace gnomon::assets::gltf
