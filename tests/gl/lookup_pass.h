#pragma once
#include "tests/gl/embed_fixture.h"

namespace gnomon {

/// A pass of the engine's over its own depths and normals, which writes the visibility of one light.
class LookupPass {
public:
    explicit LookupPass(const std::string& lookups) {
        const std::string fragment = "#version 450 core\n" + lookups + R"(
layout(binding = 0) uniform sampler2D depths;
layout(binding = 1) uniform sampler2D normals;
uniform mat4 world_from_clip;   // relative to the camera
uniform int light;
uniform bool in_air;
layout(location = 0) out float visible;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).r;
    vec4 place = world_from_clip * vec4(2.0 * vec3(gl_FragCoord.xy / vec2(textureSize(depths, 0)), depth) - 1.0, 1.0);
    vec3 position = place.xyz / place.w, normal = texelFetch(normals, pixel, 0).xyz;
    if (dot(normal, position) > 0.0) normal = -normal;
    // What depths of this format and matrices of floats round.
    float distance_m = length(position), error_m = (1.0e-6 + 1.3e-6 * distance_m) * distance_m;
    visible = depth == 1.0 ? 0.0 : in_air ? gnomon_visibility(light, 0.999 * position) : gnomon_visibility(light, position, normal, error_m);
})";
        program_ = linked(R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); })",
                          fragment.c_str());
        glCreateVertexArrays(1, &array_);
        glCreateTextures(GL_TEXTURE_2D, 1, &target_);
        glTextureStorage2D(target_, 1, GL_R32F, kWidth_px, kHeight_px);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, target_, 0);
    }
    ~LookupPass() {
        glDeleteProgram(program_);
        glDeleteVertexArrays(1, &array_);
        glDeleteTextures(1, &target_);
        glDeleteFramebuffers(1, &framebuffer_);
    }
    std::vector<std::uint8_t> drawn(const Engine& engine, const View& view, int light, bool in_air = false) const {
        const glm::dmat4 clip_from_world = view.clip_from_view * glm::dmat4(glm::inverse(glm::dmat3(view.world_from_view)));
        const glm::mat4 matrix(glm::inverse(clip_from_world));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, kWidth_px, kHeight_px);
        glDisable(GL_DEPTH_TEST);
        glUseProgram(program_);
        glBindTextureUnit(0, engine.depth);
        glBindTextureUnit(1, engine.normals);
        glUniformMatrix4fv(glGetUniformLocation(program_, "world_from_clip"), 1, GL_FALSE, &matrix[0][0]);
        glUniform1i(glGetUniformLocation(program_, "light"), light);
        glUniform1i(glGetUniformLocation(program_, "in_air"), in_air);
        glBindVertexArray(array_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> values(kWidth_px * kHeight_px);
        glGetTextureImage(target_, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
        std::vector<std::uint8_t> bytes;
        for (const float value : values) bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * value)));
        return bytes;
    }

private:
    GLuint program_ = 0, array_ = 0, target_ = 0, framebuffer_ = 0;
};

}  // namespace gnomon
