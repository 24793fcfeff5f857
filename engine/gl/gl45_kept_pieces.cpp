#include "engine/gl/gl45_kept_pieces.h"

namespace gnomon::gl {
namespace {

GLenum indexed_enum(GLenum name, GLuint index) {
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return static_cast<GLenum>(value);
}
GLuint name_bound(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<GLuint>(value);
}

}  // namespace

BlendEquation::Value BlendEquation::read() const {
    return {indexed_enum(GL_BLEND_EQUATION_RGB, buffer), indexed_enum(GL_BLEND_EQUATION_ALPHA, buffer)};
}

BlendFunction::Value BlendFunction::read() const {
    return {indexed_enum(GL_BLEND_SRC_RGB, buffer), indexed_enum(GL_BLEND_DST_RGB, buffer),
            indexed_enum(GL_BLEND_SRC_ALPHA, buffer), indexed_enum(GL_BLEND_DST_ALPHA, buffer)};
}

GLuint TextureBinding::read() const { return name_bound(query); }

GLuint SamplerBinding::read() { return name_bound(GL_SAMPLER_BINDING); }

BufferPart BufferBinding::read() const {
    const bool uniform = target == GL_UNIFORM_BUFFER;
    BufferPart part;
    part.buffer = indexed_enum(uniform ? GL_UNIFORM_BUFFER_BINDING : GL_SHADER_STORAGE_BUFFER_BINDING, index);
    if (part.buffer == 0) return part;
    glGetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_START : GL_SHADER_STORAGE_BUFFER_START, index, &part.offset);
    glGetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_SIZE : GL_SHADER_STORAGE_BUFFER_SIZE, index, &part.size);
    return part;
}

void BufferBinding::write(const BufferPart& part) const {
    const auto offset = static_cast<GLintptr>(part.offset);
    const auto size = static_cast<GLsizeiptr>(part.size);
    if (part.size == 0)
        glBindBuffersBase(target, index, 1, &part.buffer);
    else
        glBindBuffersRange(target, index, 1, &part.buffer, &offset, &size);
}

}  // namespace gnomon::gl
