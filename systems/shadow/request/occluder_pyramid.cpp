#include "systems/shadow/request/occluder_pyramid.h"

#include <algorithm>

namespace gnomon::shadow {
namespace {

constexpr std::uint64_t kSquareBytes = 2 * sizeof(float);

std::uint32_t squares(std::uint32_t side) { return (side + kEndsAcross - 1) / kEndsAcross; }

}  // namespace

EndsLevel first_ends(std::uint32_t size_px) { return {0, squares(size_px)}; }

EndsLevel next_ends(const EndsLevel& level) { return {level.first + level.side * level.side, squares(level.side)}; }

std::uint32_t ends_count(std::uint32_t size_px) {
    EndsLevel level = first_ends(size_px);
    while (level.side > 1) level = next_ends(level);
    return level.first + 1;
}

std::uint64_t ends_bytes(std::uint32_t size_px, std::uint32_t views) {
    return std::uint64_t{ends_count(size_px)} * views * kSquareBytes;
}

double steepest(const ShadowView& view, double texel_u, double texel_v, double source_size) {
    const double texel = std::min(texel_u, texel_v);
    if (view.projection == ViewProjection::orthographic)
        return texel / (source_size * (view.depth.far_m - view.depth.near_m));
    return texel * view.depth.beta / (source_size * kMostStretch);
}

}  // namespace gnomon::shadow
