// A forward renderer of one's own: Gnomon draws the depth maps, the stranger's shader asks for visibility, through
// its own GL calls. Exit code 0: the ground is dark where it should be, for every kind of light and for filters that
// read each kind of map.
#include <epoxy/gl.h>

#include <array>
#include <cstdio>
#include <string>

#include "engine/gl/device_gl45.h"
#include "own_context.h"
#include "own_renderer.h"
#include "shaders/bindings.h"
#include "systems/after_submission.h"

namespace {

using namespace gnomon;

int fail(const std::string& what) {
    std::fprintf(stderr, "forward: %s\n", what.c_str());
    return 1;
}

// [vertex]
/// The ground, without buffers. A position is handed on relative to the camera, as Gnomon's include wants it.
constexpr const char* kVertex = R"(#version 450 core
uniform vec3 camera_ws;
out vec3 position_ca;
void main() {
    const vec2 corners[4] = vec2[](vec2(-2, -2), vec2(2, -2), vec2(-2, 2), vec2(2, 2));
    vec2 corner = corners[gl_VertexID];
    position_ca = vec3(corner.x, 0.0, -corner.y) - camera_ws;
    gl_Position = vec4(corner / 2.0, 0.5, 1.0);
}
)";
// [vertex]

// [fragment]
constexpr const char* kFragment = R"(
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "lighting/lights/light_sample.glsl"
in vec3 position_ca;
layout(location = 0) out vec4 colour;
void main() {
    vec3 normal = vec3(0.0, 1.0, 0.0);   // geometric, unit, facing the viewer
    float error_m = 1.0e-6 * length(position_ca);   // how well this position is known
    LightSample incoming = light_at(position_ca);
    float visible = incoming.reaches ? shadow_visibility(position_ca, normal, error_m) : 0.0;
    colour = vec4(vec3(visible), 1.0);
}
)";
// [fragment]

// [draw]
/// Draws with light `light` as Gnomon published it.
struct OwnBuffers {
    GLuint camera = make_buffer(sizeof(shadow::CameraRecord)), light = make_buffer(sizeof(shadow::LightRecord));
};
void draw(const gl::Device& device, const GpuScene& scene, GLuint program, const OwnBuffers& buffers,
          const shadow::LightingInputs& inputs, const shadow::LightingLight& light, const glm::dvec3& camera_ws) {
    const glm::vec3 camera(camera_ws);
    glUseProgram(program);
    glUniform3f(glGetUniformLocation(program, "camera_ws"), camera.x, camera.y, camera.z);
    glNamedBufferSubData(buffers.light, 0, sizeof light.record, &light.record);
    glBindBufferBase(GL_UNIFORM_BUFFER, bindings::kLightBlock, buffers.light);
    glBindTextureUnit(bindings::kShadowMapUnit, gl::gl_name(device, light.map));
    glBindSampler(bindings::kShadowMapUnit, gl::gl_name(device, light.sampler));
    if (light.row.footprint || light.row.triangles || light.row.rays) {
        glNamedBufferSubData(buffers.camera, 0, sizeof inputs.camera, &inputs.camera);
        glBindBufferBase(GL_UNIFORM_BUFFER, bindings::kCameraBlock, buffers.camera);
    }
    if (light.row.triangles || light.row.rays)
        glBindTextureUnit(bindings::kInstanceUnit, gl::gl_texels_name(device, scene.instances()));
    if (light.row.triangles) {
        glBindTextureUnit(bindings::kShownTriangleUnit, gl::gl_name(device, light.triangles));
        glBindSampler(bindings::kShownTriangleUnit, 0);
        glBindTextureUnit(bindings::kCasterTriangleUnit, gl::gl_texels_name(device, scene.caster_triangles()));
        if (light.row.ray_masks)
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bindings::kMaskBuffer,
                             gl::gl_name(device, scene.caster_masks()));
    }
    if (light.row.rays) {
        const visibility::RayBuffers& rays = light.rays;
        GLuint unit = bindings::kRayNodeUnit;
        for (const gl::BufferHandle texels : {rays.nodes, rays.triangles, rays.top, rays.instances})
            glBindTextureUnit(unit++, gl::gl_texels_name(device, texels));
        if (light.row.ray_masks)
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bindings::kMaskBuffer, gl::gl_name(device, rays.masks));
    }
    if (light.row.sheets) {
        glBindTextureUnit(bindings::kSecondDepthUnit, gl::gl_name(device, light.second));
        glBindTextureUnit(bindings::kBoundsUnit, gl::gl_name(device, light.bounds));
        for (const GLuint unit : {bindings::kSecondDepthUnit, bindings::kBoundsUnit}) glBindSampler(unit, 0);
        if (light.ends)
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bindings::kPyramidBuffer, gl::gl_name(device, light.ends));
    }
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}
// [draw]

/// A filter, and what of ShaderKey it is here to show.
struct Case {
    const char* name;
    LightShadow shadow;
    bool shadow::ShaderKey::*needs;
    ShadowTuning tuning = {};
    float source_radius_m = 0.0f, sun_radius_rad = 0.0f;
};

int check(LightKind kind, const Case& wanted) {
    auto device = gl::make_gl45_device({});
    if (!device) return fail(to_line(device.error()));
    const assets::MeshLibrary library = ground_and_box();
    auto gpu_scene = GpuScene::create(*device.value(), library);
    if (!gpu_scene) return fail(to_line(gpu_scene.error()));
    SceneSnapshot scene = stage_with({kind}, wanted.shadow, library);
    LightItem& lamp = scene.lights.front();
    lamp.tuning = wanted.tuning;
    lamp.source_radius_m = wanted.source_radius_m;
    lamp.sun_radius_rad = wanted.sun_radius_rad;

    // [shadows]
    shadow::ShadowSystem shadows(*device.value());
    gl::CommandList commands;
    FrameReport report;
    gpu_scene.value().update(scene, commands);
    const shadow::ShadowFrame& frame = shadows.update(scene, gpu_scene.value(), {}, commands, report);
    const gl::SubmitResult result = device.value()->submit(commands);
    after_submission({*device.value(), scene, gpu_scene.value(), shadows}, result, false, report);
    const shadow::LightingInputs& inputs = frame.inputs.front();
    const shadow::LightingLight& light = inputs.lights.front();
    // [shadows]
    if (result.failure != gl::Failure::none || !(light.map || light.row.rays)) return fail("no depth map");
    if (!(light.row.*wanted.needs)) return fail(std::string(wanted.name) + " does not ask for what it is here to show");

    const auto fragment = fragment_for(light.row, kFragment);
    if (!fragment) return fail(to_line(fragment.error()));
    const GLuint program = make_program(kVertex, fragment.value().c_str());
    if (program == 0) return fail("the program does not link");
    GLuint target = 0, picture = 0, layout = 0;
    glCreateRenderbuffers(1, &picture);
    glNamedRenderbufferStorage(picture, GL_RGBA8, kPicture_px, kPicture_px);
    glCreateFramebuffers(1, &target);
    glNamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture);
    glCreateVertexArrays(1, &layout);

    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glBindVertexArray(layout);
    glViewport(0, 0, kPicture_px, kPicture_px);
    draw(*device.value(), gpu_scene.value(), program, {}, inputs, light, scene.consumers.front().position_ws_m);
    std::array<unsigned char, kPicture_px * kPicture_px * 4> rgba{};
    glReadPixels(0, 0, kPicture_px, kPicture_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    const GLenum error = glGetError();
    const auto red = [&](int column) {
        return int{rgba[static_cast<std::size_t>((kMiddleRow * kPicture_px + column) * 4)]};
    };
    std::printf("%s, %s: visibility %d in the shadow, %d in the light, of 255\n", wanted.name,
                std::string(light.row.kind_define).c_str(), red(kShadowedColumn), red(kLitColumn));
    if (error != GL_NO_ERROR) return fail("OpenGL reports an error");
    constexpr int kBlur = 2;  // a hundredth, which prefiltered maps may be off
    if (red(kShadowedColumn) > kBlur || red(kLitColumn) < 255 - kBlur)
        return fail("the shadow is not where it belongs");
    return 0;
}

}  // namespace

int main() {
    const OwnContext context;
    if (!context) return fail("no OpenGL 4.5 context");
    const Case cases[] = {
        {"sharp_4x4", {.filter = ShadowFilter::sharp_4x4, .resolution_px = 2048}, &shadow::ShaderKey::depths},
        {"triangles", {.filter = ShadowFilter::triangles}, &shadow::ShaderKey::triangles},
        {"moments", {.filter = ShadowFilter::moments, .resolution_px = 512}, &shadow::ShaderKey::moments},
        {"evsm4 with mipmaps",
         {.filter = ShadowFilter::evsm4, .resolution_px = 2048},
         &shadow::ShaderKey::footprint,
         {.moments = {.levels = 2, .anisotropy = 4}}},
        {"pcss", {.filter = ShadowFilter::pcss}, &shadow::ShaderKey::depths, {}, 1.0f, 0.01f},
        {"exact", {.filter = ShadowFilter::exact}, &shadow::ShaderKey::sheets},
        {"exact_soft", {.filter = ShadowFilter::exact_soft}, &shadow::ShaderKey::sheets, {}, 1.0f, 0.01f},
        {"exact without a map",
         {.filter = ShadowFilter::exact},
         &shadow::ShaderKey::rays,
         {.projection = {.kind = LightProjection::perspective}}}};
    int failed = 0;
    for (const Case& one : cases)
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
            failed |= check(kind, one);
    return failed;
}
