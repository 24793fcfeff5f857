#include "engine/gl/gl45_info.h"

#include <algorithm>
#include <array>

namespace gnomon::gl {

std::uint32_t get_unsigned(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return static_cast<std::uint32_t>(std::max(value, 0));
}

std::string get_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string{} : reinterpret_cast<const char*>(text);
}

namespace {

bool is_software_renderer(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    constexpr std::array names = {"llvmpipe", "softpipe", "swrast", "swiftshader", "software rasterizer"};
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name.find(n) != std::string::npos; });
}

}  // namespace

DeviceInfo read_info() {
    DeviceInfo info;
    const std::string renderer = get_string(GL_RENDERER);
    info.name = renderer + ", OpenGL " + get_string(GL_VERSION);
    info.is_software = is_software_renderer(renderer);
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const auto drawable = static_cast<std::uint32_t>(std::max(std::min(viewport[0], viewport[1]), 0));
    info.max_texture_px = std::min(get_unsigned(GL_MAX_TEXTURE_SIZE), drawable);
    info.max_cube_px = std::min(get_unsigned(GL_MAX_CUBE_MAP_TEXTURE_SIZE), drawable);
    info.max_layers = get_unsigned(GL_MAX_ARRAY_TEXTURE_LAYERS);
    std::array<GLfloat, 2> points{};
    glGetFloatv(GL_POINT_SIZE_RANGE, points.data());
    info.max_point_px = static_cast<std::uint32_t>(std::max(points[1], 1.0f));
    info.uniform_alignment = get_unsigned(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
    info.max_texel_bytes = std::uint64_t{get_unsigned(GL_MAX_TEXTURE_BUFFER_SIZE)} * kTexelBytes;
    info.vertex_layer = epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array");
    return info;
}

}  // namespace gnomon::gl
