#include "tests/economy/map_contents.h"

#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "shaders/bindings.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/frame/pass_inputs.h"

namespace gnomon {
namespace {

constexpr std::uint64_t kCleared = 1;
constexpr std::uint32_t kLayerBits = 3;  // the lowest of a draw item's place

std::uint64_t hash(std::span<const std::byte> bytes, std::uint64_t from) {
    std::uint64_t value = from ^ 14695981039346656037ull;  // FNV-1a
    for (const std::byte b : bytes) value = (value ^ static_cast<std::uint64_t>(b)) * 1099511628211ull;
    return value;
}
template <class T>
std::uint64_t hash_of(const T& value, std::uint64_t from) {
    return hash(std::as_bytes(std::span(&value, 1)), from);
}

/// What the device is set to while a depth pass is drawn.
struct Bound {
    gl::BindUniforms view;
    gl::BindTexels instances;
    gl::BindMeshes meshes;
    gl::PipelineState pipeline;
    gl::Rect viewport;
};

std::uint64_t drawn(const gl::DrawMeshes& draw, const Bound& bound, std::uint32_t item, std::uint32_t layer_in_view,
                    const gl::RecordingDevice& device) {
    const auto view = device.buffer_bytes(bound.view.buffer)
                          .subspan(bound.view.offset + layer_in_view * sizeof(shadow::DepthViewRecord),
                                   sizeof(shadow::DepthViewRecord));
    // The last number of a record has the shadows that the instance receives: depths do not depend on it.
    const auto instance = device.buffer_bytes(bound.instances.buffer)
                              .subspan(item * sizeof(InstanceRecord), sizeof(InstanceRecord) - sizeof(float));
    const std::string_view label = device.program(bound.pipeline.program)->label;
    const bool masked = label.find("masked") != std::string_view::npos;
    std::uint64_t value = hash(view, hash(instance, masked ? 1 : 0));
    value = hash_of(draw.first_index, hash_of(draw.index_count, hash_of(draw.base_vertex, value)));
    value = hash_of(bound.viewport.width, hash_of(bound.pipeline.cull, value));
    return hash_of(bound.pipeline.front_is_clockwise, value);
}

}  // namespace

void MapContents::draw(const gl::CommandList& list, const gl::RecordingDevice& device) {
    Bound bound{};
    std::optional<gl::Attachment> map;
    for (const gl::Command& command : list.commands) {
        if (const auto* pass = std::get_if<gl::BeginPass>(&command)) {
            const gl::TargetDesc* target = device.target(pass->target);
            const bool is_map =
                target->depth.texture && device.texture(target->depth.texture)->label.starts_with("shadow map");
            map = is_map ? std::optional(target->depth) : std::nullopt;
            bound.viewport = pass->viewport;
            if (!map || !pass->clear_depth) continue;
            for (std::int32_t layer = 0; layer < 6; ++layer)
                if (map->layer == layer || map->layer == gl::kAllLayers) layers_[{map->texture.id, layer}] = kCleared;
        }
        if (const auto* copy = std::get_if<gl::CopyTexture>(&command)) {
            const auto layer = static_cast<std::int32_t>(copy->layer);
            layers_[{copy->destination.id, layer}] = layers_[{copy->source.id, layer}];
        }
        if (const auto* b = std::get_if<gl::BindUniforms>(&command); b && b->binding == 0) bound.view = *b;
        if (const auto* b = std::get_if<gl::BindTexels>(&command); b && b->unit == bindings::kInstanceUnit)
            bound.instances = *b;
        if (const auto* b = std::get_if<gl::BindMeshes>(&command)) bound.meshes = *b;
        if (const auto* p = std::get_if<gl::SetPipeline>(&command)) bound.pipeline = p->state;
        if (!map) continue;
        const auto items = device.buffer_bytes(bound.meshes.draw_items);
        std::vector<gl::DrawMeshes> draws;
        gl::append_mesh_draws(list, command, draws);
        for (const gl::DrawMeshes& draw : draws) {
            for (std::uint32_t i = draw.first_item; i < draw.first_item + draw.item_count; ++i) {
                std::uint32_t item[2];  // instance, place
                std::memcpy(item, items.data() + i * sizeof item, sizeof item);
                const bool layered = map->layer == gl::kAllLayers;
                const std::uint32_t layer = layered ? item[1] & ((1u << kLayerBits) - 1u) : 0u;
                // A sum does not depend on the order of draws, as depths do not: the nearest stays.
                layers_[{map->texture.id, layered ? static_cast<std::int32_t>(layer) : map->layer}] +=
                    drawn(draw, bound, item[0], layer, device);
            }
        }
    }
}

std::uint64_t MapContents::of(gl::TargetHandle target, const gl::RecordingDevice& device) const {
    const gl::TargetDesc* desc = device.target(target);
    if (!desc) return 0;
    const auto found = layers_.find({desc->depth.texture.id, desc->depth.layer});
    return found == layers_.end() ? 0 : found->second;
}

}  // namespace gnomon
