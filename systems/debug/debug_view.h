#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/commands.h"
#include "gnomon/frame.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

/// Debug views of a frame's data, drawn over its picture: a table row, a C++ file and a shader per view.
namespace gnomon::debug {

/// Inputs of a view.
struct ViewInput {
    const SceneSnapshot& scene;
    const shadow::ShadowFrame& frame;
    const Request& request;
    gl::Rect area;                         // area to draw, within the picture, not empty
    const ConsumerItem* fitted = nullptr;  // camera that shadows are fitted to, if it is not the picture's
};

/// Kind of drawing.
enum class ViewMedium : std::uint8_t {
    flat,   // one triangle over the area, by common/fullscreen.vert and the row's shader
    lines,  // in the world, depth-tested against the picture; hidden lines are fainter
    /// Over every surface, by the row's shader, which gets the light's own lookup results (shaders/debug/lookup.glsl).
    lookups,
};

/// Vertex of a line; matches LineVertex in shaders/debug/lines.vert (std430).
struct LineVertex {
    glm::vec4 position_ca_m{0.0f};  // relative to the camera's position, along the world's axes
    glm::vec4 colour{0.0f};         // linear
};
static_assert(sizeof(LineVertex) == 32);

struct Drawing {
    std::vector<std::byte> block = {};  // flat, lookups: the shader's uniform block; not empty
    /// Flat: texture units from bindings::kFlatMapsUnit on, read raw, without comparison or filter; {0}: not bound.
    std::array<gl::TextureHandle, 2> maps{};
    std::uint32_t light = 0;             // lookups: index into SceneSnapshot::lights
    std::vector<LineVertex> lines = {};  // lines: two per line
    std::vector<Label> labels = {};
};

/// Draws a view. Pure: same input, same drawing. Empty: nothing to show.
using ViewFunction = std::optional<Drawing> (*)(const ViewInput& input);

/// What draws a view (ViewRow). A new view needs systems/debug/x.cpp, shaders/debug/x.frag and a row in
/// debug_view.cpp.
struct ViewDrawer {
    ViewMedium medium;
    std::string_view fragment;  // path under shaders/
    ViewFunction draw;
};

std::optional<Drawing> draw_cascades(const ViewInput& input);
std::optional<Drawing> draw_texels(const ViewInput& input);
std::optional<Drawing> draw_bias(const ViewInput& input);
std::optional<Drawing> draw_penumbra(const ViewInput& input);
std::optional<Drawing> draw_frusta(const ViewInput& input);
std::optional<Drawing> draw_sets(const ViewInput& input);
std::optional<Drawing> draw_depth(const ViewInput& input);

}  // namespace gnomon::debug
