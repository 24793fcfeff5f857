#include "engine/gl/gl45_shared_layers.h"

#include <algorithm>
#include <string>

namespace gnomon::gl {

namespace {

constexpr std::uint32_t kArrayTexels = 1u << 24;  // size of the first array: 64 MiB of depths

bool is_alike(const TextureDesc& array, const TextureDesc& desc) {
    return array.format == desc.format && array.width == desc.width && array.height == desc.height;
}

TextureDesc array_desc(const TextureDesc& desc, std::uint32_t layers) {
    return {.label = "shared layers of " + std::to_string(desc.width) + " texels",
            .kind = TextureKind::array,
            .format = desc.format,
            .width = desc.width,
            .height = desc.height,
            .layers = layers};
}

Made<GlTexture> make_view(const TextureDesc& desc, const GlTexture& array, std::uint32_t id, std::uint32_t first) {
    drop_gl_errors();
    GlTexture view{0, desc, gl_kind(desc.kind), false, id, first};
    glGenTextures(1, &view.name);
    glTextureView(view.name, gl_kind(desc.kind), array.name, gl_format(desc.format).internal, 0, 1, first,
                  layer_count(desc));
    set_plain_sampling(view.name);
    set_gl_label(GL_TEXTURE, view.name, desc.label);
    const Failure failure = take_gl_error();
    if (failure == Failure::none) return {std::move(view)};
    glDeleteTextures(1, &view.name);
    return {{}, failure, '"' + desc.label + "\": " + to_text(failure)};
}

}  // namespace

std::uint32_t shared_array_layers(const TextureDesc& desc, std::uint32_t others, std::uint32_t most_layers) {
    const std::uint64_t texels = std::uint64_t{desc.width} * desc.height;
    const std::uint64_t usual =
        others > 0 ? std::uint64_t{2} * others : kArrayTexels / std::max<std::uint64_t>(texels, 1);
    return static_cast<std::uint32_t>(
        std::max<std::uint64_t>(layer_count(desc), std::min<std::uint64_t>(usual, most_layers)));
}

std::uint32_t find_layers(const SharedArray& array, std::uint32_t count) {
    std::uint32_t free = 0;
    for (std::uint32_t layer = 0; layer < array.used.size(); ++layer) {
        free = array.used[layer] ? 0 : free + 1;
        if (free == count) return layer + 1 - count;
    }
    return static_cast<std::uint32_t>(array.used.size());
}

Made<GlTexture> SharedArrays::make(const TextureDesc& desc, std::uint32_t most_layers, GlObjects& objects,
                                   std::uint32_t& next_id) {
    const std::uint32_t count = layer_count(desc);
    std::uint32_t most_used = 0;
    for (SharedArray& array : arrays_) {
        const GlTexture& texture = objects.textures.at(array.texture);
        if (!is_alike(texture.desc, desc)) continue;
        const std::uint32_t first = find_layers(array, count);
        if (first < array.used.size()) {
            Made<GlTexture> made = make_view(desc, texture, array.texture, first);
            if (made.failure == Failure::none) std::fill_n(array.used.begin() + first, count, true);
            return made;
        }
        most_used = std::max(most_used, texture.desc.layers);
    }
    Made<GlTexture> array =
        make_texture(array_desc(desc, shared_array_layers(desc, most_used, most_layers)), {}, false);
    if (array.failure == Failure::out_of_memory) array = make_texture(array_desc(desc, count), {}, false);
    if (array.failure != Failure::none) return array;
    Made<GlTexture> made = make_view(desc, array.object, next_id, 0);
    if (made.failure != Failure::none) {
        glDeleteTextures(1, &array.object.name);
        return made;
    }
    arrays_.push_back({next_id, std::vector<bool>(array.object.desc.layers)});
    std::fill_n(arrays_.back().used.begin(), count, true);
    objects.textures.emplace(next_id++, std::move(array.object));
    return made;
}

void SharedArrays::release(const GlTexture& texture, GlObjects& objects) {
    const auto array =
        std::find_if(arrays_.begin(), arrays_.end(), [&](const SharedArray& a) { return a.texture == texture.array; });
    if (texture.array == 0 || array == arrays_.end()) return;
    std::fill_n(array->used.begin() + texture.first_layer, layer_count(texture.desc), false);
    if (std::find(array->used.begin(), array->used.end(), true) != array->used.end()) return;
    const auto shared = objects.textures.find(array->texture);
    glDeleteTextures(1, &shared->second.name);
    objects.textures.erase(shared);
    arrays_.erase(array);
}

}  // namespace gnomon::gl
