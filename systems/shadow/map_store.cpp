#include "systems/shadow/map_store.h"

#include <algorithm>
#include <bit>

#include "systems/shadow/cube_route.h"
#include "systems/shadow/depth_format.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"

namespace gnomon::shadow {
namespace {

/// FNV-1a, 64 bit, over 8-byte words.
struct Signature {
    std::uint64_t value = 14695981039346656037ull;
    void add(std::uint64_t word) {
        for (int i = 0; i < 8; ++i) value = (value ^ (word >> (8 * i) & 0xffu)) * 1099511628211ull;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
};

/// What each texel of a map shows: an instance and a triangle (shaders/shadow/caster_triangles.glsl).
gl::TextureDesc triangles_of(gl::TextureDesc desc) {
    desc.label += ", triangles";
    desc.format = gl::Format::rg32ui;
    return desc;
}

gl::TargetDesc target_of(const LightHistory& map, std::int32_t layer) {
    gl::TargetDesc target{map.desc.label, {}, {map.texture, layer}};
    if (map.triangles) target.colours.push_back({map.triangles, layer});
    return target;
}

}  // namespace

std::uint64_t content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                std::span<const std::uint32_t> casters, CasterFaces faces) {
    Signature s;
    s.add(std::uint64_t{size_px});
    s.add(static_cast<std::uint64_t>(faces));
    for (int i = 0; i < 3; ++i) s.add(view.anchor_ws_m[i]);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) s.add(view.clip_from_anchor[column][row]);
    for (const std::uint32_t i : casters) {
        s.add(std::uint64_t{scene.instances[i].gpu_slot});
        s.add(scene.instances[i].version);
    }
    return s.value == 0 ? 1 : s.value;
}

MapStore::~MapStore() {
    for (LightHistory& history : lights_) release(history);
}

const LightHistory* MapStore::find(ecs::Entity light) const {
    const auto it =
        std::find_if(lights_.begin(), lights_.end(), [&](const LightHistory& h) { return h.entity == light; });
    return it == lights_.end() ? nullptr : &*it;
}

std::uint64_t MapStore::bytes(const LightHistory& history) {
    if (!history.texture) return 0;
    return gl::byte_size(history.desc) + (history.triangles ? gl::byte_size(triangles_of(history.desc)) : 0);
}

std::uint64_t MapStore::bytes() const {
    std::uint64_t sum = 0;
    for (const LightHistory& history : lights_) sum += bytes(history);
    return sum;
}

LightHistory& MapStore::entry(ecs::Entity light) {
    for (LightHistory& history : lights_)
        if (history.entity == light) return history;
    lights_.emplace_back();
    lights_.back().entity = light;
    return lights_.back();
}

void MapStore::release(LightHistory& history) {
    for (const gl::TargetHandle target : history.targets) device_.destroy(target);
    device_.destroy(history.whole);
    device_.destroy(history.texture);
    device_.destroy(history.triangles);
    history.whole = {};
    history.targets.clear();
    history.content.clear();
    history.texture = history.triangles = {};
}

bool MapStore::make_targets(LightHistory& map) const {
    for (std::uint32_t layer = 0; layer < gl::layer_count(map.desc); ++layer) {
        const auto target = device_.create_target(target_of(map, static_cast<std::int32_t>(layer)));
        if (!target) return false;
        map.targets.push_back(target.handle);
    }
    return true;
}

Reason MapStore::try_create(const gl::TextureDesc& desc, bool triangles, LightHistory& history) {
    LightHistory made;
    made.desc = desc;
    made.texture = device_.create_texture(desc, {}).handle;
    if (made.texture && triangles) made.triangles = device_.create_texture(triangles_of(desc), {}).handle;
    Reason reason = Reason::none;
    if (!made.texture || (triangles && !made.triangles)) reason = Reason::map_allocation_failed;
    if (reason == Reason::none && !make_targets(made)) reason = Reason::target_incomplete;
    if (reason != Reason::none) {
        release(made);
        return reason;
    }
    // The new map stands; only now does the old one go.
    release(history);
    history.desc = desc;
    history.texture = made.texture;
    history.triangles = made.triangles;
    history.targets = std::move(made.targets);
    history.content.assign(history.targets.size(), 0);
    return Reason::none;
}

bool MapStore::ensure_map(const LightItem& light, const ShadowDemand& demand, LightHistory& history) {
    const LightKindRow& kind = light_kind_row(light.kind);
    const std::uint32_t layers = kind.texture == gl::TextureKind::cube ? 1u : demand.view_count;
    const gl::Format format = depth_format_row(demand.depth_format).texture;
    const bool triangles = filter_row(demand.filter).storage == FilterStorage::depth_and_triangle;
    const gl::TextureDesc& held = history.desc;
    if (history.texture && !(held.kind == kind.texture && held.layers == layers && held.format == format &&
                             static_cast<bool>(history.triangles) == triangles)) {
        // The light wants a map of another kind: this one has no use, nor has the memory of a failure.
        release(history);
        history.wanted_px = 0;
        history.failure = Reason::none;
    }
    const bool fits = history.texture && history.wanted_px == demand.resolution_px;
    if (fits && (history.failure == Reason::none || frame_ < history.retry_frame)) return true;
    if (history.failure != Reason::none && frame_ < history.retry_frame && history.wanted_px == demand.resolution_px)
        return static_cast<bool>(history.texture);
    gl::TextureDesc desc;
    desc.label = "shadow map " + light.name;
    desc.kind = kind.texture;
    desc.format = format;
    desc.layers = layers;
    history.wanted_px = demand.resolution_px;
    history.failure = Reason::none;
    for (std::uint32_t halving = 0; halving <= kHalvings; ++halving) {
        desc.width = desc.height = std::max(demand.resolution_px >> halving, 1u);
        if (halving > 0 && fits && desc.width <= history.desc.width) break;  // what we hold is as good
        const Reason reason = try_create(desc, triangles, history);
        if (reason == Reason::none) {
            if (halving > 0) history.failure = Reason::map_shrunk;
            break;
        }
        history.failure = reason;
        if (reason == Reason::target_incomplete) break;  // smaller would fail alike
    }
    if (history.failure != Reason::none) history.retry_frame = frame_ + kRetryFrames;
    if (history.failure != Reason::none && history.texture) history.failure = Reason::map_shrunk;
    return static_cast<bool>(history.texture);
}

void MapStore::assign_slots(const SceneSnapshot& scene, ShadowFrame& frame) {
    ++frame_;
    frame.slots.assign(frame.views.size(), {});
    for (std::size_t d = 0; d < frame.demands.size(); ++d) {
        PotentialSets& sets = frame.sets[d];
        const LightTime time(frame, frame.demands[d].light);
        if (sets.skip != Reason::none) {
            // Seen by nobody just now: the map is held for a while, in case the camera turns back.
            if (frame.demands[d].skip == Reason::none && find(scene.lights[frame.demands[d].light].entity) == nullptr)
                continue;
            if (frame.demands[d].skip != Reason::none) continue;
            LightHistory& history = entry(scene.lights[frame.demands[d].light].entity);
            if (frame_ - history.last_wanted_frame <= kHoldFrames) continue;
            release(history);
            continue;
        }
        const LightItem& light = scene.lights[frame.demands[d].light];
        LightHistory& history = entry(light.entity);
        history.last_wanted_frame = frame_;
        if (!ensure_map(light, frame.demands[d], history)) sets.skip = history.failure;
    }
    std::erase_if(lights_, [&](LightHistory& history) {
        for (const ShadowDemand& demand : frame.demands)
            if (scene.lights[demand.light].entity == history.entity && demand.skip == Reason::none) return false;
        release(history);
        return true;
    });
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        if (frame.sets[view.demand].skip != Reason::none) continue;
        const LightTime time(frame, frame.demands[view.demand].light);
        const LightItem& light = scene.lights[frame.demands[view.demand].light];
        const LightHistory& history = *find(light.entity);
        ShadowSlot& slot = frame.slots[v];
        slot.texture = history.texture;
        slot.triangles = history.triangles;
        slot.target = history.targets[view.layer];
        slot.size_px = history.desc.width;
        const auto casters = std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
        slot.reuse = light.shadow.economy &&
                     history.content[view.layer] ==
                         content_signature(view, slot.size_px, scene, casters, light.shadow.caster_faces);
    }
    choose_routes(scene, frame);
}

void MapStore::choose_routes(const SceneSnapshot& scene, ShadowFrame& frame) {
    const auto drawn = [&](std::size_t v) { return frame.slots[v].texture && !frame.slots[v].reuse; };
    for (std::size_t first = 0, end = 0; first < frame.views.size(); first = end) {
        std::uint32_t faces = 0;
        for (end = first; end < frame.views.size() && frame.views[end].demand == frame.views[first].demand; ++end)
            faces += drawn(end) ? 1 : 0;
        if (frame.views[first].projection != ViewProjection::cube_face || faces == 0) continue;
        const LightItem& light = scene.lights[frame.demands[frame.views[first].demand].light];
        const CubeRoute route = cube_route(light.shadow.cube_route, device_.info(), faces);
        if (route == CubeRoute::six_passes) continue;
        LightHistory& history = entry(light.entity);
        if (!history.whole) history.whole = device_.create_target(target_of(history, gl::kAllLayers)).handle;
        for (std::size_t v = first; v < end; ++v)
            if (drawn(v) && history.whole) {
                frame.slots[v].whole = history.whole;
                frame.slots[v].route = route;
            }
    }
}

void MapStore::commit(const SceneSnapshot& scene, const ShadowFrame& frame, bool drawn) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowSlot& slot = frame.slots[v];
        if (!slot.texture || slot.reuse) continue;
        const ShadowView& view = frame.views[v];
        const auto casters = std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
        const LightItem& light = scene.lights[frame.demands[view.demand].light];
        const std::uint64_t content = content_signature(view, slot.size_px, scene, casters, light.shadow.caster_faces);
        entry(light.entity).content[view.layer] = drawn ? content : 0;
    }
}

}  // namespace gnomon::shadow
