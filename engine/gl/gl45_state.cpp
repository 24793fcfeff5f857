#include "engine/gl/gl45_state.h"

#include <utility>

namespace gnomon::gl {
namespace {

constexpr GLsizei kVertexStride = 8 * sizeof(float), kItemStride = 2 * sizeof(std::uint32_t);

void set_enabled(GLenum capability, bool on) { on ? glEnable(capability) : glDisable(capability); }

struct GlComponents {
    GLenum type = GL_FLOAT;
    GLboolean normalised = GL_FALSE;
};
GlComponents gl_components(PositionFormat format) {
    switch (format) {
        case PositionFormat::float32:
            return {};
        case PositionFormat::float16:
            return {GL_HALF_FLOAT, GL_FALSE};
        case PositionFormat::snorm16:
            return {GL_SHORT, GL_TRUE};
        case PositionFormat::unorm16:
            return {GL_UNSIGNED_SHORT, GL_TRUE};
    }
    return {};
}

}  // namespace

GLenum gl_depth_test(DepthTest test) {
    switch (test) {
        case DepthTest::off:
            return GL_ALWAYS;
        case DepthTest::greater_equal:
            return GL_GEQUAL;
        case DepthTest::greater:
            return GL_GREATER;
        case DepthTest::equal:
            return GL_EQUAL;
        case DepthTest::less:
            return GL_LESS;
    }
    return GL_ALWAYS;
}

GlBlend gl_blend(Blend blend) {
    switch (blend) {
        case Blend::off:
            return {};
        case Blend::add:
            return {true, GL_FUNC_ADD, true, GL_ONE, GL_ONE, GL_ONE, GL_ONE};
        case Blend::alpha:
            return {true, GL_FUNC_ADD, true, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA};
        case Blend::largest:
            return {true, GL_MAX};
    }
    return {};
}

/// Resets all state that affects draws and that lists do not set. Other users of the context may have changed it since
/// the last list.
void GlState::reset() const {
    for (const GLenum capability : {GL_SCISSOR_TEST,
                                    GL_STENCIL_TEST,
                                    GL_DEPTH_TEST,
                                    GL_DEPTH_CLAMP,
                                    GL_CULL_FACE,
                                    GL_BLEND,
                                    GL_COLOR_LOGIC_OP,
                                    GL_DITHER,
                                    GL_POLYGON_OFFSET_FILL,
                                    GL_POLYGON_OFFSET_LINE,
                                    GL_POLYGON_OFFSET_POINT,
                                    GL_POLYGON_SMOOTH,
                                    GL_LINE_SMOOTH,
                                    GL_PRIMITIVE_RESTART,
                                    GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                    GL_RASTERIZER_DISCARD,
                                    GL_SAMPLE_ALPHA_TO_COVERAGE,
                                    GL_SAMPLE_ALPHA_TO_ONE,
                                    GL_SAMPLE_COVERAGE,
                                    GL_SAMPLE_MASK,
                                    GL_FRAMEBUFFER_SRGB}) {
        glDisable(capability);
    }
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0.0, 1.0);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBlendEquation(GL_FUNC_ADD);
    glUseProgram(0);
    glBindVertexArray(0);
    glBindTextures(0, fixtures_.texture_units, nullptr);
    glBindSamplers(0, fixtures_.texture_units, nullptr);
    glBindBuffersBase(GL_UNIFORM_BUFFER, 0, fixtures_.uniform_bindings, nullptr);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, fixtures_.storage_bindings, nullptr);
}

void GlState::drop_meshes() {
    for (const GLuint layout : {fixtures_.mesh_layout, fixtures_.other_layout}) {
        if (layout == fixtures_.other_layout && !std::exchange(has_other_meshes_, false)) continue;
        glVertexArrayVertexBuffer(layout, GlFixtures::kVertexSlot, 0, 0, kVertexStride);
        glVertexArrayVertexBuffer(layout, GlFixtures::kItemSlot, 0, 0, kItemStride);
        glVertexArrayElementBuffer(layout, 0);
    }
}

void GlState::begin_list() {
    in_target_ = false;
    scissor_ = {};
    reset();
}

Failure GlState::end_list() {
    reset();
    drop_meshes();
    if (std::exchange(has_draw_records_, false)) glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return take_gl_error();
}

void GlState::begin_pass(GLuint framebuffer, std::size_t, const Rect& viewport) {
    in_target_ = framebuffer != 0;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    set_enabled(GL_FRAMEBUFFER_SRGB, in_target_);
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    set_scissor({});
}

void GlState::set_scissor(const Rect& rect) {
    scissor_ = rect;
    set_enabled(GL_SCISSOR_TEST, rect.width > 0);
    if (rect.width > 0) glScissor(rect.x, rect.y, rect.width, rect.height);
}

void GlState::set_depth_mask(bool writes) { glDepthMask(writes ? GL_TRUE : GL_FALSE); }

void GlState::use_pipeline(const PipelineState& state, const GlProgram& program) {
    glUseProgram(program.name);
    set_enabled(GL_CULL_FACE, state.cull != CullMode::none);
    glCullFace(state.cull == CullMode::front ? GL_FRONT : GL_BACK);
    glFrontFace(state.front_is_clockwise ? GL_CW : GL_CCW);
    // OpenGL writes depth only with the depth test enabled.
    set_enabled(GL_DEPTH_TEST, state.depth_test != DepthTest::off || state.depth_write);
    glDepthFunc(gl_depth_test(state.depth_test));
    glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    set_enabled(GL_DEPTH_CLAMP, state.depth_clamp);
    const GlBlend blend = gl_blend(state.blend);
    set_enabled(GL_BLEND, blend.enabled);
    glBlendEquation(blend.equation);
    if (state.blend == Blend::add) glBlendFunc(blend.source_colour, blend.target_colour);
    if (state.blend == Blend::alpha)
        glBlendFuncSeparate(blend.source_colour, blend.target_colour, blend.source_alpha, blend.target_alpha);
}

void GlState::use_compute(const GlProgram& program) { glUseProgram(program.name); }

void GlState::prepare_draw(GLuint layout, bool) { glBindVertexArray(layout); }

void GlState::set_depth_range(float near_depth, float far_depth) { glDepthRangef(near_depth, far_depth); }

void GlState::begin_blit() {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

void GlState::end_blit() {
    set_scissor(scissor_);
    set_enabled(GL_FRAMEBUFFER_SRGB, in_target_);
}

void GlState::bind_texture(std::uint32_t unit, GLenum, GLuint texture, GLuint sampler) {
    glBindTextureUnit(unit, texture);
    glBindSampler(unit, sampler);
}

void GlState::bind_uniforms(std::uint32_t binding, GLuint buffer, std::uint32_t offset, std::uint32_t size) {
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(size));
}

void GlState::bind_storage(std::uint32_t binding, GLuint buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

void GlState::bind_draw_records(GLuint buffer) {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    has_draw_records_ = true;
}

void GlState::bind_meshes(GLuint vertices, GLuint items, GLuint indices, const MeshLayout& other) {
    const GLuint layout = other.stride == 0 ? fixtures_.mesh_layout : fixtures_.other_layout;
    const auto stride = other.stride == 0 ? kVertexStride : static_cast<GLsizei>(other.stride);
    has_other_meshes_ = has_other_meshes_ || other.stride != 0;
    if (other.stride != 0) {
        const GlComponents components = gl_components(other.position);
        glVertexArrayAttribFormat(layout, kPositionAttribute, 3, components.type, components.normalised, 0);
    }
    glVertexArrayVertexBuffer(layout, GlFixtures::kVertexSlot, vertices, static_cast<GLintptr>(other.position_offset),
                              stride);
    glVertexArrayVertexBuffer(layout, GlFixtures::kItemSlot, items, 0, kItemStride);
    glVertexArrayElementBuffer(layout, indices);
}

}  // namespace gnomon::gl
