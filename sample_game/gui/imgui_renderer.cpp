#include "sample_game/gui/imgui_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "gnomon/box.h"

namespace gnomon::game {
namespace {

/// x and y on the clip square, and alpha; linear colour; texture coordinates.
struct OverlayVertex {
    glm::vec3 position_and_alpha, colour;
    glm::vec2 uv;
};
static_assert(sizeof(OverlayVertex) == 32);

constexpr const char* kVertexSource = R"(#version 450 core
layout(location = 0) in vec3 position_and_alpha;
layout(location = 1) in vec3 colour;
layout(location = 2) in vec2 uv;
out vec4 tint;
out vec2 at;
void main() {
    tint = vec4(colour, position_and_alpha.z);
    at = uv;
    gl_Position = vec4(position_and_alpha.xy, 0.0, 1.0);
}
)";
constexpr const char* kFragmentSource = R"(#version 450 core
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 colour_out;
in vec4 tint;
in vec2 at;
void main() { colour_out = tint * texture(image, at); }
)";

/// Converts a channel of ImGui's sRGB colours, 0 to 255, to linear (IEC 61966-2-1). The target encodes again.
float linear(ImU32 colour, unsigned shift) {
    const float encoded = static_cast<float>(colour >> shift & 255u) / 255.0f;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

OverlayVertex converted(const ImDrawVert& v, const ImDrawData& data) {
    const float x = (v.pos.x - data.DisplayPos.x) / data.DisplaySize.x;
    const float y = (v.pos.y - data.DisplayPos.y) / data.DisplaySize.y;
    const float alpha = static_cast<float>(v.col >> IM_COL32_A_SHIFT & 255u) / 255.0f;
    return {{2.0f * x - 1.0f, 1.0f - 2.0f * y, alpha},
            {linear(v.col, IM_COL32_R_SHIFT), linear(v.col, IM_COL32_G_SHIFT), linear(v.col, IM_COL32_B_SHIFT)},
            {v.uv.x, v.uv.y}};
}

/// Converts between ImGui's texture id and a number: ImGui to 1.91 has a pointer there, later ones an integer.
template <typename To, typename From>
To id_cast(From id) {
    if constexpr (std::is_pointer_v<To> || std::is_pointer_v<From>)
        return reinterpret_cast<To>(id);
    else
        return static_cast<To>(id);
}

GLuint texture_of(ImTextureID image) { return static_cast<GLuint>(id_cast<std::uintptr_t>(image)); }

/// Converts ImGui's clip rectangle, y down, to a scissor, y up. Without width or height: nothing to draw.
gl::Rect scissor(const ImVec4& clip, glm::uvec2 size_px) {
    const auto within = [](float value, std::uint32_t most) {
        return static_cast<std::int32_t>(std::clamp(value, 0.0f, static_cast<float>(most)));
    };
    const std::int32_t left = within(clip.x, size_px.x), right = within(clip.z, size_px.x);
    const std::int32_t top = within(clip.y, size_px.y), bottom = within(clip.w, size_px.y);
    return {left, static_cast<std::int32_t>(size_px.y) - bottom, right - left, bottom - top};
}

/// Returns 0 if the program does not link.
GLuint link_program() {
    const GLuint program = glCreateProgram();
    for (const auto& [kind, text] :
         {std::pair(GL_VERTEX_SHADER, kVertexSource), {GL_FRAGMENT_SHADER, kFragmentSource}}) {
        const GLuint shader = glCreateShader(static_cast<GLenum>(kind));
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    glDeleteProgram(program);
    return 0;
}

/// Makes a vertex array that reads OverlayVertex and 32 bit indices.
GLuint make_array(GLuint vertices, GLuint indices) {
    GLuint array = 0;
    glCreateVertexArrays(1, &array);
    glVertexArrayVertexBuffer(array, 0, vertices, 0, sizeof(OverlayVertex));
    glVertexArrayElementBuffer(array, indices);
    const auto add = [&](GLuint location, GLint numbers, std::size_t offset) {
        glEnableVertexArrayAttrib(array, location);
        glVertexArrayAttribFormat(array, location, numbers, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
        glVertexArrayAttribBinding(array, location, 0);
    };
    add(0, 3, offsetof(OverlayVertex, position_and_alpha));
    add(1, 3, offsetof(OverlayVertex, colour));
    add(2, 2, offsetof(OverlayVertex, uv));
    return array;
}

void label(GLenum kind, GLuint name, const char* text) { glObjectLabel(kind, name, -1, text); }

}  // namespace

unsigned make_image(const char* name, glm::uvec2 size_px, const void* rgba8, bool encoded) {
    const auto width = static_cast<GLsizei>(size_px.x), height = static_cast<GLsizei>(size_px.y);
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, encoded ? GL_SRGB8_ALPHA8 : GL_RGBA8, width, height);
    if (glGetError() != GL_NO_ERROR) {
        glDeleteTextures(1, &texture);
        return 0;
    }
    glTextureSubImage2D(texture, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba8);
    label(GL_TEXTURE, texture, name);
    return texture;
}

void destroy_image(unsigned texture) { glDeleteTextures(1, &texture); }

ImTextureID image_of(unsigned texture) { return id_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)); }

Overlay::~Overlay() {
    glDeleteVertexArrays(1, &array_);
    glDeleteBuffers(1, &vertices_);
    glDeleteBuffers(1, &indices_);
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteProgram(program_);
    glDeleteSamplers(1, &sampler_);
    destroy_image(font_);
}

Result<std::unique_ptr<Overlay>> Overlay::create() {
    std::unique_ptr<Overlay> overlay(new Overlay());
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    overlay->font_ = make_image("overlay font", {width, height}, texels, false);
    ImGui::GetIO().Fonts->SetTexID(image_of(overlay->font_));
    glCreateSamplers(1, &overlay->sampler_);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glSamplerParameteri(overlay->sampler_, axis, GL_CLAMP_TO_EDGE);
    for (const GLenum scale : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glSamplerParameteri(overlay->sampler_, scale, GL_LINEAR);
    overlay->program_ = link_program();
    glCreateFramebuffers(1, &overlay->framebuffer_);
    glCreateBuffers(1, &overlay->vertices_);
    glCreateBuffers(1, &overlay->indices_);
    label(GL_BUFFER, overlay->vertices_, "overlay vertices");
    label(GL_BUFFER, overlay->indices_, "overlay indices");
    overlay->array_ = make_array(overlay->vertices_, overlay->indices_);
    if (overlay->font_ == 0 || overlay->program_ == 0)
        return Error{.message = "the device could not make the panels", .rule = "gui.device"};
    label(GL_PROGRAM, overlay->program_, "overlay");
    return overlay;
}

bool Overlay::upload(const ImDrawData& data) {
    std::vector<OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;
    // An array in ImGui to 1.89, an ImVector in later ones; not empty, since there are indices.
    for (const ImDrawList* list : std::span(&data.CmdLists[0], static_cast<std::size_t>(data.CmdListsCount))) {
        for (const ImDrawVert& v : list->VtxBuffer) vertices.push_back(converted(v, data));
        for (const ImDrawIdx index : list->IdxBuffer) indices.push_back(index);
    }
    const auto fill = [](GLuint buffer, const auto& items) {
        glNamedBufferData(buffer, static_cast<GLsizeiptr>(items.size() * sizeof(items[0])), items.data(),
                          GL_STREAM_DRAW);
    };
    fill(vertices_, vertices);
    fill(indices_, indices);
    return glGetError() == GL_NO_ERROR;
}

void Overlay::draw(const ImDrawData& data, unsigned picture, glm::uvec2 size_px) {
    if (data.TotalIdxCount <= 0 || !upload(data)) return;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "overlay");
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, picture, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, static_cast<GLsizei>(size_px.x), static_cast<GLsizei>(size_px.y));
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program_);
    glBindVertexArray(array_);
    glBindSampler(0, sampler_);
    std::uintptr_t first_index = 0;
    GLint first_vertex = 0;
    for (const ImDrawList* list : std::span(&data.CmdLists[0], static_cast<std::size_t>(data.CmdListsCount))) {
        for (const ImDrawCmd& command : list->CmdBuffer) {
            const gl::Rect clip = scissor(command.ClipRect, size_px);
            if (command.UserCallback || clip.width <= 0 || clip.height <= 0) continue;
            glBindTextureUnit(0, texture_of(command.GetTexID()));
            glScissor(clip.x, clip.y, clip.width, clip.height);
            glDrawElementsBaseVertex(
                GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_INT,
                reinterpret_cast<const void*>((first_index + command.IdxOffset) * sizeof(std::uint32_t)),
                first_vertex + static_cast<GLint>(command.VtxOffset));
        }
        first_index += static_cast<std::uintptr_t>(list->IdxBuffer.Size);
        first_vertex += list->VtxBuffer.Size;
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glPopDebugGroup();
}

}  // namespace gnomon::game
