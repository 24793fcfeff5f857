#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "systems/debug/debug_view.h"

/// What debug views say, and the colours that they say it in.
namespace gnomon::debug {

inline constexpr std::int32_t kLine_px = 20;  // a line of text and air around it

/// Eight colours that colour-blind people tell apart too (Okabe and Ito 2008), sRGB; one per map of a light.
glm::vec3 map_colour(std::uint32_t layer);

/// "face +X", or "map 2".
std::string map_name(const shadow::ShadowView& view);

/// "0.25 m", with three digits and the unit that suits it.
std::string length_text(double length_m);

/// Index of the light that was asked for; empty: there is none of that name.
std::optional<std::uint32_t> requested_light(const ViewInput& input);

/// The camera of the picture that is drawn over.
inline const ConsumerItem& camera_of(const ViewInput& input) {
    return input.scene.consumers[input.frame.inputs.front().consumer];
}

/// "no map: not_seen": why the light has none.
std::string no_map(const shadow::ShadowFrame& frame, std::uint32_t light);

/// "map 2: 0.25 ... 15.5 m": what depths it holds. An orthographic map has no eye: they count from its near plane.
std::string range_text(const shadow::ShadowView& view);

/// Indices of the views of `light` that have a map and were asked for, in the frame's order.
std::vector<std::size_t> requested_views(const ViewInput& input, std::uint32_t light);

/// Lines of text from the upper left corner of `area` down.
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
