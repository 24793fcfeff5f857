#include "engine/gl/device_facts.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace gnomon::gl {
namespace {

/// Limit that glGetInteger64v reports.
struct QueriedLimit {
    GLenum name;
    DeviceLimit limit;
};

// Minimum that OpenGL 4.5 guarantees, or less where Gnomon needs less.
constexpr QueriedLimit kQueried[] = {
    {GL_MAX_TEXTURE_SIZE, {"MAX_TEXTURE_SIZE", 0, 16384}},
    {GL_MAX_CUBE_MAP_TEXTURE_SIZE, {"MAX_CUBE_MAP_TEXTURE_SIZE", 0, 16384}},
    {GL_MAX_ARRAY_TEXTURE_LAYERS, {"MAX_ARRAY_TEXTURE_LAYERS", 0, 2048}},
    {GL_MAX_TEXTURE_BUFFER_SIZE, {"MAX_TEXTURE_BUFFER_SIZE", 0, 65536}},
    {GL_MAX_TEXTURE_IMAGE_UNITS, {"MAX_TEXTURE_IMAGE_UNITS", 0, 16}},
    {GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, {"MAX_COMBINED_TEXTURE_IMAGE_UNITS", 0, 32}},
    {GL_MAX_UNIFORM_BLOCK_SIZE, {"MAX_UNIFORM_BLOCK_SIZE", 0, 16384}},
    {GL_MAX_UNIFORM_BUFFER_BINDINGS, {"MAX_UNIFORM_BUFFER_BINDINGS", 0, 16}},
    {GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, {"UNIFORM_BUFFER_OFFSET_ALIGNMENT", 0, 256, true}},
    {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, {"MAX_SHADER_STORAGE_BUFFER_BINDINGS", 0, 8}},
    {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, {"MAX_SHADER_STORAGE_BLOCK_SIZE", 0, std::int64_t{1} << 24U}},
    {GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, {"MAX_FRAGMENT_SHADER_STORAGE_BLOCKS", 0, 8}},
    {GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, {"MAX_COMPUTE_SHADER_STORAGE_BLOCKS", 0, 8}},
    {GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, {"MAX_COMPUTE_WORK_GROUP_INVOCATIONS", 0, 1024}},
    {GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, {"MAX_COMPUTE_SHARED_MEMORY_SIZE", 0, 32768}},
    {GL_MAX_COLOR_ATTACHMENTS, {"MAX_COLOR_ATTACHMENTS", 0, 8}},
    {GL_MAX_DEBUG_GROUP_STACK_DEPTH, {"MAX_DEBUG_GROUP_STACK_DEPTH", 0, 64}},
    {GL_MAX_LABEL_LENGTH, {"MAX_LABEL_LENGTH", 0, 256}},
};

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string{} : reinterpret_cast<const char*>(text);
}

void add_odd_limits(std::vector<DeviceLimit>& limits) {
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    limits.push_back({"MAX_VIEWPORT_DIMS", std::min(viewport[0], viewport[1]), 16384});
    std::array<GLfloat, 2> points{};
    glGetFloatv(GL_POINT_SIZE_RANGE, points.data());
    limits.push_back({"POINT_SIZE_RANGE", static_cast<std::int64_t>(points[1]), 1});
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    limits.push_back({"QUERY_COUNTER_BITS", bits, 0});
}

std::vector<DeviceExtension> read_extensions() {
    std::vector<DeviceExtension> extensions = {
        {"GL_ARB_shader_viewport_layer_array", false, "cube_route=layered_vertex; without it six passes"},
        {"GL_EXT_texture_filter_anisotropic", false, "textures, moment_anisotropy; without it one sample"},
    };
    for (DeviceExtension& extension : extensions) extension.there = epoxy_has_gl_extension(extension.name);
    return extensions;
}

}  // namespace

DeviceFacts read_device_facts() {
    DeviceFacts facts;
    facts.vendor = text_of(GL_VENDOR);
    facts.renderer = text_of(GL_RENDERER);
    facts.version = text_of(GL_VERSION);
    facts.glsl = text_of(GL_SHADING_LANGUAGE_VERSION);
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    facts.robust = strategy == GL_LOSE_CONTEXT_ON_RESET;
    for (QueriedLimit queried : kQueried) {
        GLint64 value = 0;
        glGetInteger64v(queried.name, &value);
        queried.limit.value = value;
        facts.limits.push_back(queried.limit);
    }
    add_odd_limits(facts.limits);
    facts.extensions = read_extensions();
    return facts;
}

}  // namespace gnomon::gl
