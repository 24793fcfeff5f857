#include "systems/extract/ray_masks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace gnomon {
namespace {

constexpr std::uint32_t kWordsPerTriangle = 6;  // u and v of three corners
constexpr std::uint32_t kWordsWithColours = 9;  // and the alpha of their colours
constexpr std::uint32_t kLinear = 1, kColoured = 2;
constexpr std::size_t kTexelsPerWord = 4;

}  // namespace

float mean_chord_texel(const assets::Texture& texture, float alpha, float cutoff) {
    const auto is_left = [&](std::uint32_t x, std::uint32_t y) {
        const std::size_t i = std::size_t{y} * texture.width + x;
        return alpha * static_cast<float>(texture.rgba[4 * i + 3]) / 255.0f >= cutoff;
    };
    std::uint64_t left = 0, begins = 0;  // remaining texels; starts of runs along rows and columns
    for (std::uint32_t y = 0; y < texture.height; ++y)
        for (std::uint32_t x = 0; x < texture.width; ++x) {
            if (!is_left(x, y)) continue;
            ++left;
            begins += is_left((x + texture.width - 1) % texture.width, y) ? 0 : 1;
            begins += is_left(x, (y + texture.height - 1) % texture.height) ? 0 : 1;
        }
    if (left == 0) return 0.0f;
    if (begins == 0) return std::numeric_limits<float>::infinity();
    return static_cast<float>(2.0 * static_cast<double>(left) / static_cast<double>(begins));
}

RayMasks::Place RayMasks::place(std::uint32_t mesh, std::uint32_t triangle, std::uint32_t material) {
    const bool coloured = !library_->meshes[mesh].colours.empty();
    const std::uint32_t words = coloured ? kWordsWithColours : kWordsPerTriangle;
    return {mask_of(material, coloured), uvs_of(mesh) + words * triangle};
}

std::uint32_t RayMasks::mask_of(std::uint32_t index, bool coloured) {
    std::vector<Words>& places = coloured ? coloured_ : materials_;
    places.resize(library_->materials.size());
    Words& place = places[index];
    const std::uint64_t version = library_->material_versions.of(index);
    if (place.count > 0 && place.version == version) return place.first;
    ranges_.give(place.first, place.count);
    const assets::Material& material = library_->materials[index];
    RayMask mask{.cutoff = material.alpha_cutoff,
                 .alpha = material.base_colour.a,
                 .linear = coloured ? kColoured : 0,
                 .chord_texel = std::numeric_limits<float>::infinity()};
    const auto texture = static_cast<std::size_t>(material.base_colour_texture);
    if (material.base_colour_texture >= 0 && texture < library_->textures.size()) {
        const assets::Texture& t = library_->textures[texture];
        mask.texels = texels_of(material.base_colour_texture);
        mask.width = t.width;
        mask.height = t.height;
        mask.wrap_u = static_cast<std::uint32_t>(t.wrap_u);
        mask.wrap_v = static_cast<std::uint32_t>(t.wrap_v);
        mask.linear |= t.linear_filter ? kLinear : 0;
        if (mask.texels != kUnset) mask.chord_texel = mean_chord_texel(t, mask.alpha, mask.cutoff);
    }
    const auto words = std::bit_cast<std::array<std::uint32_t, sizeof(RayMask) / sizeof(std::uint32_t)>>(mask);
    place = {room_for(words.size()), static_cast<std::uint32_t>(words.size()), version};
    std::copy(words.begin(), words.end(), words_.begin() + place.first);
    return place.first;
}

/// Returns the first word of a texture's texels. kUnset, which shaders read as no texture, if its data are incomplete.
std::uint32_t RayMasks::texels_of(std::int32_t index) {
    textures_.resize(library_->textures.size());
    Words& place = textures_[static_cast<std::size_t>(index)];
    const assets::Texture& texture = library_->textures[static_cast<std::size_t>(index)];
    const std::uint64_t version = library_->texture_versions.of(static_cast<std::uint32_t>(index));
    if (place.count > 0 && place.version == version) return place.first;
    ranges_.give(place.first, place.count);
    place = {};
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    if (texels == 0 || texture.rgba.size() < 4 * texels) return kUnset;
    const std::size_t count = (texels + kTexelsPerWord - 1) / kTexelsPerWord;
    place = {room_for(count), static_cast<std::uint32_t>(count), version};
    std::uint32_t* word = words_.data() + place.first;
    std::fill_n(word, count, 0u);
    for (std::size_t i = 0; i < texels; ++i)
        word[i / kTexelsPerWord] |= std::uint32_t{texture.rgba[4 * i + 3]} << (8 * (i % kTexelsPerWord));
    return place.first;
}

std::uint32_t RayMasks::uvs_of(std::uint32_t index) {
    if (uvs_.size() < library_->meshes.size()) uvs_.resize(library_->meshes.size());
    if (uvs_[index].count > 0) return uvs_[index].first;
    const assets::Mesh& mesh = library_->meshes[index];
    const std::uint32_t per_triangle = mesh.colours.empty() ? kWordsPerTriangle : kWordsWithColours;
    const auto count = static_cast<std::uint32_t>(mesh.indices.size() / 3) * per_triangle;
    uvs_[index] = {room_for(count), count, library_->version_of(index)};
    std::uint32_t* word = words_.data() + uvs_[index].first;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corners = &mesh.indices[i];
        for (std::size_t c = 0; c < 3; ++c)
            for (const float coordinate : {mesh.vertices[corners[c]].uv.x, mesh.vertices[corners[c]].uv.y})
                *word++ = std::bit_cast<std::uint32_t>(coordinate);
        for (std::size_t c = 0; c < 3 && !mesh.colours.empty(); ++c)
            *word++ = std::bit_cast<std::uint32_t>(mesh.colours[corners[c]].a);
    }
    return uvs_[index].first;
}

void RayMasks::forget(std::uint32_t mesh) {
    if (mesh >= uvs_.size()) return;
    ranges_.give(uvs_[mesh].first, uvs_[mesh].count);
    uvs_[mesh] = {};
    ranges_.resize(ranges_.end());
    words_.resize(ranges_.places());
}

/// Returns the first of `count` words that are free, and marks them as changed.
std::uint32_t RayMasks::room_for(std::size_t count) {
    const auto words = static_cast<std::uint32_t>(count);
    std::uint32_t first = ranges_.take(words);
    if (first == RangeList::kNone) {
        ranges_.resize(ranges_.end() + words);
        first = ranges_.take(words);
        words_.resize(ranges_.places());
    }
    if (!changes_.empty() && changes_.back().first + changes_.back().count == first)
        changes_.back().count += words;
    else if (words > 0)
        changes_.push_back({first, words});
    return first;
}

}  // namespace gnomon
