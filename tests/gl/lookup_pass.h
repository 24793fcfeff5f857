#pragma once
#include "tests/gl/full_screen_pass.h"

namespace gnomon {

/// A pass of the engine's over its own depths and normals, which writes the visibility of one light.
class LookupPass {
public:
    explicit LookupPass(const std::string& lookups)
        : pass_({kWidth_px, kHeight_px}, lookups + R"(
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
})") {}
    std::vector<std::uint8_t> drawn(const Engine& engine, const View& view, int light, bool in_air = false) const {
        const glm::dmat4 clip_from_world = view.clip_from_view * glm::dmat4(glm::inverse(glm::dmat3(view.world_from_view)));
        const glm::mat4 matrix(glm::inverse(clip_from_world));
        glBindTextureUnit(0, engine.depth);
        glBindTextureUnit(1, engine.normals);
        glUniformMatrix4fv(pass_.use("world_from_clip"), 1, GL_FALSE, &matrix[0][0]);
        glUniform1i(pass_.use("light"), light);
        glUniform1i(pass_.use("in_air"), in_air);
        std::vector<std::uint8_t> bytes;
        for (const float value : pass_.drawn()) bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * value)));
        return bytes;
    }

private:
    FullScreenPass pass_;
};

}  // namespace gnomon
