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
    white_ = other.white_;
    textures_ = std::move(other.textures_);
    outgrown_ = std::move(other.outgrown_);
    samplers_ = std::move(other.samplers_);
    materials_ = std::move(other.materials_);
    uploaded_ = std::move(other.uploaded_);
    unwritten_ = std::move(other.unwritten_);
    unconfirmed_ = std::move(other.unconfirmed_);
    lacks_ = other.lacks_;
    version_ = other.version_;
    any_masked_ = other.any_masked_;
    any_unlit_ = other.any_unlit_;
    any_transmits_ = other.any_transmits_;
    most_emissive_ = other.most_emissive_;
    seen_ = other.seen_;
    retry_ = other.retry_;
    calls_ = other.calls_;
    return *this;
}

void SceneMaterials::release() {
    if (!device_) return;
    device_->destroy(white_);
    for (const UploadedTexture& texture : textures_) device_->destroy(texture.texture);
    for (const gl::TextureHandle texture : outgrown_) device_->destroy(texture);
    for (const auto& [reading, sampler] : samplers_) device_->destroy(sampler);
    textures_.clear();
    outgrown_.clear();
    samplers_.clear();
    device_ = nullptr;
}

SceneMaterials::Failed SceneMaterials::create(gl::Device& device, const assets::MeshLibrary& library) {
    device_ = &device;
    library_ = &library;
    seen_ = library.version;
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
    white_ = white.handle;
    note_changes();
    for (std::size_t t = 0; t < library.textures.size(); ++t)
        if (const gl::Failure f = make_texture(t); f != gl::Failure::none) return {"the scene's textures", f};
    for (std::size_t m = 0; m < count; ++m)
        if (const gl::Failure f = make_info(m); f != gl::Failure::none) return {"the scene's samplers", f};
    note_lights();
    lacks_ = false;
    return {};
}

/// Lets go of materials and textures that went.
void SceneMaterials::note_changes() {
    seen_ = library_->version;
    lacks_ = true;
    textures_.resize(library_->textures.size());
    materials_.resize(library_->materials.size());
    uploaded_.resize(library_->materials.size());
    for (std::uint32_t t = 0; t < textures_.size(); ++t) {
        const std::uint64_t version = library_->texture_versions.of(t);
        if (textures_[t].state.version == version) continue;
        if (textures_[t].texture) outgrown_.push_back(textures_[t].texture);
        textures_[t] = {{}, {version, false}};
    }
    for (std::uint32_t m = 0; m < uploaded_.size(); ++m) {
        const std::uint64_t version = library_->material_versions.of(m);
        if (uploaded_[m].version != version) uploaded_[m] = {version, false};
    }
}

gl::Failure SceneMaterials::make_texture(std::size_t index) {
    const assets::Texture& t = library_->textures[index];
    UploadedTexture& uploaded = textures_[index];
    const bool was_removed = uploaded.state.version != 0 && t.width == 0;
    gl::Created<gl::TextureHandle> made;
    if (!was_removed)
        made = device_->create_texture(
            {"texture " + t.name, gl::TextureKind::flat, gl::Format::srgb8_a8, t.width, t.height, 1, 0},
            std::as_bytes(std::span(t.rgba)));
    uploaded.texture = made.handle;
    uploaded.state.there = static_cast<bool>(made);
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

/// Fills in what users of the material need to know. Its texture is on the device.
gl::Failure SceneMaterials::make_info(std::size_t m) {
    const assets::Material& material = library_->materials[m];
    MaterialInfo& info = materials_[m];
    info = {};
    ++version_;
    info.uniform_offset =
        static_cast<std::uint32_t>(m) * aligned(sizeof(MaterialRecord), device_->info().uniform_alignment);
    info.alpha_mode = material.alpha_mode;
    info.double_sided = material.double_sided;
    info.unlit = material.unlit;
    info.transmits = assets::transmits(material);
    // Comparing so that NaN lets nothing through.
    for (int i = 0; i < 3; ++i)
        info.transmission[i] = material.transmission[i] > 0.0f ? std::min(material.transmission[i], 1.0f) : 0.0f;
    gl::Failure failure = gl::Failure::none;
    if (material.base_colour_texture == assets::kNone) {
        info.texture = white_;
        failure = sampler_for(assets::TextureWrap::repeat, assets::TextureWrap::repeat, false, info.sampler);
    } else {
        const auto t = static_cast<std::size_t>(material.base_colour_texture);
        const assets::Texture& texture = library_->textures[t];
        info.texture = textures_[t].texture;
        failure = sampler_for(texture.wrap_u, texture.wrap_v, texture.linear_filter, info.sampler);
    }
    uploaded_[m].there = failure == gl::Failure::none;
    return failure;
}

/// Notes what follows from all materials together.
void SceneMaterials::note_lights() {
    any_masked_ = any_unlit_ = any_transmits_ = false;
    most_emissive_ = 0.0f;
    for (const assets::Material& material : library_->materials) {
        any_masked_ |= material.alpha_mode == assets::AlphaMode::mask;
        any_unlit_ |= material.unlit;
        any_transmits_ |= assets::transmits(material);
        for (int i = 0; i < 3 && !material.unlit; ++i) most_emissive_ = std::max(most_emissive_, material.emissive[i]);
    }
}

void SceneMaterials::follow(gl::CommandList& list) {
    ++calls_;
    const bool changed = library_->version != seen_ || uploaded_.size() < library_->materials.size();
    if (changed) note_changes();
    if (changed) note_lights();
    if (lacks_ && retry_.due(calls_)) {
        lacks_ = make_lacking(list) != gl::Failure::none;
        if (lacks_) retry_.failed(calls_);
    }
    for (const std::size_t m : unwritten_) write(m, list);
    unconfirmed_.insert(unconfirmed_.end(), unwritten_.begin(), unwritten_.end());
    unwritten_.clear();
}

/// Makes what is not on the device, until the device refuses.
gl::Failure SceneMaterials::make_lacking(gl::CommandList& list) {
    for (std::size_t t = 0; t < textures_.size(); ++t) {
        if (textures_[t].state.there) continue;
        if (const gl::Failure f = make_texture(t); f != gl::Failure::none) return f;
    }
    for (std::size_t m = 0; m < uploaded_.size(); ++m) {
        if (uploaded_[m].there) continue;
        const auto missing =
            static_cast<std::uint32_t>(m + 1) - std::min(static_cast<std::uint32_t>(m + 1), uniforms_.used());
        const bool has_room =
            (missing == 0 && uniforms_.is_writable()) || uniforms_.take(missing, true, list) != DeviceArrays::kNone;
        if (!has_room) return gl::Failure::out_of_memory;
        if (const gl::Failure f = make_info(m); f != gl::Failure::none) return f;
        unwritten_.push_back(m);
    }
    return gl::Failure::none;
}

void SceneMaterials::write(std::size_t m, gl::CommandList& list) {
    const MaterialRecord record = material_record(library_->materials[m]);
    uniforms_.write(0, static_cast<std::uint32_t>(m), std::span<const MaterialRecord>(&record, 1), list);
}

void SceneMaterials::submitted(bool executed) {
    const bool moved = uniforms_.moved();
    uniforms_.submitted();
    for (const gl::TextureHandle texture : outgrown_) device_->destroy(texture);
    outgrown_.clear();
    if (!executed && !moved) unwritten_.insert(unwritten_.end(), unconfirmed_.begin(), unconfirmed_.end());
    for (std::size_t m = 0; m < uploaded_.size() && !executed && moved; ++m)
        if (uploaded_[m].there) unwritten_.push_back(m);
    unconfirmed_.clear();
}

}  // namespace gnomon
