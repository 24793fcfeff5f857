#include "engine/gl/gl45_objects.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/gl/gl45_manners.h"
#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {

constexpr int kMaxErrors = 32;  // a lost context may report errors forever

template <class Object>
Made<Object> failed(Failure failure, const std::string& label) {
    return {{}, failure, '"' + label + "\": " + to_text(failure)};
}

GLint gl_wrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::mirror:
            return GL_MIRRORED_REPEAT;
        case Wrap::clamp:
            return GL_CLAMP_TO_EDGE;
        case Wrap::border:
            return GL_CLAMP_TO_BORDER;
    }
    return GL_NONE;
}

void upload(const GlTexture& texture, std::span<const std::byte> pixels, bool keeps_state) {
    const TextureDesc& desc = texture.desc;
    const GlFormat format = gl_format(desc.format);
    const auto width = static_cast<GLsizei>(desc.width), height = static_cast<GLsizei>(desc.height);
    const PixelTransfer transfer(keeps_state, PixelTransfer::Direction::upload);
    if (desc.kind == TextureKind::flat) {
        glTextureSubImage2D(texture.name, 0, 0, 0, width, height, format.layout, format.type, pixels.data());
    } else {
        glTextureSubImage3D(texture.name, 0, 0, 0, 0, width, height, static_cast<GLsizei>(layer_count(desc)),
                            format.layout, format.type, pixels.data());
    }
    if (mip_count(desc) > 1) glGenerateTextureMipmap(texture.name);
}

void attach(GLuint framebuffer, GLenum point, const Attachment& attachment, const GlTexture& texture) {
    if (texture.desc.kind == TextureKind::flat || attachment.layer == kAllLayers) {
        glNamedFramebufferTexture(framebuffer, point, texture.name, 0);
    } else {
        glNamedFramebufferTextureLayer(framebuffer, point, texture.name, 0, attachment.layer);
    }
}

}  // namespace

GLenum gl_kind(TextureKind kind) {
    switch (kind) {
        case TextureKind::flat:
            return GL_TEXTURE_2D;
        case TextureKind::array:
            return GL_TEXTURE_2D_ARRAY;
        case TextureKind::cube:
            return GL_TEXTURE_CUBE_MAP;
    }
    return GL_NONE;
}

GlFormat gl_format(Format format) {
    switch (format) {
        case Format::r8:
            return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
        case Format::rgba8:
            return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::srgb8_a8:
            return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
        case Format::rg16:
            return {GL_RG16, GL_RG, GL_UNSIGNED_SHORT};
        case Format::rgba16:
            return {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT};
        case Format::rgba16_snorm:
            return {GL_RGBA16_SNORM, GL_RGBA, GL_SHORT};
        case Format::r16f:
            return {GL_R16F, GL_RED, GL_HALF_FLOAT};
        case Format::rg16f:
            return {GL_RG16F, GL_RG, GL_HALF_FLOAT};
        case Format::rgba16f:
            return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT};
        case Format::r32f:
            return {GL_R32F, GL_RED, GL_FLOAT};
        case Format::rg32f:
            return {GL_RG32F, GL_RG, GL_FLOAT};
        case Format::rgba32f:
            return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
        case Format::r32ui:
            return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT};
        case Format::rg32ui:
            return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT};
        case Format::rgba32ui:
            return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
        case Format::d16:
            return {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::d24:
            return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::d32f:
            return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::d24_s8:
            return {GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT, GL_FLOAT};
        case Format::d32f_s8:
            return {GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT, GL_FLOAT};
    }
    return {};
}

void set_plain_sampling(GLuint name) {
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

void drop_gl_errors() {
    for (int i = 0; i < kMaxErrors && glGetError() != GL_NO_ERROR; ++i) {
    }
}

Failure take_gl_error() {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) drop_gl_errors();
    switch (error) {
        case GL_NO_ERROR:
            return Failure::none;
        case GL_OUT_OF_MEMORY:
            return Failure::out_of_memory;
        case GL_CONTEXT_LOST:
            return Failure::context_lost;
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return Failure::incomplete_target;
        default:
            return Failure::invalid_value;
    }
}

void reset_pixel_transfer() {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const GLenum name : {GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT}) glPixelStorei(name, 1);
    for (const GLenum name :
         {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
          GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT,
          GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST}) {
        glPixelStorei(name, 0);
    }
}

void set_gl_label(GLenum kind, GLuint name, const std::string& label) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_LABEL_LENGTH, &limit);
    const auto longest = static_cast<std::size_t>(std::max(limit - 1, 0));
    glObjectLabel(kind, name, static_cast<GLsizei>(std::min(label.size(), longest)), label.c_str());
}

Made<GlTexture> make_texture(const TextureDesc& desc, std::span<const std::byte> pixels, bool keeps_state) {
    drop_gl_errors();
    GlTexture texture{0, desc, gl_kind(desc.kind)};
    glCreateTextures(texture.target, 1, &texture.name);
    const auto mips = static_cast<GLsizei>(mip_count(desc));
    const auto width = static_cast<GLsizei>(desc.width), height = static_cast<GLsizei>(desc.height);
    const GLenum internal = gl_format(desc.format).internal;
    if (desc.kind == TextureKind::array) {
        glTextureStorage3D(texture.name, mips, internal, width, height, static_cast<GLsizei>(desc.layers));
    } else {
        glTextureStorage2D(texture.name, mips, internal, width, height);
    }
    Failure failure = take_gl_error();
    if (failure == Failure::none) {
        set_plain_sampling(texture.name);
        set_gl_label(GL_TEXTURE, texture.name, desc.label);
        if (!pixels.empty()) upload(texture, pixels, keeps_state);
        failure = take_gl_error();
    }
    if (failure == Failure::none) return {std::move(texture)};
    glDeleteTextures(1, &texture.name);
    return failed<GlTexture>(failure, desc.label);
}

Made<GLuint> make_sampler(const SamplerDesc& desc) {
    drop_gl_errors();
    GLuint name = 0;
    glCreateSamplers(1, &name);
    const GLint mag = desc.linear ? GL_LINEAR : GL_NEAREST;
    const GLint min_of_mips = desc.linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, mag);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, desc.mipmaps ? min_of_mips : mag);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, gl_wrap(desc.wrap_u));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, gl_wrap(desc.wrap_v));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    if (desc.anisotropy > 1.0f && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        GLfloat most = 1.0f;
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
        glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(desc.anisotropy, most));
    }
    const std::array<GLfloat, 4> border = {0.0f, 0.0f, 0.0f, 0.0f};
    glSamplerParameterfv(name, GL_TEXTURE_BORDER_COLOR, border.data());
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, desc.compare ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    set_gl_label(GL_SAMPLER, name, desc.label);
    const Failure failure = take_gl_error();
    if (failure == Failure::none) return {name};
    glDeleteSamplers(1, &name);
    return failed<GLuint>(failure, desc.label);
}

std::uint64_t most_texel_bytes() {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    return static_cast<std::uint64_t>(most) * kTexelBytes;
}

void delete_texture(const GlTexture& texture) {
    if (!texture.imported) glDeleteTextures(1, &texture.name);
}

namespace {

Failure make_texels(GlBuffer& buffer) {
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &buffer.texels);
    glTextureBuffer(buffer.texels, GL_RGBA32UI, buffer.name);
    set_gl_label(GL_TEXTURE, buffer.texels, buffer.desc.label);
    return take_gl_error();
}

}  // namespace

void delete_buffer(const GlBuffer& buffer) {
    glDeleteTextures(1, &buffer.texels);
    if (!buffer.imported) glDeleteBuffers(1, &buffer.name);
}

Made<GlBuffer> make_buffer(const BufferDesc& desc, std::span<const std::byte> bytes) {
    if (desc.size > static_cast<std::uint64_t>(std::numeric_limits<GLsizeiptr>::max()) ||
        (desc.texels && desc.size > most_texel_bytes())) {
        return failed<GlBuffer>(Failure::out_of_memory, desc.label);
    }
    drop_gl_errors();
    GlBuffer buffer{0, desc};
    glCreateBuffers(1, &buffer.name);
    // A readback buffer lies in client memory, where the processor reads it without the device.
    const GLbitfield flags = desc.use == BufferUse::updated     ? GL_DYNAMIC_STORAGE_BIT
                             : desc.use == BufferUse::read_back ? GL_CLIENT_STORAGE_BIT
                                                                : 0;
    glNamedBufferStorage(buffer.name, static_cast<GLsizeiptr>(desc.size), bytes.empty() ? nullptr : bytes.data(),
                         flags);
    Failure failure = take_gl_error();
    if (failure == Failure::none) {
        // Cleared, because undefined contents would make pictures differ between runs.
        if (bytes.empty()) glClearNamedBufferData(buffer.name, GL_R8, GL_RED, GL_UNSIGNED_BYTE, nullptr);
        set_gl_label(GL_BUFFER, buffer.name, desc.label);
        failure = take_gl_error();
    }
    if (failure == Failure::none && desc.texels) failure = make_texels(buffer);
    if (failure == Failure::none) return {std::move(buffer)};
    delete_buffer(buffer);
    return failed<GlBuffer>(failure, desc.label);
}

Made<GlTarget> make_target(const TargetDesc& desc, const GlObjects& objects) {
    if (desc.colours.size() > kMaxColourAttachments) return failed<GlTarget>(Failure::invalid_value, desc.label);
    constexpr std::uint32_t any_size = std::numeric_limits<std::uint32_t>::max();
    drop_gl_errors();
    GlTarget target{0, any_size, any_size, desc.colours.size()};
    glCreateFramebuffers(1, &target.name);
    Failure failure = Failure::none;
    const auto add = [&](GLenum point, const Attachment& attachment) {
        const GlTexture* texture = find_object(objects.textures, attachment.texture.id);
        const Failure checked = check_attachment(attachment, texture == nullptr ? nullptr : &texture->desc);
        if (texture == nullptr || checked != Failure::none) {
            failure = checked;
            return;
        }
        attach(target.name, point, attachment, *texture);
        target.width = std::min(target.width, texture->desc.width);
        target.height = std::min(target.height, texture->desc.height);
    };
    std::array<GLenum, kMaxColourAttachments> points{};
    for (std::size_t i = 0; i < desc.colours.size(); ++i) {
        points[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        add(points[i], desc.colours[i]);
        const GlTexture* texture = find_object(objects.textures, desc.colours[i].texture.id);
        if (texture != nullptr && is_integer(texture->desc.format)) target.integer_colours |= 1u << i;
    }
    if (desc.depth.texture) add(GL_DEPTH_ATTACHMENT, desc.depth);
    if (desc.colours.empty()) glNamedFramebufferReadBuffer(target.name, GL_NONE);
    glNamedFramebufferDrawBuffers(target.name, static_cast<GLsizei>(desc.colours.size()), points.data());
    if (failure == Failure::none) failure = take_gl_error();
    if (failure == Failure::none &&
        glCheckNamedFramebufferStatus(target.name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        failure = Failure::incomplete_target;
    }
    if (failure == Failure::none) {
        set_gl_label(GL_FRAMEBUFFER, target.name, desc.label);
        return {target};
    }
    glDeleteFramebuffers(1, &target.name);
    return failed<GlTarget>(failure, desc.label);
}

}  // namespace gnomon::gl
