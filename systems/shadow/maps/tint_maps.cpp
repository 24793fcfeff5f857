#include "systems/shadow/maps/tint_maps.h"

#include <algorithm>
#include <string>

#include "engine/core/signature.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

constexpr gl::Format kDepths = gl::Format::rgba32f, kAbsorbances = gl::Format::rgba16;
constexpr std::uint32_t kCubeFaces = 6;

std::uint32_t layer_count(const LightItem& light, const ShadowRequest& request) {
    return map_texture(light, request) == gl::TextureKind::cube ? kCubeFaces : request.map.view_count;
}

bool any_translucent(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters) {
    return std::any_of(casters.begin(), casters.end(),
                       [&](std::uint32_t i) { return is_translucent(gpu, scene.instances[i].mesh); });
}

/// Returns true if any view with a map of the light shows a translucent caster.
bool has_translucent(const SceneSnapshot& scene, const GpuScene& gpu, const DrawnViews& drawn, std::uint32_t light) {
    const IndexRange views = drawn.fitted.lights[light].views;
    for (std::size_t v = views.first; v < views.end(); ++v) {
        if (!drawn.has_map(v) || drawn.view(v).lit) continue;
        if (any_translucent(scene, gpu, drawn.fitted.casters_of(drawn.view(v)))) return true;
    }
    return false;
}

/// Returns the map's edge of the light's first view that has one; 0: none has.
std::uint32_t map_edge_px(const DrawnViews& drawn, std::uint32_t light) {
    const IndexRange views = drawn.fitted.lights[light].views;
    for (std::size_t v = views.first; v < views.end(); ++v)
        if (drawn.has_map(v)) return drawn.maps[v].size_px;
    return 0;
}

/// Returns the hash of what a view's layers show. The plan's content names its matrix and casters.
std::uint64_t content_of(const UpdatePlan& plan, std::uint32_t edge_px) {
    Signature s;
    s.add(plan.content);
    s.add(std::uint64_t{edge_px});
    return s.value();
}

}  // namespace

std::uint32_t tint_edge_px(std::uint32_t map_edge_px, std::uint32_t views) {
    std::uint64_t edge_px = map_edge_px;
    while (edge_px > 1 && edge_px * edge_px * views > kMostTintTexels) edge_px = (edge_px + 1) / 2;
    return static_cast<std::uint32_t>(edge_px);
}

bool is_translucent(const GpuScene& gpu, std::uint32_t mesh) {
    if (!gpu.any_transmits() || gpu.engine_mesh(mesh)) return false;
    const GpuScene::MeshRange& range = gpu.mesh(mesh);
    for (std::uint32_t s = 0; s < range.submesh_count; ++s)
        if (gpu.material(gpu.submesh(range.first_submesh + s).material).transmits) return true;
    return false;
}

void list_ray_tints(const SceneSnapshot& scene, const GpuScene& gpu, const DrawnViews& drawn,
                    const ReceiverCasterSets& sets, std::vector<std::uint8_t>& lights) {
    lights.clear();
    for (std::uint32_t i = 0; i < scene.lights.size() && gpu.any_transmits(); ++i) {
        if (!scene.lights[i].shadow.translucent_casters || drawn.statuses[i].is_skipped() ||
            !drawn.lights[i].request.rays.used || !any_translucent(scene, gpu, drawn.fitted.sets_of(sets, i).casters()))
            continue;
        lights.resize(scene.lights.size(), 0);
        lights[i] = 1;
    }
}

TintMaps::~TintMaps() {
    for (Layers& layers : lights_) release(layers);
}

void TintMaps::release(Layers& layers) const {
    for (const auto* targets : {&layers.depths, &layers.absorbances})
        for (const gl::TargetHandle target : *targets) device_.destroy(target);
    device_.destroy(layers.textures.depths);
    device_.destroy(layers.textures.absorbances);
    layers.textures = {};
    layers.depths.clear();
    layers.absorbances.clear();
    layers.content.clear();
    layers.edge_px = 0;
}

TintMaps::Layers* TintMaps::find(ecs::Entity light) {
    const auto found = std::find_if(lights_.begin(), lights_.end(), [&](const Layers& l) { return l.light == light; });
    return found == lights_.end() ? nullptr : &*found;
}

TintMaps::Layers& TintMaps::entry(ecs::Entity light) {
    if (Layers* found = find(light)) return *found;
    Layers& made = lights_.emplace_back();
    made.light = light;
    return made;
}

std::uint64_t TintMaps::bytes(const Layers& layers) {
    return layers.content.size() * layers.edge_px * layers.edge_px * kTintTexelBytes;
}

std::uint64_t TintMaps::bytes() const {
    std::uint64_t sum = 0;
    for (const Layers& layers : lights_) sum += bytes(layers);
    return sum;
}

std::uint64_t TintMaps::bytes(ecs::Entity light) const {
    const auto found = std::find_if(lights_.begin(), lights_.end(), [&](const Layers& l) { return l.light == light; });
    return found == lights_.end() ? 0 : bytes(*found);
}

bool TintMaps::create(const LightItem& light, std::uint32_t edge_px, std::uint32_t views, Layers& layers) const {
    const std::string label = "translucent casters " + light.name;
    layers.textures.depths =
        device_.create_texture({label, gl::TextureKind::array, kDepths, edge_px, edge_px, views}, {}).handle;
    if (layers.textures.depths)
        layers.textures.absorbances =
            device_
                .create_texture({label, gl::TextureKind::array, kAbsorbances, edge_px, edge_px, views * kTintLayers},
                                {})
                .handle;
    if (!layers.textures.absorbances) return false;
    for (std::uint32_t view = 0; view < views; ++view) {
        const auto depths =
            device_.create_target({label, {{layers.textures.depths, static_cast<std::int32_t>(view)}}, {}});
        if (depths) layers.depths.push_back(depths.handle);
        gl::TargetDesc sums{label, {}, {}};
        for (std::uint32_t i = 0; i < kTintLayers; ++i)
            sums.colours.push_back({layers.textures.absorbances, static_cast<std::int32_t>(view * kTintLayers + i)});
        const auto absorbances = device_.create_target(sums);
        if (absorbances) layers.absorbances.push_back(absorbances.handle);
        if (!depths || !absorbances) return false;
    }
    layers.content.assign(views, 0);
    layers.edge_px = edge_px;
    return true;
}

/// Makes the light's layers of that size, unless it has them. Returns false without room.
bool TintMaps::provide(const LightItem& light, std::uint32_t edge_px, std::uint32_t views, std::uint64_t& room,
                       Layers& layers) {
    if (layers.edge_px == edge_px && layers.content.size() == views) return true;
    if (layers.failed && !layers.retry.due(frame_)) return false;
    room += bytes(layers);
    release(layers);
    const std::uint64_t needed = std::uint64_t{views} * edge_px * edge_px * kTintTexelBytes;
    layers.failed = needed > room || !create(light, edge_px, views, layers);
    if (layers.failed) {
        release(layers);
        layers.retry.failed(frame_);
        return false;
    }
    room -= needed;
    return true;
}

void TintMaps::release_unused() {
    std::erase_if(lights_, [&](Layers& layers) {
        if (frame_ - layers.wanted_frame <= kHoldFrames) return false;
        release(layers);
        return true;
    });
}

void TintMaps::assign(const SceneSnapshot& scene, const GpuScene& gpu, const DrawnViews& drawn, std::uint64_t room,
                      std::span<LightStatus> statuses, std::vector<TintAssignment>& tints) {
    ++frame_;
    tints.clear();
    wanted_bytes_ = 0;
    for (std::uint32_t i = 0; i < scene.lights.size() && gpu.any_transmits(); ++i) {
        const LightItem& light = scene.lights[i];
        const ShadowRequest& request = drawn.lights[i].request;
        // Rays find what is translucent themselves.
        if (!light.shadow.translucent_casters || statuses[i].is_skipped() || request.rays.used ||
            !has_translucent(scene, gpu, drawn, i))
            continue;
        const std::uint32_t views = layer_count(light, request), edge_px = tint_edge_px(map_edge_px(drawn, i), views);
        wanted_bytes_ += std::uint64_t{views} * edge_px * edge_px * kTintTexelBytes;
        Layers& layers = entry(light.entity);
        layers.wanted_frame = frame_;
        if (!provide(light, edge_px, views, room, layers)) {
            statuses[i].lose_tint(Reason::tint_failed);
            continue;
        }
        tints.resize(drawn.count());
        const IndexRange range = drawn.fitted.lights[i].views;
        for (std::size_t v = range.first; v < range.end(); ++v) {
            if (!drawn.has_map(v) || drawn.view(v).lit) continue;
            const std::uint32_t layer = drawn.view(v).layer;
            const std::uint64_t content = content_of(drawn.updates[v], edge_px);
            const bool shows_it = light.tuning.reuse.economy && layers.content[layer] == content;
            tints[v] = {layers.textures, layers.depths[layer], layers.absorbances[layer], edge_px, content, !shows_it};
        }
    }
    release_unused();
}

bool TintMaps::stay() const {
    return std::all_of(lights_.begin(), lights_.end(),
                       [&](const Layers& layers) { return layers.wanted_frame == frame_; });
}

void TintMaps::commit(const SceneSnapshot& scene, const DrawnViews& drawn, std::span<const TintAssignment> tints,
                      bool executed) {
    for (std::size_t v = 0; v < tints.size(); ++v) {
        if (!tints[v].drawn) continue;
        const std::uint32_t light = drawn.view(v).light;
        Layers* layers = find(scene.lights[light].entity);
        const bool shown = executed && !drawn.statuses[light].has_lost_tint();
        if (layers) layers->content[drawn.view(v).layer] = shown ? tints[v].content : 0;
    }
}

}  // namespace gnomon::shadow
