#include "systems/shadow/request/map_textures.h"

#include <algorithm>
#include <bit>

#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/occluder_pyramid.h"

namespace gnomon::shadow {

gl::TextureDesc without_label(const gl::TextureDesc& desc) {
    return {{}, desc.kind, desc.format, desc.width, desc.height, desc.layers, desc.mips};
}

gl::TextureDesc map_desc(const LightItem& light, const ShadowRequest& request) {
    const gl::TextureKind kind = map_texture(light, request);
    return {.kind = kind,
            .format = depth_format_row(request.map.depth_format).texture,
            .width = map_edge_px(request.map),
            .height = map_edge_px(request.map),
            .layers = kind == gl::TextureKind::cube ? 1u : request.map.view_count};
}

gl::TextureDesc triangles_of(const gl::TextureDesc& map, gl::Format format) {
    gl::TextureDesc desc = without_label(map);
    desc.format = format;
    return desc;
}

std::uint32_t scratch_rows(const MapSettings& settings, bool cube) { return cube ? settings.filtering.size / 2 : 0; }

PrefilterDescs moments_of(const gl::TextureDesc& map, const MapSettings& settings) {
    PrefilterDescs moments;
    if (!filter_row(settings.filter).moments) return moments;
    moments.texture = without_label(map);
    moments.texture.format = settings.moments.format;
    moments.texture.mips = std::min(settings.moments.levels, static_cast<std::uint32_t>(std::bit_width(map.width)));
    if (settings.filtering.size <= 1) return moments;
    moments.scratch = {.format = settings.moments.format, .width = map.width};
    moments.scratch.height = map.height + 2 * scratch_rows(settings, map.kind == gl::TextureKind::cube);
    return moments;
}

BoundsDescs bounds_descs_of(const gl::TextureDesc& map) {
    const auto beside = [&](gl::Format format, std::uint32_t layers) {
        gl::TextureDesc desc = without_label(map);
        desc.kind = gl::TextureKind::array;
        desc.format = format;
        desc.layers = layers;
        return desc;
    };
    const std::uint32_t views = gl::layer_count(map);
    return {beside(kTriangleFormat, 1), beside(map.format, views), beside(gl::Format::rg32f, views)};
}

std::uint64_t map_bytes(const gl::TextureDesc& map, const FilterStorage& storage, gl::Format references,
                        const gl::TextureDesc& moments, const gl::TextureDesc& scratch) {
    std::uint64_t bytes = gl::byte_size(map);
    if (storage.triangle_ids) bytes += gl::byte_size(triangles_of(map, references));
    if (storage.conservative_bounds) {
        const BoundsDescs sheets = bounds_descs_of(map);
        bytes += gl::byte_size(sheets.triangles) + gl::byte_size(sheets.second) + gl::byte_size(sheets.bounds);
        if (storage.occluder_pyramid) bytes += pyramid_bytes(map.width, gl::layer_count(map));
    }
    if (moments.width > 0) bytes += gl::byte_size(moments);
    if (scratch.width > 0) bytes += gl::byte_size(scratch);
    return bytes;
}

std::uint64_t map_bytes(const LightItem& light, const ShadowRequest& request) {
    if (!has_map(request)) return 0;
    const gl::TextureDesc map = map_desc(light, request);
    const PrefilterDescs moments = moments_of(map, request.map);
    return map_bytes(map, filter_row(request.map.filter).storage, request.map.references.format(), moments.texture,
                     moments.scratch);
}

}  // namespace gnomon::shadow
