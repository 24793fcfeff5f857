#pragma once
#include <epoxy/gl.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "engine/gl/device_gl45.h"

/// OpenGL objects behind handles, and functions that create them. Private to the executor.
namespace gnomon::gl {

struct GlTexture {
    GLuint name = 0;
    TextureDesc desc;
    GLenum target = GL_NONE;        // GL_TEXTURE_…
    bool imported = false;          // someone else's, who deletes it
    std::uint32_t array = 0;        // id of the shared array that has its layers; 0: it has its own
    std::uint32_t first_layer = 0;  // in that array
};
struct GlBuffer {
    GLuint name = 0;
    BufferDesc desc;
    GLuint texels = 0;  // texture view of the buffer; 0: without BufferDesc::texels
    bool imported = false;
};
/// Binding that a program reads.
struct GlInput {
    GLenum kind = GL_NONE;   // GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER, or target of a texture
    std::uint32_t slot = 0;  // unit or binding
};
struct GlProgram {
    GLuint name = 0;
    std::vector<GlInput> inputs;  // only for KeptState
};
struct GlTarget {
    GLuint name = 0;
    std::uint32_t width = 0, height = 0;  // common area of all attachments
    std::size_t colours = 0;
    std::uint32_t integer_colours = 0;  // a bit per colour attachment
};

struct GlObjects {
    std::unordered_map<std::uint32_t, GlTexture> textures;
    std::unordered_map<std::uint32_t, GLuint> samplers;
    std::unordered_map<std::uint32_t, GlBuffer> buffers;
    std::unordered_map<std::uint32_t, GlProgram> programs;
    std::unordered_map<std::uint32_t, GlTarget> targets;
    GLuint plain_sampler = 0;  // exact reads of imported textures; made with the first

    std::size_t count() const {
        return textures.size() + samplers.size() + buffers.size() + programs.size() + targets.size();
    }
};

/// Returns the value stored under `id`, or nullptr.
template <class Value>
const Value* find_object(const std::unordered_map<std::uint32_t, Value>& map, std::uint32_t id) {
    const auto at = map.find(id);
    return at == map.end() ? nullptr : &at->second;
}

/// OpenGL's formats to store a Format and to transfer its texels.
struct GlFormat {
    GLenum internal = GL_NONE, layout = GL_NONE, type = GL_NONE;
};
GlFormat gl_format(Format format);
/// Returns OpenGL's name for the kind of texture.
GLenum gl_kind(TextureKind kind);

/// New OpenGL object, or the reason why there is none. A failure leaves nothing behind.
template <class Object>
struct Made {
    Object object{};
    Failure failure = Failure::none;
    std::string log = {};
};
Made<GlTexture> make_texture(const TextureDesc& desc, std::span<const std::byte> pixels, bool keeps_state);
/// Sets exact reads for a texture without a sampler: nearest, clamped.
void set_plain_sampling(GLuint name);
Made<GLuint> make_sampler(const SamplerDesc& desc);
Made<GlBuffer> make_buffer(const BufferDesc& desc, std::span<const std::byte> bytes);
void delete_texture(const GlTexture& texture);
void delete_buffer(const GlBuffer& buffer);
/// Takes an object that someone else made and goes on owning. invalid_value: it is not what `desc` describes.
Made<GlTexture> adopt_texture(GLuint name, const TextureDesc& desc);
Made<GlBuffer> adopt_buffer(GLuint name, const BufferDesc& desc);
/// Returns the results of describe_texture() and sample_positions() of device_gl45.h.
std::optional<EngineTexture> described(GLuint name);
std::vector<std::array<float, 2>> places_of_samples(GLuint name);
/// Returns the bytes of a buffer; 0: the name is none.
std::uint64_t size_of_buffer(GLuint name);
Made<GlProgram> make_program(const ProgramDesc& desc);
/// Returns all bindings that the program reads.
std::vector<GlInput> inputs_of(GLuint program);
Made<GlTarget> make_target(const TargetDesc& desc, const GlObjects& objects);

/// Returns the context's largest buffer that can be read as texels.
std::uint64_t most_texel_bytes();
/// Discards errors that other users of the context left behind.
void drop_gl_errors();
/// Returns the first error since the last call, as a Failure.
Failure take_gl_error();
/// Sets tightly packed rows and no pixel buffer, because other users of the context may have changed that.
void reset_pixel_transfer();
/// Names an object for captures; cut to the driver's limit.
void set_gl_label(GLenum kind, GLuint name, const std::string& label);

}  // namespace gnomon::gl
