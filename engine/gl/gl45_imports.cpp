#include <algorithm>
#include <utility>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {
namespace {

GLint level_value(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

bool is_kind(GLenum target, TextureKind kind) {
    switch (kind) {
        case TextureKind::flat:
            return target == GL_TEXTURE_2D || target == GL_TEXTURE_2D_MULTISAMPLE;
        case TextureKind::array:
            return target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
        case TextureKind::cube:
            return target == GL_TEXTURE_CUBE_MAP;
    }
    return false;
}

/// Depth bits, their type and stencil bits, which show the choice of the driver for GL_DEPTH_COMPONENT.
struct DepthBits {
    GLint depth = 0, type = GL_NONE, stencil = 0;
    bool operator==(const DepthBits&) const = default;
};
DepthBits depth_bits(Format format) {
    switch (format) {
        case Format::d16:
            return {16, GL_UNSIGNED_NORMALIZED, 0};
        case Format::d24:
            return {24, GL_UNSIGNED_NORMALIZED, 0};
        case Format::d24_s8:
            return {24, GL_UNSIGNED_NORMALIZED, 8};
        case Format::d32f:
            return {32, GL_FLOAT, 0};
        case Format::d32f_s8:
            return {32, GL_FLOAT, 8};
        default:
            return {};
    }
}

bool has_format(GLuint texture, Format format) {
    if (static_cast<GLenum>(level_value(texture, GL_TEXTURE_INTERNAL_FORMAT)) == gl_format(format).internal)
        return true;
    const DepthBits bits{level_value(texture, GL_TEXTURE_DEPTH_SIZE), level_value(texture, GL_TEXTURE_DEPTH_TYPE),
                         level_value(texture, GL_TEXTURE_STENCIL_SIZE)};
    return is_depth(format) && bits == depth_bits(format);
}

bool has_size(GLuint texture, const TextureDesc& desc) {
    const GLint depth = desc.kind == TextureKind::array ? static_cast<GLint>(desc.layers) : 1;
    return level_value(texture, GL_TEXTURE_WIDTH) == static_cast<GLint>(desc.width) &&
           level_value(texture, GL_TEXTURE_HEIGHT) == static_cast<GLint>(desc.height) &&
           level_value(texture, GL_TEXTURE_DEPTH) == depth;
}

GLint64 buffer_value(GLuint buffer, GLenum name) {
    GLint64 value = 0;
    glGetNamedBufferParameteri64v(buffer, name, &value);
    return value;
}

bool may_be_updated(GLuint buffer) {
    return buffer_value(buffer, GL_BUFFER_IMMUTABLE_STORAGE) == GL_FALSE ||
           (buffer_value(buffer, GL_BUFFER_STORAGE_FLAGS) & GL_DYNAMIC_STORAGE_BIT) != 0;
}

bool is_buffer_of(GLuint name, const BufferDesc& desc) {
    if (desc.size == 0 || desc.use == BufferUse::read_back || glIsBuffer(name) == GL_FALSE) return false;
    if (desc.texels && (desc.size % kTexelBytes != 0 || desc.size > most_texel_bytes())) return false;
    const GLint64 size = buffer_value(name, GL_BUFFER_SIZE);
    return size > 0 && desc.size <= static_cast<std::uint64_t>(size) &&
           (desc.use != BufferUse::updated || may_be_updated(name));
}

}  // namespace

Made<GlTexture> adopt_texture(GLuint name, const TextureDesc& desc) {
    drop_gl_errors();
    GLint target = GL_NONE;
    if (glIsTexture(name) == GL_TRUE) glGetTextureParameteriv(name, GL_TEXTURE_TARGET, &target);
    const bool fits =
        is_kind(static_cast<GLenum>(target), desc.kind) && has_size(name, desc) && has_format(name, desc.format);
    const Failure failure = take_gl_error();
    if (!fits || failure != Failure::none) return {{}, fits ? failure : Failure::invalid_value};
    return {{name, desc, static_cast<GLenum>(target), true}};
}

std::optional<EngineTexture> described(GLuint name) {
    GLint target = GL_NONE;
    if (glIsTexture(name) == GL_TRUE) glGetTextureParameteriv(name, GL_TEXTURE_TARGET, &target);
    for (const TextureKind kind : {TextureKind::flat, TextureKind::array, TextureKind::cube}) {
        if (!is_kind(static_cast<GLenum>(target), kind)) continue;
        for (std::uint8_t format = 0; format <= static_cast<std::uint8_t>(kLastFormat); ++format) {
            if (!has_format(name, static_cast<Format>(format))) continue;
            const auto value = [&](GLenum which) { return static_cast<std::uint32_t>(level_value(name, which)); };
            const std::uint32_t layers = kind == TextureKind::array ? value(GL_TEXTURE_DEPTH) : 1;
            return EngineTexture{
                {{}, kind, static_cast<Format>(format), value(GL_TEXTURE_WIDTH), value(GL_TEXTURE_HEIGHT), layers},
                static_cast<GLenum>(target) != gl_kind(kind),
                std::max(value(GL_TEXTURE_SAMPLES), 1u)};
        }
    }
    return std::nullopt;
}

std::vector<std::array<float, 2>> places_of_samples(GLuint name) {
    const std::optional<EngineTexture> texture = described(name);
    if (!texture || !texture->multisampled || texture->desc.kind != TextureKind::flat ||
        !is_depth(texture->desc.format))
        return {};
    const bool stencil = texture->desc.format == Format::d24_s8 || texture->desc.format == Format::d32f_s8;
    GLuint framebuffer = 0;
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, name, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    std::vector<std::array<float, 2>> positions(texture->samples);
    for (GLuint i = 0; i < texture->samples; ++i) glGetMultisamplefv(GL_SAMPLE_POSITION, i, positions[i].data());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
    glDeleteFramebuffers(1, &framebuffer);
    return positions;
}

std::uint64_t size_of_buffer(GLuint name) {
    if (glIsBuffer(name) == GL_FALSE) return 0;
    return static_cast<std::uint64_t>(std::max(buffer_value(name, GL_BUFFER_SIZE), GLint64{0}));
}

Made<GlBuffer> adopt_buffer(GLuint name, const BufferDesc& desc) {
    drop_gl_errors();
    if (!is_buffer_of(name, desc)) {
        drop_gl_errors();
        return {{}, Failure::invalid_value};
    }
    GlBuffer buffer{name, desc, 0, true};
    if (desc.texels) {
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &buffer.texels);
        glTextureBufferRange(buffer.texels, GL_RGBA32UI, name, 0, static_cast<GLsizeiptr>(desc.size));
        set_gl_label(GL_TEXTURE, buffer.texels, desc.label);
    }
    const Failure failure = take_gl_error();
    if (failure == Failure::none) return {std::move(buffer)};
    delete_buffer(buffer);
    return {{}, failure};
}

}  // namespace gnomon::gl
