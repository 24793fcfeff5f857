#include "sample_game/gui/imgui_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>
#include <vector>

namespace gnomon::game {
namespace {

/// The device's mesh layout, filled otherwise: x and y on the clip square and alpha; colour; texture coordinates.
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

gl::TextureHandle texture_of(ImTextureID image) {
    return {static_cast<decltype(gl::TextureHandle::id)>(id_cast<std::uintptr_t>(image))};
}

/// Converts ImGui's clip rectangle, y down, to a scissor, y up. Without width or height: nothing to draw.
gl::Rect scissor(const ImVec4& clip, glm::uvec2 size_px) {
    const auto within = [](float value, std::uint32_t most) {
        return static_cast<std::int32_t>(std::clamp(value, 0.0f, static_cast<float>(most)));
    };
    const std::int32_t left = within(clip.x, size_px.x), right = within(clip.z, size_px.x);
    const std::int32_t top = within(clip.y, size_px.y), bottom = within(clip.w, size_px.y);
    return {left, static_cast<std::int32_t>(size_px.y) - bottom, right - left, bottom - top};
}

}  // namespace

ImTextureID image_of(gl::TextureHandle texture) {
    return id_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.id));
}

Overlay::Overlay(gl::Device& device)
    : device_(device),
      vertices_(device, "overlay vertices"),
      indices_(device, "overlay indices"),
      items_(device, "overlay items") {}

Overlay::~Overlay() {
    device_.destroy(program_);
    device_.destroy(sampler_);
    device_.destroy(font_);
}

Result<std::unique_ptr<Overlay>> Overlay::create(gl::Device& device) {
    std::unique_ptr<Overlay> overlay(new Overlay(device));
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const gl::TextureDesc font{.label = "overlay font",
                               .format = gl::Format::rgba8,
                               .width = static_cast<std::uint32_t>(width),
                               .height = static_cast<std::uint32_t>(height)};
    overlay->font_ = device.create_texture(font, std::as_bytes(std::span(texels, bytes))).handle;
    ImGui::GetIO().Fonts->SetTexID(image_of(overlay->font_));
    overlay->sampler_ = device.create_sampler({.label = "overlay font", .linear = true}).handle;
    overlay->program_ =
        device.create_program({.label = "overlay", .vertex = kVertexSource, .fragment = kFragmentSource}).handle;
    if (!overlay->font_ || !overlay->sampler_ || !overlay->program_)
        return Error{.message = "the device could not make the panels", .rule = "gui.device"};
    return overlay;
}

bool Overlay::reserve(const ImDrawData& data) {
    return vertices_.reserve(sizeof(OverlayVertex) * static_cast<std::size_t>(data.TotalVtxCount)) &&
           indices_.reserve(sizeof(std::uint32_t) * static_cast<std::size_t>(data.TotalIdxCount)) &&
           items_.reserve(sizeof(glm::uvec2));
}

void Overlay::record(const ImDrawData& data, gl::TargetHandle target, glm::uvec2 size_px, gl::CommandList& list) {
    if (data.TotalIdxCount <= 0 || !target || !reserve(data)) return;
    std::vector<OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;
    // An array in ImGui to 1.89, an ImVector in later ones; not empty, since there are indices.
    const std::span draws(&data.CmdLists[0], static_cast<std::size_t>(data.CmdListsCount));
    for (const ImDrawList* draw : draws) {
        for (const ImDrawVert& v : draw->VtxBuffer) vertices.push_back(converted(v, data));
        for (const ImDrawIdx index : draw->IdxBuffer) indices.push_back(index);
    }
    const std::array<glm::uvec2, 1> item{glm::uvec2(0u)};
    list.add(gl::BeginGroup{"overlay"});
    list.update(vertices_.handle(), 0, std::span<const OverlayVertex>(vertices));
    list.update(indices_.handle(), 0, std::span<const std::uint32_t>(indices));
    list.update(items_.handle(), 0, std::span<const glm::uvec2>(item));
    list.add(
        gl::BeginPass{.target = target,
                      .viewport = {0, 0, static_cast<std::int32_t>(size_px.x), static_cast<std::int32_t>(size_px.y)}});
    list.add(gl::SetPipeline{{.program = program_, .blend = gl::Blend::alpha}});
    list.add(gl::BindMeshes{vertices_.handle(), indices_.handle(), items_.handle()});
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    for (const ImDrawList* draw : draws) {
        for (const ImDrawCmd& command : draw->CmdBuffer) {
            const gl::Rect clip = scissor(command.ClipRect, size_px);
            if (command.UserCallback || clip.width <= 0 || clip.height <= 0) continue;
            list.add(gl::BindTexture{0, texture_of(command.GetTexID()), sampler_});
            list.add(gl::SetScissor{clip});
            list.add(gl::DrawMeshes{first_index + command.IdxOffset, command.ElemCount,
                                    first_vertex + static_cast<std::int32_t>(command.VtxOffset), 0, 1});
        }
        first_index += static_cast<std::uint32_t>(draw->IdxBuffer.Size);
        first_vertex += draw->VtxBuffer.Size;
    }
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::game
