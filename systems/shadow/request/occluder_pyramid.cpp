#include "systems/shadow/request/occluder_pyramid.h"

#include <algorithm>

namespace gnomon::shadow {
namespace {

constexpr std::uint64_t kSquareBytes = 2 * sizeof(float);

std::uint32_t squares(std::uint32_t side) { return (side + kEndsAcross - 1) / kEndsAcross; }

}  // namespace

PyramidLevel first_pyramid_level(std::uint32_t size_px) { return {0, squares(size_px)}; }

PyramidLevel next_pyramid_level(const PyramidLevel& level) {
    return {level.first + level.side * level.side, squares(level.side)};
}

std::uint32_t pyramid_count(std::uint32_t size_px) {
    PyramidLevel level = first_pyramid_level(size_px);
    while (level.side > 1) level = next_pyramid_level(level);
    return level.first + 1;
}

std::uint64_t pyramid_bytes(std::uint32_t size_px, std::uint32_t views) {
    return std::uint64_t{pyramid_count(size_px)} * views * kSquareBytes;
}

double steepest(const ShadowView& view, double texel_u, double texel_v, double source_size) {
    const double texel = std::min(texel_u, texel_v);
    if (is_parallel(view)) return texel / (source_size * (view.depth.far_m - view.depth.near_m));
    return texel * view.depth.beta / (source_size * kMostStretch);
}

}  // namespace gnomon::shadow
