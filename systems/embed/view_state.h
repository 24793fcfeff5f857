#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/gl/device_gl45.h"
#include "gnomon/shadows.h"
#include "systems/embed/picture_lens.h"
#include "systems/lighting/mask_pass.h"
#include "systems/lookup/lookup_table.h"

namespace gnomon::embed {

/// Texture of the engine's own, as it was last imported.
struct Imported {
    unsigned name = 0;
    gl::EngineTexture texture;
    gl::TextureHandle handle{};
};

/// One view: its mask, and the engine's textures that it reads.
struct ViewState {
    ViewState(gl::Device& device, lighting::LightPrograms& programs) : mask(device, programs) {}
    lighting::MaskPass mask;
    Imported depth, normals;
    PictureReach reach;
    lighting::DepthPicture picture;
    std::unique_ptr<lookup::LookupTable> table;  // null: ShadowsOptions::lookup is empty
    std::vector<std::uint32_t> layers;           // index of a light per layer
    bool wants_mask = true;
    std::uint32_t noise_frame = 0;
    bool has_table = false;  // it was written in the last render()
    std::string_view failure;
};

/// Takes the depths and normals of a view that wants a mask. Returns why they cannot be read (Mask::failure); empty:
/// they can.
std::string_view take_textures(gl::Device& device, const View& view, ViewState& state);

}  // namespace gnomon::embed
