#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "systems/debug/debug_view.h"
#include "systems/debug/depth_tiles.h"

/// The debug view "depth": the maps of one light, side by side, the faces of a cube unfolded.
namespace gnomon::debug {
namespace {

constexpr std::size_t kFlatUnit = 0, kCubeUnit = 1;  // bindings in shaders/debug/depth.frag
constexpr std::int32_t kTitle_px = 20;               // a line of text and air around it
constexpr std::array kFaceNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

/// "face +X: 0.35 ... 21.2 m". An orthographic map has no eye: its distances count from its near plane.
std::string range_text(const shadow::ShadowView& view) {
    const bool flat = view.projection == shadow::ViewProjection::orthographic;
    const double near_m = flat ? 0.0 : view.near_m, far_m = flat ? view.far_m - view.near_m : view.far_m;
    const bool face = view.projection == shadow::ViewProjection::cube_face;
    const std::string which = face ? kFaceNames[view.layer % kFaceNames.size()] : "map " + std::to_string(view.layer);
    std::array<char, 64> range{};
    std::snprintf(range.data(), range.size(), ": %.3g ... %.3g m", near_m, far_m);
    return which + range.data();
}

std::string title(const LightItem& light, const shadow::ShadowFrame& frame, std::uint32_t index, bool any) {
    std::string text = light.name + ": depth ";
    if (any) return text + "(black near, white far, blue nothing)";
    const Reason reason = index < frame.sets.size() ? frame.sets[index].skip : Reason::none;
    return text + "has no map: " + (reason == Reason::none ? "not this one" : reason_code(reason));
}

}  // namespace

std::optional<Drawing> draw_depth(const ViewInput& input) {
    const auto& lights = input.scene.lights;
    const auto light =
        std::find_if(lights.begin(), lights.end(), [&](const LightItem& l) { return l.name == input.request.light; });
    if (light == lights.end()) return std::nullopt;
    const auto index = static_cast<std::uint32_t>(light - lights.begin());

    std::vector<shadow::ShadowView> views;
    Drawing drawing;
    for (std::size_t v = 0; v < input.frame.views.size(); ++v) {
        const shadow::ShadowView& view = input.frame.views[v];
        if (input.frame.demands[view.demand].light != index || !input.frame.slots[v].texture) continue;
        if (input.request.layer && *input.request.layer != view.layer) continue;
        const std::size_t unit = view.projection == shadow::ViewProjection::cube_face ? kCubeUnit : kFlatUnit;
        views.push_back(view);
        drawing.maps[unit] = input.frame.slots[v].texture;
    }
    gl::Rect below_title = input.area;
    if (below_title.height > 2 * kTitle_px) below_title.height -= kTitle_px;
    const std::vector<DepthTile> tiles = depth_tiles(views, below_title);
    DepthTiles block;
    block.options.x = static_cast<std::int32_t>(tiles.size());
    std::copy(tiles.begin(), tiles.end(), block.tiles);
    drawing.block.resize(sizeof block);
    std::memcpy(drawing.block.data(), &block, sizeof block);

    drawing.labels.push_back(
        {{input.area.x, input.area.y + input.area.height}, title(*light, input.frame, index, !tiles.empty())});
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const glm::vec4& place = tiles[i].place;
        const glm::ivec2 corner(static_cast<int>(place.x), static_cast<int>(place.y + place.z));
        drawing.labels.push_back({corner, range_text(views[i])});
    }
    return drawing;
}

}  // namespace gnomon::debug
