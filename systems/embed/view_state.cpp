#include "systems/embed/view_state.h"

#include <optional>

namespace gnomon::embed {
namespace {

/// Imports a texture, unless it was imported last. Returns {0} if it is no flat texture of that size.
gl::TextureHandle import(gl::Device& device, unsigned name, glm::uvec2 least_px, Imported& held) {
    const std::optional<gl::EngineTexture> texture = gl::describe_texture(device, name);
    const bool fits = texture && texture->desc.kind == gl::TextureKind::flat && texture->desc.width >= least_px.x &&
                      texture->desc.height >= least_px.y;
    if (held.handle && (!fits || held.name != name || !(held.texture == *texture))) {
        device.destroy(held.handle);
        held = {};
    }
    if (fits && !held.handle) held = {name, *texture, gl::import_texture(device, name, texture->desc)};
    return held.handle;
}

/// Sets where the samples of a picture's pixels lie. Queries the device only after a change of the texture.
void put_samples(const gl::Device& device, const Imported& depth, lighting::DepthPicture& picture) {
    if (!depth.texture.multisampled) return picture.samples.clear();
    if (picture.samples.size() == depth.texture.samples) return;
    picture.samples.clear();
    for (const auto& place : gl::sample_positions(device, depth.name))
        picture.samples.emplace_back(place[0] - 0.5, place[1] - 0.5);
}

/// Returns half a step of a depth format with fixed point; 0 for floating point.
lighting::DepthRounding rounding_of(gl::Format format) {
    constexpr double kHalf16 = 0.5 / 0xffff, kHalf24 = 0.5 / 0xffffff;
    return {format == gl::Format::d16                                   ? kHalf16
            : format == gl::Format::d24 || format == gl::Format::d24_s8 ? kHalf24
                                                                        : 0.0};
}

}  // namespace

std::string_view take_textures(gl::Device& device, const View& view, ViewState& state) {
    state.picture.depth = import(device, view.depth_texture, view.size_px, state.depth);
    if (!state.picture.depth || !gl::is_depth(state.depth.texture.desc.format)) return "view.depth";
    state.picture.rounding = rounding_of(state.depth.texture.desc.format);
    put_samples(device, state.depth, state.picture);
    state.picture.normals = {};
    if (view.normal_texture != 0) {
        state.picture.normals = import(device, view.normal_texture, view.size_px, state.normals);
        const gl::EngineTexture &normals = state.normals.texture, &depth = state.depth.texture;
        const bool alike = normals.multisampled == depth.multisampled && normals.samples == depth.samples;
        if (!state.picture.normals || !alike || gl::is_integer(normals.desc.format) ||
            gl::is_depth(normals.desc.format))
            return "view.normals";
    }
    state.picture.range = view.normal_format == NormalFormat::snorm ? lighting::NormalRange::plus_minus_one
                                                                    : lighting::NormalRange::zero_to_one;
    state.picture.view_space = view.normal_space == NormalSpace::view;
    return {};
}

}  // namespace gnomon::embed
