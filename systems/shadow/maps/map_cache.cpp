#include "systems/shadow/maps/map_cache.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "systems/extract/light_facts.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/occluder_pyramid.h"

namespace gnomon::shadow {
namespace {

bool is_same_store(const PrefilterTextures& a, const PrefilterDescs& b) {
    return without_label(a.desc) == b.texture && without_label(a.scratch_desc) == b.scratch;
}

/// Returns whether the light's maps move in steps of whole texels, so that another edge would make them shimmer.
bool snaps_to_texels(const LightItem& light) {
    return light_facts(light.kind).parallel && light.tuning.cascades.fit == ShadowFit::stable;
}

/// Returns the references of the request's map. A conservative map has two numbers, which its second layer is drawn by.
TriangleReferences references_of(const ShadowRequest& request) {
    return filter_row(request.map.filter).storage.triangle_ids ? request.map.references : TriangleReferences{};
}

bool has_triangles(const FilterStorage& storage) { return storage.triangle_ids || storage.conservative_bounds; }

}  // namespace

std::uint64_t layer_bytes(const CachedMap& map) {
    std::uint64_t texel = gl::texel_bytes(map.desc.format);
    if (map.triangles) texel += gl::texel_bytes(map.references.format());
    return texel * map.desc.width * map.desc.height;
}

std::uint64_t static_copy_bytes(const CachedMap& map) { return layer_bytes(map) * gl::layer_count(map.desc); }

gl::TargetDesc target_of(const CachedMap& map, std::int32_t layer) {
    gl::TargetDesc target{map.desc.label, {}, {map.texture, layer}};
    const bool shared = map.storage.conservative_bounds;
    if (map.triangles) target.colours.push_back({map.triangles, shared ? 0 : layer});
    return target;
}

MapCache::~MapCache() {
    for (CachedMap& cached : lights_) release(cached);
}

const CachedMap* MapCache::find(ecs::Entity light) const {
    const auto place = places_.find(light.index);
    if (place == places_.end() || place->second >= lights_.size()) return nullptr;
    const CachedMap& cached = lights_[place->second];
    return cached.entity == light ? &cached : nullptr;
}

std::uint64_t MapCache::bytes(const CachedMap& cached) {
    if (!cached.texture) return 0;
    const std::uint64_t still = cached.still.texture ? static_copy_bytes(cached) : 0;
    return map_bytes(cached.desc, cached.storage, cached.references.format(), cached.moments.desc,
                     cached.moments.scratch_desc) +
           still;
}

BytesByPart MapCache::parts(const CachedMap& cached) {
    BytesByPart parts;
    if (!cached.texture) return parts;
    const auto size = [](const gl::TextureDesc& desc) { return desc.width > 0 ? gl::byte_size(desc) : 0; };
    parts.depths = size(cached.desc);
    if (cached.storage.triangle_ids) parts.triangles = size(triangles_of(cached.desc, cached.references.format()));
    parts.prefiltered = size(cached.moments.desc) + size(cached.moments.scratch_desc);
    if (cached.still.texture) parts.static_copies = static_copy_bytes(cached);
    parts.bounds = bytes(cached) - parts.depths - parts.triangles - parts.prefiltered - parts.static_copies;
    return parts;
}

std::uint64_t MapCache::bytes() const {
    std::uint64_t sum = 0;
    for (const CachedMap& cached : lights_) sum += bytes(cached);
    return sum;
}

void MapCache::waiting_bytes(const SceneSnapshot& scene, std::vector<std::optional<std::uint64_t>>& bytes_of) const {
    bytes_of.assign(scene.lights.size(), std::nullopt);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const CachedMap* map = find(scene.lights[i].entity);
        if (map && map->allocation.failure != Reason::none && frame_ < map->allocation.retry_frame)
            bytes_of[i] = bytes(*map);
    }
}

CachedMap& MapCache::entry(ecs::Entity light) {
    if (const CachedMap* cached = find(light)) return lights_[static_cast<std::size_t>(cached - lights_.data())];
    lights_.emplace_back();
    lights_.back().entity = light;
    note_places(lights_.size() - 1);
    return lights_.back();
}

/// Updates the index of entries from `first` on.
void MapCache::note_places(std::size_t first) {
    if (first == 0) places_.clear();
    for (std::size_t i = first; i < lights_.size(); ++i)
        places_.insert_or_assign(lights_[i].entity.index, static_cast<std::uint32_t>(i));
}

void MapCache::release(CachedMap& cached) {
    for (const gl::TargetHandle target : cached.layers.targets) device_.destroy(target);
    device_.destroy(cached.whole);
    device_.destroy(cached.texture);
    device_.destroy(cached.triangles);
    release_sheets(cached.sheets);
    for (const gl::TargetHandle target : cached.moments.targets) device_.destroy(target);
    device_.destroy(cached.moments.scratch_target);
    device_.destroy(cached.moments.texture);
    release_static_copy(cached.still);
    const bool is_worth_room = cached.still.is_worth_room;  // so it is beside the next map
    cached.still = {};
    cached.still.is_worth_room = is_worth_room;
    device_.destroy(cached.moments.scratch);
    cached.moments = {};
    cached.whole = {};
    cached.layers.targets.clear();
    cached.layers.content.clear();
    cached.layers.placements.clear();
    cached.layers.shown.clear();
    cached.waits = false;
    cached.texture = cached.triangles = {};
}

bool MapCache::make_targets(CachedMap& map) const {
    for (std::uint32_t layer = 0; layer < gl::layer_count(map.desc); ++layer) {
        const auto target = device_.create_target(target_of(map, static_cast<std::int32_t>(layer)));
        if (!target) return false;
        map.layers.targets.push_back(target.handle);
    }
    return true;
}

Reason MapCache::make_moments(const ShadowRequest& request, CachedMap& map) const {
    PrefilterDescs descs = moments_of(map.desc, request.map);
    PrefilterTextures& moments = map.moments = {};
    moments.desc = std::move(descs.texture);
    moments.scratch_desc = std::move(descs.scratch);
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

Reason MapCache::make_sheets(CachedMap& map) const {
    BoundsDescs descs = bounds_descs_of(map.desc);
    descs.second.label = map.desc.label + ", second";
    descs.bounds.label = map.desc.label + ", bounds";
    BoundsTextures& sheets = map.sheets;
    sheets.second = device_.create_texture(descs.second, {}).handle;
    if (sheets.second) sheets.bounds = device_.create_texture(descs.bounds, {}).handle;
    if (!sheets.bounds) return Reason::map_allocation_failed;
    if (map.storage.occluder_pyramid) {
        const std::uint64_t bytes = pyramid_bytes(map.desc.width, gl::layer_count(map.desc));
        sheets.ends = device_.create_buffer({map.desc.label + ", ends", bytes, gl::BufferUse::updated}, {}).handle;
        if (!sheets.ends) return Reason::map_allocation_failed;
    }
    for (std::int32_t layer = 0; layer < static_cast<std::int32_t>(gl::layer_count(map.desc)); ++layer) {
        const auto second = device_.create_target({descs.second.label, {}, {sheets.second, layer}});
        if (second) sheets.second_targets.push_back(second.handle);
        const auto bounds = device_.create_target({descs.bounds.label, {{sheets.bounds, layer}}, {}});
        if (bounds) sheets.bounds_targets.push_back(bounds.handle);
        if (!second || !bounds) return Reason::target_incomplete;
    }
    return Reason::none;
}

void MapCache::release_sheets(BoundsTextures& sheets) const {
    for (const auto* targets : {&sheets.second_targets, &sheets.bounds_targets})
        for (const gl::TargetHandle target : *targets) device_.destroy(target);
    device_.destroy(sheets.second);
    device_.destroy(sheets.bounds);
    device_.destroy(sheets.ends);
    sheets = {};
}

Reason MapCache::try_create(const gl::TextureDesc& desc, const ShadowRequest& request, CachedMap& cached) {
    CachedMap made;
    made.desc = desc;
    made.storage = filter_row(request.map.filter).storage;
    made.references = references_of(request);
    made.texture = device_.create_texture(desc, {}).handle;
    const bool triangles = has_triangles(made.storage), sheets = made.storage.conservative_bounds;
    gl::TextureDesc shown = sheets ? bounds_descs_of(desc).triangles : triangles_of(desc, made.references.format());
    shown.label = desc.label + ", triangles";
    shown.shared = desc.shared && !sheets;  // the map that is peeled has one of its own
    if (made.texture && triangles) made.triangles = device_.create_texture(shown, {}).handle;
    Reason reason = Reason::none;
    if (!made.texture || (triangles && !made.triangles)) reason = Reason::map_allocation_failed;
    if (reason == Reason::none && !make_targets(made)) reason = Reason::target_incomplete;
    if (reason == Reason::none) reason = make_moments(request, made);
    if (reason == Reason::none && sheets) reason = make_sheets(made);
    if (reason != Reason::none) {
        release(made);
        return reason;
    }
    // The new map exists; only now is the old one freed.
    release(cached);
    cached.desc = desc;
    cached.texture = made.texture;
    cached.storage = made.storage;
    cached.triangles = made.triangles;
    cached.references = made.references;
    cached.sheets = std::move(made.sheets);
    cached.moments = std::move(made.moments);
    cached.layers.targets = std::move(made.layers.targets);
    cached.layers.content.assign(cached.layers.targets.size(), 0);
    cached.layers.placements.assign(cached.layers.targets.size(), 0);
    return Reason::none;
}

bool MapCache::ensure_map(const LightItem& light, const ShadowRequest& request, bool shrinks, CachedMap& cached) {
    gl::TextureDesc desc = map_desc(light, request);
    if (shares_layers_) {
        const std::uint32_t class_px = std::bit_ceil(std::max(desc.width, kLeastSharedEdge_px));
        if (!snaps_to_texels(light)) desc.width = desc.height = std::min(class_px, device_.info().max_texture_px);
        desc.shared = true;
    }
    const FilterStorage& storage = filter_row(request.map.filter).storage;
    const gl::TextureDesc& present = cached.desc;
    if (cached.texture &&
        !(present.kind == desc.kind && present.layers == desc.layers && present.format == desc.format &&
          cached.storage == storage && cached.references == references_of(request) &&
          is_same_store(cached.moments, moments_of(present, request.map)))) {
        // The light needs a map of another kind. The old map has no use, nor has the record of a failure.
        release(cached);
        cached.allocation.wanted_px = 0;
        cached.allocation.failure = Reason::none;
    }
    const bool fits = cached.texture && cached.allocation.wanted_px == desc.width;
    if (fits && (cached.allocation.failure == Reason::none || frame_ < cached.allocation.retry_frame)) return true;
    if (cached.allocation.failure != Reason::none && frame_ < cached.allocation.retry_frame &&
        cached.allocation.wanted_px == desc.width)
        return static_cast<bool>(cached.texture);
    const std::uint32_t edge_px = desc.width;
    desc.label = "shadow map " + light.name;
    cached.allocation.wanted_px = edge_px;
    cached.allocation.failure = Reason::none;
    for (std::uint32_t halving = 0; halving <= kHalvings; ++halving) {
        desc.width = desc.height = std::max(edge_px >> halving, 1u);
        if (halving > 0 && fits && cached.texture && desc.width <= cached.desc.width) break;  // no larger
        const PrefilterDescs moments = moments_of(desc, request.map);
        const std::uint64_t needed_bytes =
            map_bytes(desc, storage, references_of(request).format(), moments.texture, moments.scratch);
        const bool has_room = make_room(needed_bytes, &cached) || shrinks;
        Reason reason = has_room ? try_create(desc, request, cached) : Reason::over_budget;
        if (reason == Reason::map_allocation_failed && spare_ && spare_->bytes() > 0) {
            spare_->release();
            device_.finish();  // only then does the driver return what was freed
            reason = try_create(desc, request, cached);
        }
        refused_ = refused_ || reason == Reason::map_allocation_failed;
        if (reason == Reason::none) {
            if (halving > 0) cached.allocation.failure = Reason::map_shrunk;
            break;
        }
        cached.allocation.failure = reason;
        if (reason == Reason::target_incomplete) break;  // a smaller one would fail alike
    }
    if (cached.allocation.failure != Reason::none) cached.allocation.retry_frame = frame_ + kRetryFrames;
    if (cached.allocation.failure != Reason::none && cached.texture) cached.allocation.failure = Reason::map_shrunk;
    return static_cast<bool>(cached.texture);
}

bool MapCache::stay() {
    for (const CachedMap& cached : lights_) {
        const bool wanted = cached.last_wanted_frame + 1 == frame_;
        if (wanted && cached.allocation.failure != Reason::none && frame_ >= cached.allocation.retry_frame)
            return false;
        if (!wanted && cached.texture && frame_ - cached.last_wanted_frame > kHoldFrames) return false;
        if (is_copy_idle(cached) || (wanted && cached.waits)) return false;
    }
    for (CachedMap& cached : lights_)
        if (cached.last_wanted_frame + 1 == frame_) cached.last_wanted_frame = frame_;
    return true;
}

/// Frees the map of a light without views in this frame after kHoldFrames, or at once if the budget leaves it none.
/// Until then the camera may turn back.
void MapCache::keep_or_release(ecs::Entity light, Reason skip) {
    const CachedMap* present = find(light);
    if (!present) return;
    CachedMap& cached = entry(light);
    cached.kept_frame = frame_;
    if (skip == Reason::over_budget || frame_ - cached.last_wanted_frame > kHoldFrames) release(cached);
}

void MapCache::provide_maps(const SceneSnapshot& scene, std::span<const BudgetDecision> decisions,
                            const LightAccounts& accounts) {
    const auto wants_map = [&](std::size_t i) {
        return !accounts.statuses[i].is_skipped() && has_map(decisions[i].request);
    };
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        if (decisions[i].request.skip != Reason::none) continue;
        if (accounts.statuses[i].is_skipped()) keep_or_release(scene.lights[i].entity, accounts.statuses[i].skipped());
        if (!wants_map(i)) continue;
        CachedMap& cached = entry(scene.lights[i].entity);
        cached.kept_frame = cached.last_wanted_frame = frame_;
        cached.waits = false;
    }
    const auto is_gone = [&](CachedMap& cached) {
        if (cached.kept_frame == frame_) return false;
        release(cached);
        return true;
    };
    if (std::erase_if(lights_, is_gone) > 0) note_places(0);
    if (keep_limit_ != kNoLimit) {
        std::uint64_t wanted_bytes = 0;
        for (std::size_t i = 0; i < decisions.size(); ++i)
            if (wants_map(i)) wanted_bytes += map_bytes(scene.lights[i], decisions[i].request);
        evict_unseen(wanted_bytes);
    }
    // Within a limit, maps that become smaller are replaced first, so that the others find room. These need none: where
    // the limit fell, all of them together come to lie below it.
    const bool limited = limit_ != kNoLimit;
    if (limited) make_room(0, nullptr);
    for (int round = 0; round < (limited ? 2 : 1); ++round)
        for (std::uint32_t i = 0; i < decisions.size(); ++i) {
            if (!wants_map(i)) continue;
            const LightTimer time(accounts.cpu_us, i);
            const ShadowRequest& request = decisions[i].request;
            CachedMap& cached = entry(scene.lights[i].entity);
            const bool first = !limited || map_bytes(scene.lights[i], request) < bytes(cached);
            if (first != (round == 0)) continue;
            if (ensure_map(scene.lights[i], request, limited && first, cached)) continue;
            accounts.statuses[i].lose_maps(cached.allocation.failure, request.rays.used);
        }
    if (!std::exchange(refused_, false)) return;
    available_ = bytes();
    short_until_frame_ = frame_ + kRetryFrames;
}

void MapCache::release_static_copy(StaticCopy& still) const {
    device_.destroy(still.texture);
    device_.destroy(still.triangles);
    still.texture = still.triangles = {};
    for (StaticCopy::Layer& layer : still.layers) layer.content = 0;
}

bool MapCache::provide_static_copy(CachedMap& map) const {
    StaticCopy& still = map.still;
    if (still.texture) return true;
    if (frame_ < still.retry_frame) return false;
    std::uint64_t others = 0;  // copies that are worth more room, and still to be made
    for (const CachedMap& other : lights_)
        if (!map.still.is_worth_room && other.still.is_worth_room && !other.still.texture)
            others += static_copy_bytes(other);
    if (limit_ != kNoLimit && bytes() + others + static_copy_bytes(map) > limit_) return false;
    yield_spare(static_copy_bytes(map));
    gl::TextureDesc desc = map.desc;
    desc.label += ", still";
    desc.shared = false;
    still.texture = device_.create_texture(desc, {}).handle;
    desc.label += " triangles";
    desc.format = map.references.format();
    if (still.texture && map.triangles) still.triangles = device_.create_texture(desc, {}).handle;
    if (still.texture && static_cast<bool>(still.triangles) == static_cast<bool>(map.triangles)) return true;
    release_static_copy(still);
    still.retry_frame = frame_ + kRetryFrames;
    return false;
}

bool MapCache::is_copy_idle(const CachedMap& map) const {
    return map.still.texture && frame_ - map.still.last_used_frame > kHoldFrames;
}

void MapCache::release_idle_copies() {
    for (CachedMap& map : lights_)
        if (is_copy_idle(map)) release_static_copy(map.still);
}

gl::TargetHandle MapCache::whole_target(CachedMap& map) const {
    if (!map.whole) map.whole = device_.create_target(target_of(map, gl::kAllLayers)).handle;
    return map.whole;
}

}  // namespace gnomon::shadow
