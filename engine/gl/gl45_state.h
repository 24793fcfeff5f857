#pragma once
#include "engine/gl/gl45_fixtures.h"
#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {

/// Sets the state of the context that lists depend on, and leaves it at rest: nothing bound, all tests off. Private to
/// the executor. KeptState leaves it as it was found.
class GlState {
public:
    explicit GlState(const GlFixtures& fixtures) : fixtures_(fixtures) {}
    GlState(const GlState&) = delete;
    GlState& operator=(const GlState&) = delete;
    virtual ~GlState() = default;

    const GlFixtures& fixtures() const { return fixtures_; }
    virtual void begin_list();
    /// Returns the error that the list raised.
    virtual Failure end_list();
    /// Returns how many debug groups a list may open.
    virtual std::size_t group_limit() { return fixtures_.group_depth; }

    /// Draws into a framebuffer with a number of colour attachments from here on; 0 is the window's.
    virtual void begin_pass(GLuint framebuffer, std::size_t colours, const Rect& viewport);
    virtual void set_scissor(const Rect& rect);
    virtual void set_depth_mask(bool writes);
    virtual void use_pipeline(const PipelineState& state, const GlProgram& program);
    virtual void use_compute(const GlProgram& program);
    /// Prepares a dispatch with the program in use.
    virtual void prepare_dispatch() {}
    /// Prepares a draw with the program in use.
    virtual void prepare_draw(GLuint layout, bool lines);
    virtual void set_depth_range(float near_depth, float far_depth);
    virtual void begin_blit();
    virtual void end_blit();

    /// Binds a texture and a sampler to a unit; texture 0 unbinds what lists bound there.
    virtual void bind_texture(std::uint32_t unit, GLenum target, GLuint texture, GLuint sampler);
    virtual void bind_uniforms(std::uint32_t binding, GLuint buffer, std::uint32_t offset, std::uint32_t size);
    virtual void bind_storage(std::uint32_t binding, GLuint buffer);
    virtual void bind_meshes(GLuint vertices, GLuint items, GLuint indices, const MeshLayout& layout);
    /// Binds a buffer of MeshDrawRecord for draws that read it.
    virtual void bind_draw_records(GLuint buffer);

protected:
    /// Rebinds nothing, because a vertex array keeps deleted buffers alive.
    void drop_meshes();

    const GlFixtures& fixtures_;
    bool has_other_meshes_ = false;  // the list bound meshes with a layout of someone else
    bool has_draw_records_ = false;  // the list bound a buffer of draws
    bool in_target_ = false;         // the last pass drew into a target, not into the window
    Rect scissor_{};                 // width 0: off

private:
    void reset() const;
};

/// OpenGL's values for a PipelineState.
struct GlBlend {
    bool enabled = false;
    GLenum equation = GL_FUNC_ADD;
    bool has_function = false;  // the function matters
    GLenum source_colour = GL_ONE, target_colour = GL_ZERO, source_alpha = GL_ONE, target_alpha = GL_ZERO;
};
GlBlend gl_blend(Blend blend);
GLenum gl_depth_test(DepthTest test);

}  // namespace gnomon::gl
