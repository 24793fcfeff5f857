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
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

/// Pictures of what the frame knows, drawn over its own: one row of a table, one C++ file and one shader per view.
namespace gnomon::debug {

struct ViewRow;

/// What to show. Part of FrameSettings.
struct Request {
    const ViewRow* view = nullptr;            // null: nothing, which costs nothing
    std::string light = {};                   // by name; empty: all, of views that can show all
    std::optional<std::uint32_t> layer = {};  // one of its maps only; empty: all
    gl::Rect area = {};                       // of the picture, in pixels, y up; without width: the whole picture
};

/// Words for the application to draw: views draw pictures only.
struct Label {
    glm::ivec2 at_px{0};  // upper left corner of the text, from the picture's lower left
    std::string text;
    std::optional<glm::vec3> swatch = {};  // sRGB; a square of this colour before the text
};

/// What a view may look at.
struct ViewInput {
    const SceneSnapshot& scene;
    const shadow::ShadowFrame& frame;
    const Request& request;
    gl::Rect area;                         // where to draw, within the picture, not empty
    const ConsumerItem* fitted = nullptr;  // the camera that shadows are fitted to, where it is not the picture's
};

/// Whether a view needs Request::light.
enum class ViewScope : std::uint8_t { one_light, one_or_all };

/// How a view is drawn.
enum class ViewMedium : std::uint8_t {
    flat,     // one triangle over the area, by common/fullscreen.vert and the row's shader
    lines,    // in the world, against the depths of the picture; hidden ones are fainter
    lookups,  // over every surface, by the row's shader, which is told of a light's own lookups
              // (shaders/debug/lookup.glsl)
};

/// Matches LineVertex in shaders/debug/lines.vert (std430).
struct LineVertex {
    glm::vec4 position_ca_m{0.0f};  // from the camera's position, along the world's axes
    glm::vec4 colour{0.0f};         // linear
};
static_assert(sizeof(LineVertex) == 32);

struct Drawing {
    std::vector<std::byte> block = {};        // flat, lookups: the shader's uniform block, binding 0 or 5; not empty
    std::array<gl::TextureHandle, 2> maps{};  // flat: units 0 and 1, read raw, no comparison, no filter; {0}: not bound
    std::uint32_t light = 0;                  // lookups: index into SceneSnapshot::lights
    std::vector<LineVertex> lines = {};       // lines: two per line
    std::vector<Label> labels = {};
};

/// Pure: same input, same drawing. Empty: there is nothing to show.
using ViewFunction = std::optional<Drawing> (*)(const ViewInput& input);

struct ViewRow {
    std::string_view name;  // --debug NAME, or NAME:LIGHT
    ViewScope scope;
    ViewMedium medium;
    std::string_view meaning;   // one line
    std::string_view fragment;  // under shaders/
    ViewFunction draw;
};

/// To add a view: systems/debug/x.cpp, shaders/debug/x.frag, a row here.
std::span<const ViewRow> view_table();
/// Null: no such view.
const ViewRow* find_view(std::string_view name);

std::optional<Drawing> draw_cascades(const ViewInput& input);
std::optional<Drawing> draw_texels(const ViewInput& input);
std::optional<Drawing> draw_bias(const ViewInput& input);
std::optional<Drawing> draw_penumbra(const ViewInput& input);
std::optional<Drawing> draw_frusta(const ViewInput& input);
std::optional<Drawing> draw_sets(const ViewInput& input);
std::optional<Drawing> draw_depth(const ViewInput& input);

}  // namespace gnomon::debug
