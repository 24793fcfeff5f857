#include <algorithm>
#include <cstring>

#include "shaders/bindings.h"
#include "systems/debug/debug_view.h"
#include "systems/debug/depth_tiles.h"
#include "systems/debug/words.h"

/// Debug view "depth": the maps of one light side by side; a cube's faces unfolded.
namespace gnomon::debug {
namespace {

constexpr std::size_t kCube =
    bindings::kCubeMapUnit - bindings::kFlatMapsUnit;  // in Drawing::maps; a flat map is the first

}  // namespace

std::optional<Drawing> draw_depth(const ViewInput& input) {
    const auto light = requested_light(input);
    if (!light) return std::nullopt;
    std::vector<shadow::ShadowView> views;
    Drawing drawing;
    for (const std::size_t v : requested_views(input, *light)) {
        const shadow::ShadowView& view = input.frame.fitted.views[v];
        const std::size_t map = view.projection == shadow::ViewProjection::cube_face ? kCube : 0;
        views.push_back(view);
        drawing.maps[map] = input.frame.maps[v].texture;
    }
    gl::Rect below_title = input.area;
    if (below_title.height > 2 * kLine_px) below_title.height -= kLine_px;
    const std::vector<DepthTile> tiles = depth_tiles(views, below_title);
    DepthTiles block;
    block.options.x = static_cast<std::int32_t>(tiles.size());
    std::copy(tiles.begin(), tiles.end(), block.tiles);
    drawing.block.resize(sizeof block);
    std::memcpy(drawing.block.data(), &block, sizeof block);

    const std::string& name = input.scene.lights[*light].name;
    drawing.labels.push_back({{input.area.x, input.area.y + input.area.height},
                              name + (tiles.empty() ? ": depth has " + no_map(input.frame, *light)
                                                    : ": depth (black near, white far, blue nothing)")});
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const glm::vec4& place = tiles[i].place;
        const glm::ivec2 corner(static_cast<int>(place.x), static_cast<int>(place.y + place.z));
        drawing.labels.push_back({corner, range_text(views[i])});
    }
    return drawing;
}

}  // namespace gnomon::debug
