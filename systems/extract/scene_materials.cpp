#include "systems/extract/scene_materials.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "systems/filled_buffer.h"
#include "systems/growing_buffer.h"

namespace gnomon {
namespace {

gl::Wrap wrap(assets::TextureWrap w) {
    switch (w) {
        case assets::TextureWrap::repeat:
            return gl::Wrap::repeat;
        case assets::TextureWrap::mirror:
            return gl::Wrap::mirror;
        case assets::TextureWrap::clamp:
            return gl::Wrap::clamp;
    }
    return gl::Wrap::repeat;
}

MaterialRecord material_record(const assets::Material& m) {
    MaterialRecord r{};
    // A library filled in by hand may contain any value; NaN and negative values become 0.
    const auto within = [](float value, float most) { return value > 0.0f ? std::min(value, most) : 0.0f; };
    constexpr float kMost = 1.0e30f;
    for (int i = 0; i < 4; ++i) r.base_colour[i] = within(m.base_colour[i], kMost);
    for (int i = 0; i < 3; ++i) r.emissive[i] = within(m.emissive[i], kMost);
    r.emissive[3] = m.unlit ? 1.0f : 0.0f;
    r.metallic = within(m.metallic, 1.0f);
    r.roughness = within(m.roughness, 1.0f);
    r.alpha_cutoff = m.alpha_mode == assets::AlphaMode::mask ? m.alpha_cutoff : -1.0f;
    r.has_texture = m.base_colour_texture != assets::kNone ? 1.0f : 0.0f;
    return r;
}

}  // namespace

SceneMaterials& SceneMaterials::operator=(SceneMaterials&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = std::exchange(other.device_, nullptr);
    library_ = other.library_;
    uniforms_ = std::move(other.uniforms_);
    textures_ = std::move(other.textures_);
    samplers_ = std::move(other.samplers_);
    materials_ = std::move(other.materials_);
    confirmed_ = other.confirmed_;
    any_unlit_ = other.any_unlit_;
    most_emissive_ = other.most_emissive_;
    retry_ = other.retry_;
    asked_ = other.asked_;
    return *this;
}

void SceneMaterials::release() {
    if (!device_) return;
    for (const gl::TextureHandle texture : textures_) device_->destroy(texture);
    for (const auto& [reading, sampler] : samplers_) device_->destroy(sampler);
    textures_.clear();
    samplers_.clear();
    device_ = nullptr;
}

SceneMaterials::Failed SceneMaterials::create(gl::Device& device, const assets::MeshLibrary& library) {
    device_ = &device;
    library_ = &library;
    uniforms_ = DeviceArrays(device);
    const std::uint32_t stride = aligned(sizeof(MaterialRecord), device.info().uniform_alignment);
    const auto count = static_cast<std::uint32_t>(library.materials.size());
    std::vector<std::byte> records(std::max(count, 1u) * std::size_t{stride});
    for (std::size_t m = 0; m < count; ++m) {
        const MaterialRecord record = material_record(library.materials[m]);
        std::memcpy(records.data() + m * stride, &record, sizeof record);
    }
    const auto made = filled_buffer(device, "materials", records);
    if (!made) return {"the scene's materials", made.failure};
    uniforms_.put(0, {"materials", stride, false, made.handle});
    uniforms_.start(count, count, false);

    const std::uint8_t kWhite[4] = {255, 255, 255, 255};
    const auto white = device.create_texture({"white", gl::TextureKind::flat, gl::Format::srgb8_a8, 1, 1, 1, 1},
                                             std::as_bytes(std::span(kWhite)));
    if (!white) return {"the scene's textures", white.failure};
    textures_.push_back(white.handle);
    for (const assets::Texture& texture : library.textures)
        if (const gl::Failure f = add_texture(texture); f != gl::Failure::none) return {"the scene's textures", f};
    for (std::size_t m = 0; m < count; ++m)
        if (const gl::Failure f = add_info(m); f != gl::Failure::none) return {"the scene's samplers", f};
    confirmed_ = count;
    return {};
}

gl::Failure SceneMaterials::add_texture(const assets::Texture& t) {
    const auto made = device_->create_texture(
        {"texture " + t.name, gl::TextureKind::flat, gl::Format::srgb8_a8, t.width, t.height, 1, 0},
        std::as_bytes(std::span(t.rgba)));
    if (made) textures_.push_back(made.handle);
    return made.failure;
}

gl::Failure SceneMaterials::sampler_for(assets::TextureWrap u, assets::TextureWrap v, bool linear,
                                        gl::SamplerHandle& sampler) {
    const auto found = samplers_.find({u, v, linear});
    if (found != samplers_.end()) {
        sampler = found->second;
        return gl::Failure::none;
    }
    const auto made = device_->create_sampler({"scene texture", linear, linear, false, wrap(u), wrap(v)});
    sampler = made.handle;
    if (made) samplers_[{u, v, linear}] = sampler;
    return made.failure;
}

/// Appends what users of the material need to know. Its texture is on the device.
gl::Failure SceneMaterials::add_info(std::size_t m) {
    const assets::Material& material = library_->materials[m];
    MaterialInfo info;
    info.uniform_offset =
        static_cast<std::uint32_t>(m) * aligned(sizeof(MaterialRecord), device_->info().uniform_alignment);
    info.alpha_mode = material.alpha_mode;
    info.double_sided = material.double_sided;
    info.unlit = material.unlit;
    const auto t = material.base_colour_texture;
    info.texture = textures_[t == assets::kNone ? 0 : static_cast<std::size_t>(t) + 1];
    const gl::Failure failure =
        t == assets::kNone ? sampler_for(assets::TextureWrap::repeat, assets::TextureWrap::repeat, false, info.sampler)
                           : sampler_for(library_->textures[static_cast<std::size_t>(t)].wrap_u,
                                         library_->textures[static_cast<std::size_t>(t)].wrap_v,
                                         library_->textures[static_cast<std::size_t>(t)].linear_filter, info.sampler);
    if (failure != gl::Failure::none) return failure;
    any_unlit_ |= material.unlit;
    for (int i = 0; i < 3 && !material.unlit; ++i) most_emissive_ = std::max(most_emissive_, material.emissive[i]);
    materials_.push_back(info);
    return gl::Failure::none;
}

void SceneMaterials::follow(gl::CommandList& list) {
    ++asked_;
    for (std::size_t m = confirmed_; m < materials_.size(); ++m) write(m, list);
    if (materials_.size() >= library_->materials.size() || !retry_.due(asked_)) return;
    gl::Failure failure = gl::Failure::none;
    while (failure == gl::Failure::none && textures_.size() <= library_->textures.size())
        failure = add_texture(library_->textures[textures_.size() - 1]);
    while (failure == gl::Failure::none && materials_.size() < library_->materials.size()) {
        const std::size_t m = materials_.size();
        const bool has_room = uniforms_.used() > m || uniforms_.take(1, true, list) != DeviceArrays::kNone;
        failure = has_room ? add_info(m) : gl::Failure::out_of_memory;
        if (failure == gl::Failure::none) write(m, list);
    }
    if (failure != gl::Failure::none) retry_.failed(asked_);
}

void SceneMaterials::write(std::size_t m, gl::CommandList& list) {
    const MaterialRecord record = material_record(library_->materials[m]);
    uniforms_.write(0, static_cast<std::uint32_t>(m), std::span<const MaterialRecord>(&record, 1), list);
}

void SceneMaterials::submitted(bool executed) {
    if (!executed && uniforms_.moved()) confirmed_ = 0;
    if (executed) confirmed_ = materials_.size();
    uniforms_.submitted();
}

}  // namespace gnomon
