#pragma once
#include <epoxy/gl.h>

#include <array>
#include <cstdint>

/// Pieces of OpenGL's state that KeptState gives back, each with how it is read and written. Private to the executor.
namespace gnomon::gl {

/// One piece: read before its first change, written only where it differs, and given back.
template <class Piece>
class Kept {
public:
    using Value = typename Piece::Value;
    Kept() = default;
    explicit Kept(Piece piece) : piece_(piece) {}

    void set(const Value& value) {
        if (!known_) before_ = now_ = piece_.read();
        known_ = true;
        if (now_ == value) return;
        piece_.write(value);
        now_ = value;
    }
    void restore() {
        if (known_) set(before_);
        known_ = false;
    }
    /// Gives it back where others may have changed it since.
    void write_back() {
        if (known_) piece_.write(before_);
        known_ = false;
    }
    bool known() const { return known_; }
    /// Returns what it was. Valid while known().
    const Value& before() const { return before_; }

private:
    Piece piece_;
    Value before_{}, now_{};
    bool known_ = false;
};

struct Capability {
    using Value = bool;
    GLenum name = GL_NONE;
    bool read() const { return glIsEnabled(name) == GL_TRUE; }
    void write(bool on) const { on ? glEnable(name) : glDisable(name); }
};
/// Capability of one draw buffer or viewport.
struct IndexedCapability {
    using Value = bool;
    GLenum name = GL_NONE;
    GLuint index = 0;
    bool read() const { return glIsEnabledi(name, index) == GL_TRUE; }
    void write(bool on) const { on ? glEnablei(name, index) : glDisablei(name, index); }
};

/// State of one enumerant or name, with a function of one argument to set it.
template <GLenum kName, auto kSet>
struct One {
    using Value = GLint;
    static GLint read() {
        GLint value = 0;
        glGetIntegerv(kName, &value);
        return value;
    }
    static void write(GLint value) { (*kSet)(static_cast<GLuint>(value)); }
};
using CullFace = One<GL_CULL_FACE_MODE, &epoxy_glCullFace>;
using FrontFace = One<GL_FRONT_FACE, &epoxy_glFrontFace>;
using DepthFunction = One<GL_DEPTH_FUNC, &epoxy_glDepthFunc>;
using ProvokingVertex = One<GL_PROVOKING_VERTEX, &epoxy_glProvokingVertex>;
using ProgramInUse = One<GL_CURRENT_PROGRAM, &epoxy_glUseProgram>;
using VertexArray = One<GL_VERTEX_ARRAY_BINDING, &epoxy_glBindVertexArray>;
using ActiveTexture = One<GL_ACTIVE_TEXTURE, &epoxy_glActiveTexture>;

/// Binding of one object to a target that is not indexed.
template <GLenum kName, auto kBind, GLenum kTarget>
struct Bound {
    using Value = GLint;
    static GLint read() { return One<kName, kBind>::read(); }
    static void write(GLint value) { (*kBind)(kTarget, static_cast<GLuint>(value)); }
};
using DrawFramebuffer = Bound<GL_DRAW_FRAMEBUFFER_BINDING, &epoxy_glBindFramebuffer, GL_DRAW_FRAMEBUFFER>;
using DrawRecordBuffer = Bound<GL_DRAW_INDIRECT_BUFFER_BINDING, &epoxy_glBindBuffer, GL_DRAW_INDIRECT_BUFFER>;
using UnpackBuffer = Bound<GL_PIXEL_UNPACK_BUFFER_BINDING, &epoxy_glBindBuffer, GL_PIXEL_UNPACK_BUFFER>;
using PackBuffer = Bound<GL_PIXEL_PACK_BUFFER_BINDING, &epoxy_glBindBuffer, GL_PIXEL_PACK_BUFFER>;
using QueryBuffer = Bound<GL_QUERY_BUFFER_BINDING, &epoxy_glBindBuffer, GL_QUERY_BUFFER>;

struct DepthMask {
    using Value = bool;
    static bool read() {
        GLboolean value = GL_FALSE;
        glGetBooleanv(GL_DEPTH_WRITEMASK, &value);
        return value == GL_TRUE;
    }
    static void write(bool on) { glDepthMask(on ? GL_TRUE : GL_FALSE); }
};
struct ClipControl {
    using Value = std::array<GLint, 2>;  // origin, depth mode
    static Value read() {
        Value value{};
        glGetIntegerv(GL_CLIP_ORIGIN, value.data());
        glGetIntegerv(GL_CLIP_DEPTH_MODE, value.data() + 1);
        return value;
    }
    static void write(const Value& v) { glClipControl(static_cast<GLenum>(v[0]), static_cast<GLenum>(v[1])); }
};
struct PolygonMode {
    using Value = GLint;
    static GLint read() {
        std::array<GLint, 2> front_and_back{};  // drivers may return both, although a core context has one
        glGetIntegerv(GL_POLYGON_MODE, front_and_back.data());
        return front_and_back[0];
    }
    static void write(GLint mode) { glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(mode)); }
};
struct LineWidth {
    using Value = GLfloat;
    static GLfloat read() {
        GLfloat width = 0.0f;
        glGetFloatv(GL_LINE_WIDTH, &width);
        return width;
    }
    static void write(GLfloat width) { glLineWidth(width); }
};

/// Viewport, depth range and scissor box of viewport 0. Lists draw through no other.
struct Viewport {
    using Value = std::array<GLfloat, 4>;
    static Value read() {
        Value value{};
        glGetFloati_v(GL_VIEWPORT, 0, value.data());
        return value;
    }
    static void write(const Value& value) { glViewportIndexedfv(0, value.data()); }
};
struct DepthRange {
    using Value = std::array<GLdouble, 2>;
    static Value read() {
        Value value{};
        glGetDoublei_v(GL_DEPTH_RANGE, 0, value.data());
        return value;
    }
    static void write(const Value& value) { glDepthRangeIndexed(0, value[0], value[1]); }
};
struct ScissorBox {
    using Value = std::array<GLint, 4>;
    static Value read() {
        Value value{};
        glGetIntegeri_v(GL_SCISSOR_BOX, 0, value.data());
        return value;
    }
    static void write(const Value& value) { glScissorIndexedv(0, value.data()); }
};

/// State of one draw buffer.
struct ColourMask {
    using Value = std::array<GLboolean, 4>;
    GLuint buffer = 0;
    Value read() const {
        Value value{};
        glGetBooleani_v(GL_COLOR_WRITEMASK, buffer, value.data());
        return value;
    }
    void write(const Value& v) const { glColorMaski(buffer, v[0], v[1], v[2], v[3]); }
};
struct BlendEquation {
    using Value = std::array<GLenum, 2>;  // colour, alpha
    GLuint buffer = 0;
    Value read() const;
    void write(const Value& v) const { glBlendEquationSeparatei(buffer, v[0], v[1]); }
};
struct BlendFunction {
    using Value = std::array<GLenum, 4>;  // source and destination of colour, then of alpha
    GLuint buffer = 0;
    Value read() const;
    void write(const Value& v) const { glBlendFuncSeparatei(buffer, v[0], v[1], v[2], v[3]); }
};

/// Texture of one target, and sampler, of the active unit.
struct TextureBinding {
    using Value = GLuint;
    GLenum target = GL_NONE, query = GL_NONE;
    GLuint read() const;
    void write(GLuint texture) const { glBindTexture(target, texture); }
};
struct SamplerBinding {
    using Value = GLuint;
    GLuint unit = 0;
    static GLuint read();
    void write(GLuint sampler) const { glBindSampler(unit, sampler); }
};

/// Part of a buffer at an indexed binding; size 0: the whole buffer, whatever its size becomes.
struct BufferPart {
    GLuint buffer = 0;
    GLint64 offset = 0, size = 0;
    bool operator==(const BufferPart&) const = default;
};
/// Binds by the functions for many bindings, which leave the binding that is not indexed as it is.
struct BufferBinding {
    using Value = BufferPart;
    GLenum target = GL_NONE;  // GL_UNIFORM_BUFFER or GL_SHADER_STORAGE_BUFFER
    GLuint index = 0;
    BufferPart read() const;
    void write(const BufferPart& part) const;
};

}  // namespace gnomon::gl
