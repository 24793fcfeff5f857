#include "engine/gl/gl45_draw_into.h"

#include <array>
#include <utility>

#include "engine/gl/gl45_kept_pieces.h"

namespace gnomon::gl {
namespace {

/// Capabilities that decide where a draw's depths go, and their value while casters are drawn.
constexpr std::array<std::pair<GLenum, bool>, 9> kCapabilities = {{{GL_DEPTH_TEST, true},
                                                                   {GL_DEPTH_CLAMP, true},
                                                                   {GL_CULL_FACE, false},
                                                                   {GL_STENCIL_TEST, false},
                                                                   {GL_POLYGON_OFFSET_FILL, false},
                                                                   {GL_RASTERIZER_DISCARD, false},
                                                                   {GL_SAMPLE_ALPHA_TO_COVERAGE, false},
                                                                   {GL_SAMPLE_COVERAGE, false},
                                                                   {GL_SAMPLE_MASK, false}}};

/// Viewports that OpenGL 4.5 guarantees, each with a scissor test of its own.
constexpr std::size_t kViewports = 16;

}  // namespace

void draw_into(const GlTarget& target, const Rect& viewport, const std::function<void()>& draw) {
    std::array<Kept<Capability>, kCapabilities.size()> capabilities;
    for (std::size_t i = 0; i < kCapabilities.size(); ++i) {
        capabilities[i] = Kept(Capability{kCapabilities[i].first});
        capabilities[i].set(kCapabilities[i].second);
    }
    std::array<Kept<IndexedCapability>, kViewports> scissors;
    Kept<DrawFramebuffer> framebuffer;
    Kept<Viewport> area;
    Kept<ClipControl> clip;
    Kept<DepthRange> range;
    Kept<DepthFunction> test;
    Kept<DepthMask> writes;
    Kept<PolygonMode> mode;
    std::array<Kept<ColourMask>, kMaxColourAttachments> colours;
    for (GLuint i = 0; i < scissors.size(); ++i) {
        scissors[i] = Kept(IndexedCapability{GL_SCISSOR_TEST, i});
        scissors[i].set(false);
    }
    framebuffer.set(static_cast<GLint>(target.name));
    area.set({static_cast<float>(viewport.x), static_cast<float>(viewport.y), static_cast<float>(viewport.width),
              static_cast<float>(viewport.height)});
    clip.set({GL_LOWER_LEFT, GL_ZERO_TO_ONE});
    range.set({0.0, 1.0});
    test.set(GL_GREATER);
    writes.set(true);
    mode.set(GL_FILL);
    // A depth pass of the engine's has no output for an attachment of integers.
    for (GLuint i = 0; i < target.colours && i < colours.size(); ++i) {
        colours[i] = Kept(ColourMask{i});
        colours[i].set({GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE});
    }
    draw();
    for (Kept<ColourMask>& colour : colours) colour.write_back();
    mode.write_back();
    writes.write_back();
    test.write_back();
    range.write_back();
    clip.write_back();
    area.write_back();
    framebuffer.write_back();
    for (Kept<IndexedCapability>& scissor : scissors) scissor.write_back();
    for (Kept<Capability>& capability : capabilities) capability.write_back();
}

}  // namespace gnomon::gl
