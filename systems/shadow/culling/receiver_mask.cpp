#include "systems/shadow/culling/receiver_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/aabb.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/occluders.h"

namespace gnomon::shadow {
namespace {

/// Rounding of a place along an axis, relative to the largest coordinate: some ten units of a double.
constexpr double kPlaceRounding = 0x1p-48;

/// Returns the number of cells along a side, a power of two. A receiver of the mean size covers 64, so that rounding to
/// cells widens it by a quarter at most.
int cells_for(std::size_t receivers) {
    int cells = ReceiverMask::kFewestCells;
    while (cells < ReceiverMask::kMostCells && static_cast<std::size_t>(cells) * cells < 64 * receivers) cells *= 2;
    return cells;
}

/// Cells from `low` to below `high` along each axis.
struct CellRange {
    glm::ivec2 low{0}, high{0};
    bool empty() const { return low.x >= high.x || low.y >= high.y; }
};

/// Returns the cells that a box touches, widened by `wider_m`. Not finite: all of them.
CellRange cells_of(const ReceiverMask& mask, const math::Aabb& box_ws, const glm::dvec2& wider_m) {
    const glm::dvec3 middle_m = math::centre(box_ws) - mask.origin_ws_m, half_m = math::half_extent(box_ws);
    const glm::dvec3 largest_m =
        glm::max(glm::abs(box_ws.min), glm::abs(box_ws.max)) + glm::abs(mask.origin_ws_m) + half_m;
    const double rounding_m = kPlaceRounding * (largest_m.x + largest_m.y + largest_m.z);
    CellRange range;
    for (int k = 0; k < 2; ++k) {
        const double at_m = glm::dot(middle_m, mask.axes[k]) - mask.low_m[k];
        const double beside_m = glm::dot(half_m, glm::abs(mask.axes[k])) + wider_m[k] + rounding_m;
        const double low = std::floor((at_m - beside_m) * mask.cells_per_m[k]);
        const double high = std::floor((at_m + beside_m) * mask.cells_per_m[k]) + 1.0;
        const double most = mask.cells;
        range.low[k] = low > 0.0 ? static_cast<int>(std::min(low, most)) : 0;
        range.high[k] = high < most ? static_cast<int>(std::max(high, 0.0)) : mask.cells;
    }
    return range;
}

std::uint32_t& sum_at(ReceiverMask& mask, int column, int row) {
    return mask.sums[static_cast<std::size_t>(row * (mask.cells + 1) + column)];
}
std::uint32_t sum_at(const ReceiverMask& mask, int column, int row) {
    return mask.sums[static_cast<std::size_t>(row * (mask.cells + 1) + column)];
}

}  // namespace

void find_seen_receivers(const SceneSnapshot& scene, const LightItem& light, const ReceiverCasterSets& sets,
                         const InstanceLayers& layers, std::vector<std::uint32_t>& seen) {
    seen.clear();
    const math::Frustum& camera = sets.camera_frusta.front();
    const auto classify = [&](const math::Aabb& box) {
        if (!math::may_overlap(camera, box)) return math::Overlap::outside;
        const std::array<glm::dvec3, 8> corners = math::corners(box);
        return are_hidden(sets.occluders, corners) ? math::Overlap::outside : math::Overlap::partial;
    };
    visit_instances(scene, classify, [&](std::uint32_t i) {
        if (layers.shows_shadows_of(light, i)) seen.push_back(i);
    });
}

void build_receiver_mask(const SceneSnapshot& scene, std::span<const std::uint32_t> receivers, const ShadowView& view,
                         const glm::dvec2& reach_m, ReceiverMask& mask) {
    mask.origin_ws_m = view.pose.anchor_ws_m;
    mask.axes = {view.pose.axis_u, view.pose.axis_v, view.pose.axis_back};
    mask.low_m = view.plane.centre_ls_m - view.plane.half_extent_m;
    mask.cells = cells_for(receivers.size());
    mask.cells_per_m = static_cast<double>(mask.cells) / (2.0 * view.plane.half_extent_m);
    const int side = mask.cells + 1;
    mask.sums.assign(static_cast<std::size_t>(side * side), 0);
    // Counts the boxes over each cell: each adds one at two of its corners and takes it away at the others.
    for (const std::uint32_t i : receivers) {
        const CellRange at = cells_of(mask, scene.instances[i].bounds_ws, reach_m);
        if (at.empty()) continue;
        ++sum_at(mask, at.low.x, at.low.y);
        --sum_at(mask, at.high.x, at.low.y);
        --sum_at(mask, at.low.x, at.high.y);
        ++sum_at(mask, at.high.x, at.high.y);
    }
    const auto sum_up = [&](int columns, int rows) {
        for (int row = rows; row < side; ++row)
            for (int column = columns; column < side; ++column)
                sum_at(mask, column, row) += sum_at(mask, column - columns, row - rows);
    };
    sum_up(1, 0);
    sum_up(0, 1);
    // Then the covered cells before each one: those of a row move one place on.
    for (int row = side - 1; row > 0; --row)
        for (int column = side - 1; column > 0; --column)
            sum_at(mask, column, row) = std::min(sum_at(mask, column - 1, row - 1), 1u);
    for (int k = 0; k < side; ++k) sum_at(mask, k, 0) = sum_at(mask, 0, k) = 0;
    sum_up(1, 0);
    sum_up(0, 1);
}

bool covers(const ReceiverMask& mask, const math::Aabb& box_ws) {
    const CellRange at = cells_of(mask, box_ws, glm::dvec2(0.0));
    if (at.empty()) return false;
    return sum_at(mask, at.high.x, at.high.y) - sum_at(mask, at.low.x, at.high.y) - sum_at(mask, at.high.x, at.low.y) +
               sum_at(mask, at.low.x, at.low.y) >
           0;
}

}  // namespace gnomon::shadow
