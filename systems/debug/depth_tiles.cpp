#include "systems/debug/depth_tiles.h"

#include <algorithm>
#include <array>

namespace gnomon::debug {
namespace {

/// Face in the cross: its column and row from the lower left, and the cube's axes in its picture.
struct Unfolded {
    int column, row;
    glm::vec3 right, up, forward;
};
constexpr int kCrossColumns = 4, kCrossRows = 3;
const std::array<Unfolded, 6> kCross{{
    {2, 1, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}},    // +X
    {0, 1, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}},  // -X
    {1, 2, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},    // +Y
    {1, 0, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},  // -Y
    {3, 1, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   // +Z
    {1, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},   // -Z
}};

struct Grid {
    int columns, rows, edge_px;
};

Grid grid_of(int columns, int rows, const gl::Rect& area) {
    return {columns, rows, std::min(area.width / columns, area.height / rows)};
}

/// Finds the number of columns that makes `count` squares largest.
Grid largest_grid(int count, const gl::Rect& area) {
    Grid best = grid_of(count, 1, area);
    for (int columns = 1; columns < count; ++columns) {
        const Grid grid = grid_of(columns, (count + columns - 1) / columns, area);
        if (grid.edge_px > best.edge_px) best = grid;
    }
    return best;
}

DepthTile tile_of(const shadow::ShadowView& view) {
    DepthTile tile;
    tile.place.w = static_cast<float>(view.layer);
    const bool flat = shadow::is_parallel(view);
    tile.depth = glm::vec4(
        glm::dvec4(view.depth.near_m, view.depth.far_m, flat ? 0.0 : view.depth.alpha, flat ? 0.0 : view.depth.beta));
    if (view.projection == shadow::ViewProjection::cube_face) {
        const Unfolded& face = kCross[view.layer % kCross.size()];
        tile.right = glm::vec4(face.right, 0.0f);
        tile.up = glm::vec4(face.up, 0.0f);
        tile.forward = glm::vec4(face.forward, 0.0f);
    }
    return tile;
}

}  // namespace

std::vector<DepthTile> depth_tiles(std::span<const shadow::ShadowView> views, const gl::Rect& area) {
    const int count = static_cast<int>(std::min<std::size_t>(views.size(), kMaxTiles));
    if (count == 0) return {};
    const bool cross = count > 1 && std::all_of(views.begin(), views.end(), [](const shadow::ShadowView& view) {
                           return view.projection == shadow::ViewProjection::cube_face;
                       });
    const Grid grid = cross ? grid_of(kCrossColumns, kCrossRows, area) : largest_grid(count, area);
    if (grid.edge_px < 1) return {};
    const int left = area.x + (area.width - grid.columns * grid.edge_px) / 2;
    const int bottom = area.y + (area.height - grid.rows * grid.edge_px) / 2;
    std::vector<DepthTile> tiles;
    for (int i = 0; i < count; ++i) {
        const shadow::ShadowView& view = views[static_cast<std::size_t>(i)];
        const int column = cross ? kCross[view.layer % kCross.size()].column : i % grid.columns;
        const int row = cross ? kCross[view.layer % kCross.size()].row : grid.rows - 1 - i / grid.columns;
        DepthTile tile = tile_of(view);
        tile.place.x = static_cast<float>(left + column * grid.edge_px);
        tile.place.y = static_cast<float>(bottom + row * grid.edge_px);
        tile.place.z = static_cast<float>(grid.edge_px);
        tiles.push_back(tile);
    }
    return tiles;
}

}  // namespace gnomon::debug
