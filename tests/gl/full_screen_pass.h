#pragma once
#include "tests/gl/embed_fixture.h"

namespace gnomon {

/// A pass of the engine's that writes one float to each pixel of a target of its own.
class FullScreenPass {
public:
    /// Makes the pass. `fragment`: text after the version, with a float output at location 0.
    FullScreenPass(glm::ivec2 size_px, const std::string& fragment) : size_px_(size_px) {
        program_ = linked(R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); })",
                          ("#version 450 core\n" + fragment).c_str());
        glCreateVertexArrays(1, &array_);
        glCreateTextures(GL_TEXTURE_2D, 1, &target_);
        glTextureStorage2D(target_, 1, GL_R32F, size_px.x, size_px.y);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, target_, 0);
    }
    ~FullScreenPass() {
        glDeleteProgram(program_);
        glDeleteVertexArrays(1, &array_);
        glDeleteTextures(1, &target_);
        glDeleteFramebuffers(1, &framebuffer_);
    }
    FullScreenPass(const FullScreenPass&) = delete;
    FullScreenPass& operator=(const FullScreenPass&) = delete;

    /// Makes the program current and returns the location of a uniform.
    GLint use(const char* uniform) const {
        glUseProgram(program_);
        return glGetUniformLocation(program_, uniform);
    }
    /// Draws, with the textures that are bound and the uniforms that are set. Returns the pixels, row by row.
    std::vector<float> drawn() const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, size_px_.x, size_px_.y);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glUseProgram(program_);
        glBindVertexArray(array_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> values(static_cast<std::size_t>(size_px_.x * size_px_.y));
        glGetTextureImage(target_, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                          values.data());
        return values;
    }

private:
    glm::ivec2 size_px_;
    GLuint program_ = 0, array_ = 0, target_ = 0, framebuffer_ = 0;
};

}  // namespace gnomon
