// A deferred renderer of one's own: it draws its surfaces, asks Gnomon's include for the visibility of each light into
// a channel of a mask texture, and lights with that. Exit code 0: mask and picture are dark where they should be.
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "engine/gl/device_gl45.h"
#include "own_context.h"
#include "own_renderer.h"
#include "systems/after_submission.h"

namespace {

using namespace gnomon;

int fail(const std::string& what) {
    std::fprintf(stderr, "deferred: %s\n", what.c_str());
    return 1;
}

/// The ground, and the top of the box: depth and normals, as the stranger has always drawn them.
constexpr const char* kSurfaceVertex = R"(#version 450 core
uniform mat4 clip_from_camera;   // camera: from its place, along the world's axes
uniform vec3 camera_ws;
void main() {
    const vec2 corners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1));
    vec2 corner = corners[gl_VertexID] * (gl_InstanceID == 0 ? 4.0 : 0.5);
    vec3 position_ws = vec3(corner.x, gl_InstanceID == 0 ? 0.0 : 1.5, -corner.y);
    gl_Position = clip_from_camera * vec4(position_ws - camera_ws, 1.0);
}
)";
constexpr const char* kSurfaceFragment = R"(#version 450 core
layout(location = 0) out vec4 normal_out;
void main() { normal_out = vec4(0.0, 1.0, 0.0, 0.0); }
)";
constexpr const char* kEveryPixel = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";

// [mask]
/// One light's visibility over what the depth buffer shows, written into all channels: the colour mask chooses one.
constexpr const char* kMask = R"(
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "lighting/lights/light_sample.glsl"
layout(binding = 0) uniform sampler2D my_depth;
layout(binding = 1) uniform sampler2D my_normals;   // geometric
uniform mat4 camera_from_clip;
layout(location = 0) out vec4 mask;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(my_depth, pixel, 0).r;
    if (depth == 1.0) discard;   // no surface
    vec2 place = gl_FragCoord.xy / vec2(textureSize(my_depth, 0)) * 2.0 - 1.0;
    vec4 rebuilt = camera_from_clip * vec4(place, depth, 1.0);
    vec3 position_ca = rebuilt.xyz / rebuilt.w;
    vec3 normal = texelFetch(my_normals, pixel, 0).xyz;
    float error_m = 1.0e-6 * length(position_ca);   // what depth and its matrix round
    mask = vec4(light_at(position_ca).reaches ? shadow_visibility(position_ca, normal, error_m) : 0.0);
}
)";
// [mask]

// [light]
/// The stranger's own lighting: it knows the mask, and nothing of shadows.
constexpr const char* kLighting = R"(#version 450 core
layout(binding = 1) uniform sampler2D my_normals;
layout(binding = 2) uniform sampler2D my_mask;
uniform vec3 to_light;
uniform int channel;
layout(location = 0) out vec4 colour;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float cosine = max(dot(texelFetch(my_normals, pixel, 0).xyz, to_light), 0.0);
    colour = vec4(vec3(texelFetch(my_mask, pixel, 0)[channel] * cosine / 3.0), 1.0);
}
)";
// [light]

GLuint make_texture(GLenum format) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, kPicture_px, kPicture_px);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return texture;
}

GLuint make_target(GLuint colour, GLuint depth) {
    GLuint target = 0;
    glCreateFramebuffers(1, &target);
    glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, colour, 0);
    if (depth != 0) glNamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, depth, 0);
    return target;
}

using Picture = std::array<unsigned char, kPicture_px * kPicture_px * 4>;

class OwnRenderer {
public:
    explicit OwnRenderer(const glm::dvec3& camera_ws) : camera_ws_(camera_ws) {
        glCreateVertexArrays(1, &layout_);
        const float half = static_cast<float>(kHalfHeight_m);
        const glm::mat4 looking_down = glm::lookAt(glm::vec3(0.0f), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1));
        clip_from_camera_ = glm::orthoRH_ZO(-half, half, -half, half, 0.1f, 20.0f) * looking_down;
    }

    void draw_surfaces() {
        begin(surfaces_);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glClearDepth(1.0);
        glClear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
        for (const GLuint texture : {mask_, picture_}) glClearTexImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        const GLuint program = make_program(kSurfaceVertex, kSurfaceFragment);
        const glm::vec3 camera(camera_ws_);
        glUseProgram(program);
        glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_camera"), 1, GL_FALSE,
                           glm::value_ptr(clip_from_camera_));
        glUniform3f(glGetUniformLocation(program, "camera_ws"), camera.x, camera.y, camera.z);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 2);
        glDisable(GL_DEPTH_TEST);
    }

    // [fill]
    /// Visibility of up to four lights, a channel each: `channel` counts them.
    bool fill_mask(const gl::Device& device, const shadow::LightingLight& light, int channel) {
        const auto fragment = fragment_for(light.row, kMask);
        if (!fragment) return false;
        const GLuint program = make_program(kEveryPixel, fragment.value().c_str());
        if (program == 0) return false;
        begin(mask_target_);
        glColorMask(channel == 0, channel == 1, channel == 2, channel == 3);
        glUseProgram(program);
        const glm::mat4 camera_from_clip = glm::inverse(clip_from_camera_);
        glUniformMatrix4fv(glGetUniformLocation(program, "camera_from_clip"), 1, GL_FALSE,
                           glm::value_ptr(camera_from_clip));
        glNamedBufferSubData(light_buffer_, 0, sizeof light.record, &light.record);
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, light_buffer_);
        glBindTextureUnit(0, depth_);
        glBindTextureUnit(1, normals_);
        glBindTextureUnit(4, gl::gl_name(device, light.map));
        glBindSampler(4, gl::gl_name(device, light.sampler));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        return true;
    }
    // [fill]

    void add_light(const glm::vec3& to_light, int channel) {
        const GLuint program = make_program(kEveryPixel, kLighting);
        begin(picture_target_);
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE);
        glUseProgram(program);
        glUniform3f(glGetUniformLocation(program, "to_light"), to_light.x, to_light.y, to_light.z);
        glUniform1i(glGetUniformLocation(program, "channel"), channel);
        glBindTextureUnit(1, normals_);
        glBindTextureUnit(2, mask_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_BLEND);
    }

    Picture mask() const { return read(mask_target_); }
    Picture picture() const { return read(picture_target_); }

private:
    void begin(GLuint target) const {
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glBindVertexArray(layout_);
        glViewport(0, 0, kPicture_px, kPicture_px);
    }
    static Picture read(GLuint target) {
        Picture rgba{};
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glReadPixels(0, 0, kPicture_px, kPicture_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
        return rgba;
    }

    glm::dvec3 camera_ws_;
    glm::mat4 clip_from_camera_{1.0f};
    GLuint layout_ = 0, light_buffer_ = make_buffer(sizeof(shadow::LightRecord));
    GLuint depth_ = make_texture(GL_DEPTH_COMPONENT32F), normals_ = make_texture(GL_RGBA16_SNORM);
    GLuint mask_ = make_texture(GL_RGBA8), picture_ = make_texture(GL_RGBA8);
    GLuint surfaces_ = make_target(normals_, depth_), mask_target_ = make_target(mask_, 0),
           picture_target_ = make_target(picture_, 0);
};

/// In the middle row: dark beside the box, lit on the other side and on its top.
bool is_right(const Picture& picture, int channel, int lit) {
    const auto at = [&](int column) {
        return int{picture[static_cast<std::size_t>((kMiddleRow * kPicture_px + column) * 4 + channel)]};
    };
    constexpr int kTopColumn = column_of(-0.25), kRounding = 2;
    std::printf("channel %d: %d in the shadow, %d in the light, %d on the box\n", channel, at(kShadowedColumn),
                at(kLitColumn), at(kTopColumn));
    return at(kShadowedColumn) == 0 && std::abs(at(kLitColumn) - lit) <= kRounding &&
           std::abs(at(kTopColumn) - lit) <= kRounding;
}

int run() {
    auto device = gl::make_gl45_device({});
    if (!device) return fail(to_line(device.error()));
    const assets::MeshLibrary library = ground_and_box();
    auto gpu_scene = GpuScene::create(*device.value(), library);
    if (!gpu_scene) return fail(to_line(gpu_scene.error()));
    const SceneSnapshot scene = stage_with({LightKind::directional, LightKind::spot, LightKind::point},
                                           {.filter = ShadowFilter::sharp_4x4, .resolution_px = 2048}, library);
    shadow::ShadowSystem shadows(*device.value());
    gl::CommandList commands;
    FrameReport report;
    gpu_scene.value().update(scene, commands);
    const shadow::ShadowFrame& frame = shadows.update(scene, gpu_scene.value(), {}, commands, report);
    const gl::SubmitResult result = device.value()->submit(commands);
    after_submission({*device.value(), scene, gpu_scene.value(), shadows}, result, false, report);
    if (result.failure != gl::Failure::none) return fail("no depth maps");

    // [frame]
    OwnRenderer own(scene.consumers.front().position_ws_m);
    own.draw_surfaces();
    int channel = 0;
    for (const shadow::LightingLight& light : frame.inputs.front().lights) {
        if (!own.fill_mask(*device.value(), light, channel)) return fail("a mask's program fails");
        own.add_light(glm::vec3(scene.lights[light.light].rotation_ws[2]), channel++);
    }
    // [frame]
    if (glGetError() != GL_NO_ERROR) return fail("OpenGL reports an error");
    const Picture mask = own.mask(), picture = own.picture();
    for (int c = 0; c < channel; ++c)
        if (!is_right(mask, c, 255)) return fail("the mask is not what it should be");
    constexpr int kSlope = 180;  // 255 times the cosine of 45 degrees, in thirds from three lights
    if (channel != 3 || !is_right(picture, 0, kSlope)) return fail("the picture is not what it should be");
    return 0;
}

}  // namespace

int main() {
    const OwnContext context;
    if (!context) return fail("no OpenGL 4.5 context");
    return run();
}
