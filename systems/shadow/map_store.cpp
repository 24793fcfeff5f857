#include "systems/shadow/map_store.h"

#include <algorithm>
#include <bit>

#include "systems/shadow/cube_route.h"
#include "systems/shadow/depth_format.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"
#include "systems/shadow/moment_recorder.h"
#include "systems/shadow/signature.h"

namespace gnomon::shadow {
namespace {

/// Between casters that stand still and those that move: where a draw may not go on.
constexpr std::uint64_t kBoundary = ~std::uint64_t{0};

/// Labels are for what is made: a longer one takes memory, which a steady frame must not.
gl::TextureDesc without_label(const gl::TextureDesc& desc) {
    return {{}, desc.kind, desc.format, desc.width, desc.height, desc.layers, desc.mips};
}

/// What each texel of a map shows: an instance and a triangle (shaders/shadow/caster_triangles.glsl). Without a label.
gl::TextureDesc triangles_of(const gl::TextureDesc& map) {
    gl::TextureDesc desc = without_label(map);
    desc.format = kTriangleFormat;
    return desc;
}

/// Of a light whose map is `desc`, without labels; what there is none of has a width of 0.
MomentMap moments_of(const gl::TextureDesc& desc, const ShadowDemand& demand) {
    MomentMap moments;
    if (filter_row(demand.filter).storage != FilterStorage::moments) return moments;
    moments.desc = without_label(desc);
    moments.desc.format = demand.moments.format;
    moments.desc.mips = std::min(demand.moments.levels, static_cast<std::uint32_t>(std::bit_width(desc.width)));
    if (demand.filtering.size <= 1) return moments;
    moments.scratch_desc = {.format = demand.moments.format, .width = desc.width};
    moments.scratch_desc.height = desc.height + 2 * scratch_rows(demand, desc.kind == gl::TextureKind::cube);
    return moments;
}

/// OpenGL's table has them side by side.
bool are_opposite_faces(std::uint32_t a, std::uint32_t b) { return a != b && a / 2 == b / 2; }

/// What a light's map has to be, but for its label and a size that cannot be had.
gl::TextureDesc map_desc(const LightItem& light, const ShadowDemand& demand) {
    const gl::TextureKind kind = light_kind_row(light.kind).texture;
    return {.kind = kind,
            .format = depth_format_row(demand.depth_format).texture,
            .width = demand.resolution_px,
            .height = demand.resolution_px,
            .layers = kind == gl::TextureKind::cube ? 1u : demand.view_count};
}

std::uint64_t byte_size(const gl::TextureDesc& map, bool triangles, const MomentMap& moments) {
    std::uint64_t bytes = gl::byte_size(map);
    if (triangles) bytes += gl::byte_size(triangles_of(map));
    if (moments.desc.width > 0) bytes += gl::byte_size(moments.desc);
    if (moments.scratch_desc.width > 0) bytes += gl::byte_size(moments.scratch_desc);
    return bytes;
}

bool is_same_store(const MomentMap& a, const MomentMap& b) {
    return without_label(a.desc) == without_label(b.desc) &&
           without_label(a.scratch_desc) == without_label(b.scratch_desc);
}

gl::TargetDesc target_of(const LightHistory& map, std::int32_t layer) {
    gl::TargetDesc target{map.desc.label, {}, {map.texture, layer}};
    if (map.triangles) target.colours.push_back({map.triangles, layer});
    return target;
}

}  // namespace

ContentSignature content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                   std::span<const std::uint32_t> casters, CasterFaces faces) {
    Signature s;
    s.add(std::uint64_t{size_px});
    s.add(static_cast<std::uint64_t>(faces));
    for (int i = 0; i < 3; ++i) s.add(view.anchor_ws_m[i]);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) s.add(view.clip_from_anchor[column][row]);
    const auto add = [&](std::span<const std::uint32_t> group) {
        for (const std::uint32_t i : group) {
            s.add(std::uint64_t{scene.instances[i].gpu_slot});
            s.add(scene.instances[i].version);
        }
    };
    const std::size_t still = std::min<std::size_t>(view.still_casters, casters.size());
    add(casters.first(still));
    const std::uint64_t of_still = s.value();
    if (still > 0 && still < casters.size()) s.add(kBoundary);
    add(casters.subspan(still));
    return {of_still, s.value()};
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
    const bool triangles = static_cast<bool>(history.triangles);
    const std::uint64_t still = history.still.texture ? byte_size(history.desc, triangles, {}) : 0;
    return byte_size(history.desc, triangles, history.moments) + still;
}

std::uint64_t MapStore::wanted_bytes(const LightItem& light, const ShadowDemand& demand) {
    const gl::TextureDesc map = map_desc(light, demand);
    return byte_size(map, filter_row(demand.filter).storage == FilterStorage::depth_and_triangle,
                     moments_of(map, demand));
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
    for (const gl::TargetHandle target : history.moments.targets) device_.destroy(target);
    device_.destroy(history.moments.scratch_target);
    device_.destroy(history.moments.texture);
    release_still(history.still);
    history.still = {};
    device_.destroy(history.moments.scratch);
    history.moments = {};
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

Reason MapStore::make_moments(const ShadowDemand& demand, LightHistory& map) const {
    MomentMap& moments = map.moments = moments_of(map.desc, demand);
    if (moments.desc.width == 0) return Reason::none;
    moments.desc.label = map.desc.label + ", moments";
    moments.scratch_desc.label = map.desc.label + ", scratch";
    moments.texture = device_.create_texture(moments.desc, {}).handle;
    if (moments.texture && moments.scratch_desc.width > 0)
        moments.scratch = device_.create_texture(moments.scratch_desc, {}).handle;
    if (!moments.texture || (moments.scratch_desc.width > 0 && !moments.scratch)) return Reason::map_allocation_failed;
    for (std::uint32_t layer = 0; layer < gl::layer_count(moments.desc); ++layer) {
        const gl::Attachment attachment{moments.texture, static_cast<std::int32_t>(layer)};
        const auto target = device_.create_target({moments.desc.label, {attachment}, {}});
        if (!target) return Reason::target_incomplete;
        moments.targets.push_back(target.handle);
    }
    moments.content.assign(moments.targets.size(), 0);
    if (!moments.scratch) return Reason::none;
    moments.scratch_target = device_.create_target({moments.scratch_desc.label, {{moments.scratch}}, {}}).handle;
    return moments.scratch_target ? Reason::none : Reason::target_incomplete;
}

Reason MapStore::try_create(const gl::TextureDesc& desc, const ShadowDemand& demand, LightHistory& history) {
    const bool triangles = filter_row(demand.filter).storage == FilterStorage::depth_and_triangle;
    LightHistory made;
    made.desc = desc;
    made.texture = device_.create_texture(desc, {}).handle;
    gl::TextureDesc shown = triangles_of(desc);
    shown.label = desc.label + ", triangles";
    if (made.texture && triangles) made.triangles = device_.create_texture(shown, {}).handle;
    Reason reason = Reason::none;
    if (!made.texture || (triangles && !made.triangles)) reason = Reason::map_allocation_failed;
    if (reason == Reason::none && !make_targets(made)) reason = Reason::target_incomplete;
    if (reason == Reason::none) reason = make_moments(demand, made);
    if (reason != Reason::none) {
        release(made);
        return reason;
    }
    // The new map stands; only now does the old one go.
    release(history);
    history.desc = desc;
    history.texture = made.texture;
    history.triangles = made.triangles;
    history.moments = std::move(made.moments);
    history.targets = std::move(made.targets);
    history.content.assign(history.targets.size(), 0);
    return Reason::none;
}

bool MapStore::ensure_map(const LightItem& light, const ShadowDemand& demand, LightHistory& history) {
    gl::TextureDesc desc = map_desc(light, demand);
    const bool triangles = filter_row(demand.filter).storage == FilterStorage::depth_and_triangle;
    const gl::TextureDesc& held = history.desc;
    if (history.texture && !(held.kind == desc.kind && held.layers == desc.layers && held.format == desc.format &&
                             static_cast<bool>(history.triangles) == triangles &&
                             is_same_store(history.moments, moments_of(held, demand)))) {
        // The light wants a map of another kind: this one has no use, nor has the memory of a failure.
        release(history);
        history.wanted_px = 0;
        history.failure = Reason::none;
    }
    const bool fits = history.texture && history.wanted_px == demand.resolution_px;
    if (fits && (history.failure == Reason::none || frame_ < history.retry_frame)) return true;
    if (history.failure != Reason::none && frame_ < history.retry_frame && history.wanted_px == demand.resolution_px)
        return static_cast<bool>(history.texture);
    desc.label = "shadow map " + light.name;
    history.wanted_px = demand.resolution_px;
    history.failure = Reason::none;
    for (std::uint32_t halving = 0; halving <= kHalvings; ++halving) {
        desc.width = desc.height = std::max(demand.resolution_px >> halving, 1u);
        if (halving > 0 && fits && desc.width <= history.desc.width) break;  // what we hold is as good
        const Reason reason = try_create(desc, demand, history);
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

bool MapStore::stay() {
    for (const LightHistory& history : lights_) {
        const bool wanted = history.last_wanted_frame + 1 == frame_;
        if (wanted && history.failure != Reason::none && frame_ >= history.retry_frame) return false;
        if (!wanted && history.texture && frame_ - history.last_wanted_frame > kHoldFrames) return false;
        if (is_still_idle(history)) return false;
    }
    for (LightHistory& history : lights_)
        if (history.last_wanted_frame + 1 == frame_) history.last_wanted_frame = frame_;
    return true;
}

void MapStore::assign_slots(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
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
        const ContentSignature signature =
            content_signature(view, slot.size_px, scene, casters, light.shadow.caster_faces);
        slot.content = signature.all;
        slot.still_content = signature.still;
        slot.reuse = light.shadow.economy && history.content[view.layer] == slot.content;
    }
    assign_moments(scene, frame);
    keep_still_apart(scene, gpu, frame);
    choose_routes(scene, frame);
}

/// A view's moments follow from its own depths and, of a cube, those of the faces beside it.
void MapStore::assign_moments(const SceneSnapshot& scene, ShadowFrame& frame) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        const ShadowDemand& demand = frame.demands[view.demand];
        ShadowSlot& slot = frame.slots[v];
        if (!slot.texture || filter_row(demand.filter).storage != FilterStorage::moments) continue;
        const LightItem& light = scene.lights[demand.light];
        const MomentMap& moments = find(light.entity)->moments;
        slot.moments = moments.texture;
        slot.moment_target = moments.targets[view.layer];
        slot.scratch = moments.scratch;
        slot.scratch_target = moments.scratch_target;
        Signature s;
        s.add(static_cast<std::uint64_t>(demand.filter));
        s.add(std::uint64_t{demand.filtering.size});
        s.add(demand.moments.settings.x);
        s.add(demand.moments.settings.y);
        for (std::size_t other = 0; other < frame.views.size(); ++other) {
            if (frame.views[other].demand != view.demand) continue;
            const bool beside = view.projection == ViewProjection::cube_face &&
                                !are_opposite_faces(frame.views[other].layer, view.layer);
            if (other != v && !beside) continue;
            s.add(std::uint64_t{frame.views[other].layer});
            s.add(frame.slots[other].content);
        }
        slot.moment_content = s.value();
        slot.convert = !light.shadow.economy || moments.content[view.layer] != slot.moment_content;
    }
}

void MapStore::choose_routes(const SceneSnapshot& scene, ShadowFrame& frame) {
    const auto drawn = [&](std::size_t v) { return frame.slots[v].texture && !frame.slots[v].reuse; };
    for (std::size_t first = 0, end = 0; first < frame.views.size(); first = end) {
        std::uint32_t faces = 0;
        bool apart = false;
        for (end = first; end < frame.views.size() && frame.views[end].demand == frame.views[first].demand; ++end) {
            faces += drawn(end) ? 1 : 0;
            apart = apart || frame.slots[end].still_use != StillUse::none;
        }
        if (frame.views[first].projection != ViewProjection::cube_face || faces == 0 || apart) continue;
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
        if (!slot.texture) continue;
        const ShadowView& view = frame.views[v];
        LightHistory& history = entry(scene.lights[frame.demands[view.demand].light].entity);
        if (!slot.reuse) history.content[view.layer] = drawn ? slot.content : 0;
        if (slot.still_use == StillUse::fill) history.still.layers[view.layer].content = drawn ? slot.still_content : 0;
        if (slot.convert) history.moments.content[view.layer] = drawn ? slot.moment_content : 0;
    }
}

}  // namespace gnomon::shadow
