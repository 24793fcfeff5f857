#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "systems/debug/debug_view.h"

/// Words and colours of debug views.
namespace gnomon::debug {

inline constexpr std::int32_t kLine_px = 20;  // height of a text line with spacing

/// Returns one of eight colours that colour-blind people can distinguish (Okabe and Ito 2008), sRGB; one per map of a
/// light.
glm::vec3 map_colour(std::uint32_t layer);

/// Names a map: "face +X" or "map 2".
std::string map_name(const shadow::ShadowView& view);

/// Formats a length with three digits and a suitable unit: "0.25 m".
std::string length_text(double length_m);

/// Returns the index of the requested light; empty if there is none of that name.
std::optional<std::uint32_t> requested_light(const ViewInput& input);

/// Returns the camera of the underlying picture.
inline const ConsumerItem& camera_of(const ViewInput& input) {
    return input.scene.consumers[input.frame.inputs.front().consumer];
}

/// Formats the reason why the light has no map: "no map: no_visible_receiver".
std::string no_map(const shadow::ShadowFrame& frame, std::uint32_t light);

/// Formats the depth range of a map: "map 2: 0.25 ... 15.5 m". An orthographic map has no eye, so that its depths count
/// from its near plane.
std::string range_text(const shadow::ShadowView& view);

/// Returns the indices of the requested views of `light` that have a map, in the frame's order.
std::vector<std::size_t> requested_views(const ViewInput& input, std::uint32_t light);

/// Lines of text downward from the upper left corner of `area`.
class Legend {
public:
    explicit Legend(const gl::Rect& area) : next_px_(area.x, area.y + area.height) {}
    void add(std::string text, std::optional<glm::vec3> swatch = {});
    std::vector<Label> take() { return std::move(labels_); }

private:
    glm::ivec2 next_px_;
    std::vector<Label> labels_;
};

}  // namespace gnomon::debug
