#pragma once
#include <epoxy/gl.h>

#include <string>
#include <unordered_map>

#include "engine/gl/device.h"

/// The OpenGL objects behind handles, and how they are made. Private to the executor.
namespace gnomon::gl {

struct GlTexture {
    GLuint name = 0;
    TextureDesc desc;
};
struct GlBuffer {
    GLuint name = 0;
    BufferDesc desc;
    GLuint texels = 0;  // the buffer as a texture; 0: without BufferDesc::texels
};
struct GlTarget {
    GLuint name = 0;
    std::uint32_t width = 0, height = 0;  // what all attachments share
    std::size_t colours = 0;
    std::uint32_t integer_colours = 0;  // a bit per colour attachment
};

struct GlObjects {
    std::unordered_map<std::uint32_t, GlTexture> textures;
    std::unordered_map<std::uint32_t, GLuint> samplers;
    std::unordered_map<std::uint32_t, GlBuffer> buffers;
    std::unordered_map<std::uint32_t, GLuint> programs;
    std::unordered_map<std::uint32_t, GlTarget> targets;

    std::size_t count() const {
        return textures.size() + samplers.size() + buffers.size() + programs.size() + targets.size();
    }
};

/// The value stored under `id`, or nullptr.
template <class Value>
const Value* find_object(const std::unordered_map<std::uint32_t, Value>& map, std::uint32_t id) {
    const auto at = map.find(id);
    return at == map.end() ? nullptr : &at->second;
}

/// How a Format is stored and how its texels travel.
struct GlFormat {
    GLenum internal = GL_NONE, layout = GL_NONE, type = GL_NONE;
};
GlFormat gl_format(Format format);
/// What OpenGL calls textures of that kind.
GLenum gl_kind(TextureKind kind);

/// A new OpenGL object and what it is, or why there is none; then nothing is left behind.
template <class Object>
struct Made {
    Object object{};
    Failure failure = Failure::none;
    std::string log = {};
};
Made<GlTexture> make_texture(const TextureDesc& desc, std::span<const std::byte> pixels);
Made<GLuint> make_sampler(const SamplerDesc& desc);
Made<GlBuffer> make_buffer(const BufferDesc& desc, std::span<const std::byte> bytes);
void delete_buffer(const GlBuffer& buffer);
Made<GLuint> make_program(const ProgramDesc& desc);
Made<GlTarget> make_target(const TargetDesc& desc, const GlObjects& objects);

/// Forgets errors that other users of the context left behind.
void drop_gl_errors();
/// The first error since the last call, as a Failure.
Failure take_gl_error();
/// Rows are tightly packed and no pixel buffer is bound, whatever other users of the context have set.
void reset_pixel_transfer();
/// Names an object for captures; cut to what the driver takes.
void set_gl_label(GLenum kind, GLuint name, const std::string& label);

}  // namespace gnomon::gl
