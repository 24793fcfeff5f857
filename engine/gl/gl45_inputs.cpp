#include <array>
#include <string>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {
namespace {

/// Returns the target of textures that a sampler of the type reads, or GL_NONE if it is no sampler.
GLenum sampled_target(GLenum type) {
    switch (type) {
        case GL_SAMPLER_1D:
        case GL_SAMPLER_1D_SHADOW:
        case GL_INT_SAMPLER_1D:
        case GL_UNSIGNED_INT_SAMPLER_1D:
            return GL_TEXTURE_1D;
        case GL_SAMPLER_2D:
        case GL_SAMPLER_2D_SHADOW:
        case GL_INT_SAMPLER_2D:
        case GL_UNSIGNED_INT_SAMPLER_2D:
            return GL_TEXTURE_2D;
        case GL_SAMPLER_3D:
        case GL_INT_SAMPLER_3D:
        case GL_UNSIGNED_INT_SAMPLER_3D:
            return GL_TEXTURE_3D;
        case GL_SAMPLER_CUBE:
        case GL_SAMPLER_CUBE_SHADOW:
        case GL_INT_SAMPLER_CUBE:
        case GL_UNSIGNED_INT_SAMPLER_CUBE:
            return GL_TEXTURE_CUBE_MAP;
        case GL_SAMPLER_1D_ARRAY:
        case GL_SAMPLER_1D_ARRAY_SHADOW:
        case GL_INT_SAMPLER_1D_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_1D_ARRAY:
            return GL_TEXTURE_1D_ARRAY;
        case GL_SAMPLER_2D_ARRAY:
        case GL_SAMPLER_2D_ARRAY_SHADOW:
        case GL_INT_SAMPLER_2D_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
            return GL_TEXTURE_2D_ARRAY;
        case GL_SAMPLER_CUBE_MAP_ARRAY:
        case GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW:
        case GL_INT_SAMPLER_CUBE_MAP_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY:
            return GL_TEXTURE_CUBE_MAP_ARRAY;
        case GL_SAMPLER_2D_RECT:
        case GL_SAMPLER_2D_RECT_SHADOW:
        case GL_INT_SAMPLER_2D_RECT:
        case GL_UNSIGNED_INT_SAMPLER_2D_RECT:
            return GL_TEXTURE_RECTANGLE;
        case GL_SAMPLER_BUFFER:
        case GL_INT_SAMPLER_BUFFER:
        case GL_UNSIGNED_INT_SAMPLER_BUFFER:
            return GL_TEXTURE_BUFFER;
        case GL_SAMPLER_2D_MULTISAMPLE:
        case GL_INT_SAMPLER_2D_MULTISAMPLE:
        case GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE:
            return GL_TEXTURE_2D_MULTISAMPLE;
        case GL_SAMPLER_2D_MULTISAMPLE_ARRAY:
        case GL_INT_SAMPLER_2D_MULTISAMPLE_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY:
            return GL_TEXTURE_2D_MULTISAMPLE_ARRAY;
        default:
            return GL_NONE;
    }
}

GLint program_value(GLuint program, GLenum name) {
    GLint value = 0;
    glGetProgramiv(program, name, &value);
    return value;
}

void add_textures(GLuint program, std::vector<GlInput>& inputs) {
    std::string name(static_cast<std::size_t>(program_value(program, GL_ACTIVE_UNIFORM_MAX_LENGTH)) + 1, '\0');
    const auto uniforms = static_cast<GLuint>(program_value(program, GL_ACTIVE_UNIFORMS));
    for (GLuint uniform = 0; uniform < uniforms; ++uniform) {
        GLint elements = 0;
        GLenum type = GL_NONE;
        glGetActiveUniform(program, uniform, static_cast<GLsizei>(name.size()), nullptr, &elements, &type, name.data());
        const GLenum target = sampled_target(type);
        if (target == GL_NONE) continue;
        const GLint location = glGetUniformLocation(program, name.c_str());
        for (GLint element = 0; element < elements; ++element) {
            GLint unit = 0;
            glGetUniformiv(program, location + element, &unit);
            inputs.push_back({target, static_cast<std::uint32_t>(unit)});
        }
    }
}

void add_buffers(GLuint program, GLenum blocks, GLenum kind, std::vector<GlInput>& inputs) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, blocks, GL_ACTIVE_RESOURCES, &count);
    for (GLint block = 0; block < count; ++block) {
        constexpr GLenum what = GL_BUFFER_BINDING;
        GLint binding = 0;
        glGetProgramResourceiv(program, blocks, static_cast<GLuint>(block), 1, &what, 1, nullptr, &binding);
        inputs.push_back({kind, static_cast<std::uint32_t>(binding)});
    }
}

}  // namespace

std::vector<GlInput> inputs_of(GLuint program) {
    std::vector<GlInput> inputs;
    add_textures(program, inputs);
    add_buffers(program, GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER, inputs);
    add_buffers(program, GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER, inputs);
    return inputs;
}

}  // namespace gnomon::gl
