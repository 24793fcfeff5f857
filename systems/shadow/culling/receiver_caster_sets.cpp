#include "systems/shadow/culling/receiver_caster_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/culling/error_points.h"
#include "systems/shadow/culling/inner_receivers.h"
#include "systems/shadow/culling/lamp_places.h"
#include "systems/shadow/culling/lit_areas.h"
#include "systems/shadow/culling/nearest_receiver.h"
#include "systems/shadow/culling/occluders.h"
#include "systems/shadow/culling/receiver_hull.h"
#include "systems/shadow/culling/swept_volume.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/frame/light_jobs.h"
#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/projection/light_range.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

using math::Overlap;

IndexRange since(std::size_t first, std::size_t end) {
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)};
}

/// Returns a cube's face without what it shares with its neighbours. A wider frustum loses its sides.
LightFrustum without_border(LightFrustum frustum) {
    frustum.low = glm::max(frustum.low, glm::dvec2(-1.0));
    frustum.high = glm::min(frustum.high, glm::dvec2(1.0));
    return frustum;
}

/// Search for the receivers of one light.
class Search {
public:
    Search(const SceneSnapshot& scene, const LightItem& light, const glm::dvec3& lamp_ws_m, SetScratch& scratch,
           ReceiverCasterSets& out)
        : scene_(scene), light_(light), lamp_ws_m_(lamp_ws_m), scratch_(scratch), out_(out), reach_(light_) {}

    LightSets run(const ShadowRequest& request) {
        const std::size_t receivers = out_.receiver_items.size(), points = out_.receiver_points_ws.size(),
                          error_points = out_.error_points_ws.size(), hulls = out_.hulls.size();
        find_candidates();
        scratch_.receivers.clear(scene_.instances.size());
        if (light_facts(light_.kind).parallel) look_along_sun();
        const LightFrusta frusta = light_frusta(light_, request);
        for (const LightFrustum& frustum : frusta.span()) look_through(frustum);
        scratch_.receivers.for_each([&](std::uint32_t i) { out_.receiver_items.push_back(i); });
        LightSets sets;
        sets.receivers = since(receivers, out_.receiver_items.size());
        sets.receiver_points = since(points, out_.receiver_points_ws.size());
        sets.error_points = since(error_points, out_.error_points_ws.size());
        sets.hulls = since(hulls, out_.hulls.size());
        return sets;
    }

private:
    /// Finds receivers with bounds in a camera's frustum and in the light's range, for each camera, by index.
    void find_candidates() {
        scratch_.candidates.clear();
        scratch_.camera_candidates.clear();
        for (std::uint32_t c = 0; c < out_.camera_frusta.size(); ++c) {
            scratch_.marks.clear(scene_.instances.size());
            const auto planes = math::planes_of(out_.camera_frusta[c]);
            const SeenReach seen(planes, reach_);
            const auto classify = [&](const math::Aabb& box, math::OpenTests& open) { return seen.overlap(box, open); };
            visit_instances(scene_, seen.tests(), classify, [&](std::uint32_t i) {
                if (scratch_.layers->shows_shadows_of(light_, i)) scratch_.marks.add(i);
            });
            const std::size_t first = scratch_.candidates.size();
            scratch_.marks.for_each([&](std::uint32_t i) { scratch_.candidates.push_back(i); });
            scratch_.camera_candidates.push_back(since(first, scratch_.candidates.size()));
        }
    }

    /// Clips the candidates to their camera's frustum and the given planes, and appends the corners. Adds the numbers
    /// of receivers and the cameras to `receiver_hull`. `core`: ReceiverVolume::core.
    IndexRange clip_candidates(std::span<const math::Plane> sides, std::span<const math::Plane> core,
                               ReceiverHull& receiver_hull) {
        const std::size_t first = out_.receiver_points_ws.size();
        std::array<math::Plane, math::kMaxClipPlanes> planes;
        for (std::uint32_t c = 0; c < out_.camera_frusta.size(); ++c) {
            const auto seen = math::planes_of(out_.camera_frusta[c]);
            const auto end = std::copy(sides.begin(), sides.end(), std::copy(seen.begin(), seen.end(), planes.begin()));
            const auto used = std::span(planes).first(static_cast<std::size_t>(end - planes.begin()));
            const std::uint32_t found = clip_candidates_of(c, used, core);
            if (found > 0) receiver_hull.consumers |= consumer_bit(c);
            receiver_hull.receivers += found;
            if (!out_.nearest_surface_m.empty())
                append_error_points(scene_, {c, slice(scratch_.candidates, scratch_.camera_candidates[c]), sides, core},
                                    reach_, scratch_, out_);
        }
        return since(first, out_.receiver_points_ws.size());
    }

    /// Clips the candidates of one camera. Returns how many have a part inside of all planes.
    std::uint32_t clip_candidates_of(std::uint32_t camera, std::span<const math::Plane> planes,
                                     std::span<const math::Plane> core) {
        const auto candidates = slice(scratch_.candidates, scratch_.camera_candidates[camera]);
        const math::Aabb limit = reach_.bounds();
        const SplitReceivers split = split_receivers(scene_, candidates, {planes, limit, core}, scratch_.split);
        std::vector<glm::dvec3>& points_ws = out_.receiver_points_ws;
        points_ws.insert(points_ws.end(), split.corners_ws_m.begin(), split.corners_ws_m.end());
        for (const std::uint32_t i : split.inner) scratch_.receivers.add(i);
        auto found = static_cast<std::uint32_t>(split.inner.size());
        for (const std::uint32_t i : split.others) {
            if (math::clip_box(planes, reach_.clipped(scene_.instances[i].bounds_ws), points_ws) == 0) continue;
            scratch_.receivers.add(i);
            ++found;
        }
        return found;
    }

    void look_along_sun() {
        ReceiverHull seen;
        const IndexRange range = clip_candidates({}, {}, seen);
        if (range.count == 0) return;
        ReceiverHull receiver_hull =
            directional_hull(math::basis_from_back(light_.rotation_ws[2]), points(range), out_.outlines, scratch_);
        receiver_hull.receiver_points = range;
        receiver_hull.receivers = seen.receivers;
        receiver_hull.consumers = seen.consumers;
        out_.hulls.push_back(receiver_hull);
    }

    void look_through(const LightFrustum& frustum) {
        const glm::dvec3& lamp = lamp_ws_m_;
        const auto sides = frustum_planes(lamp, frustum), core = frustum_planes(lamp, without_border(frustum));
        std::array<math::Plane, 5> planes;
        const auto end = std::copy(sides.begin(), sides.end(), planes.begin());
        const glm::dvec3& back = light_.rotation_ws[2];
        const bool cone = light_facts(light_.kind).cone, half_space = light_facts(light_.kind).half_space;
        if (cone) *end = {-back, glm::dot(back, lamp)};
        if (half_space) *end = shone_side(light_);
        ReceiverHull seen, receiver_hull;
        const IndexRange range = clip_candidates(std::span(planes).first(cone || half_space ? 5 : 4), core, seen);
        if (range.count > 0) receiver_hull = frustum_hull(lamp, frustum, points(range), out_.outlines, scratch_);
        receiver_hull.origin_ws_m = lamp;
        receiver_hull.axes = frustum.axes;
        if (receiver_hull.outline.count > 0) {
            receiver_hull.receiver_points = range;
            receiver_hull.receivers = seen.receivers;
            receiver_hull.consumers = seen.consumers;
        }
        out_.hulls.push_back(receiver_hull);  // also without receivers: hull i belongs to light frustum i
    }

    std::span<const glm::dvec3> points(IndexRange range) const { return slice(out_.receiver_points_ws, range); }

    const SceneSnapshot& scene_;
    const LightItem& light_;
    const glm::dvec3& lamp_ws_m_;
    SetScratch& scratch_;
    ReceiverCasterSets& out_;
    LightReach reach_;
};

/// Returns how far outside a lamp's receiver hull casters may hide part of an area light, as a tangent: as far as
/// filters read texels.
double lamp_reach(const FilterSettings& filter, double size_px, const LightFrustum& frustum) {
    const glm::dvec2 sides = frustum.high - frustum.low;
    const double seen_px = size_px - 2.0 * border_px(size_px, static_cast<double>(filter.border_texel));
    return std::max(sides.x, sides.y) * static_cast<double>(filter.widest_texel) / seen_px;
}

/// Rounding error of a box's height, as a share of its summands: 24 roundings. Within it, a box may appear higher than
/// a box around it.
constexpr double kHeightRounding = 0x1p-48;

/// Returns how far outside a sun's receiver hull casters may hide part of the sun, metres. It is the height of the
/// highest caster above the lowest receiver, times the tangent of the sun's radius.
double sun_reach_m(const SceneSnapshot& scene, const FilterSettings& filter, const ReceiverHull& receiver_hull) {
    const auto height_m = [&](const math::Aabb& box) {
        return glm::dot(math::centre(box) - receiver_hull.origin_ws_m, receiver_hull.axes[2]) +
               glm::dot(math::half_extent(box), glm::abs(receiver_hull.axes[2])) + receiver_hull.far_m;
    };
    const auto rank = [&](const math::Aabb& box) {
        const glm::dvec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max)) + glm::abs(receiver_hull.origin_ws_m);
        return -height_m(box) - kHeightRounding * (largest.x + largest.y + largest.z + receiver_hull.far_m);
    };
    const double highest_m = -lowest_of_instances(scene, rank, [&](std::uint32_t i, double lowest) {
        const InstanceItem& item = scene.instances[i];
        return item.casts ? std::min(lowest, -height_m(item.bounds_ws)) : lowest;
    });
    return std::max(highest_m, 0.0) * static_cast<double>(filter.sun_radius_tan);
}

/// Marks the casters of an area light that touch the box around its source and all receivers. Every way from one to the
/// other lies in it.
void mark_around_source(const SceneSnapshot& scene, const LightItem& light, std::span<const glm::dvec3> points_ws,
                        SetScratch& scratch) {
    const double reach_m = static_cast<double>(source_extent(light));
    math::Aabb around{light.position_ws_m - reach_m, light.position_ws_m + reach_m};
    for (const glm::dvec3& point : points_ws) around = math::merged(around, {point, point});
    visit_instances(
        scene,
        [&](const math::Aabb& box) {
            return math::is_empty(math::intersection(around, box)) ? Overlap::outside : Overlap::partial;
        },
        [&](std::uint32_t i) {
            if (scratch.layers->casts_under(light, i)) scratch.marks.add(i);
        });
}

/// Appends the casters that touch the volume between the light and any of its receiver hulls.
IndexRange select_casters(const SceneSnapshot& scene, const LightItem& light, const ShadowRequest& request,
                          IndexRange hulls, SetScratch& scratch, ReceiverCasterSets& out) {
    scratch.marks.clear(scene.instances.size());
    const FilterSettings& filter = request.map.filtering;
    const bool has_size = needs_distances(filter);
    const LightFrusta frusta = has_size ? light_frusta(light, request) : LightFrusta{};
    for (std::uint32_t b = 0; b < hulls.count; ++b) {
        const ReceiverHull& receiver_hull = out.hulls[hulls.first + b];
        if (receiver_hull.outline.count == 0) continue;
        const auto outline = slice(out.outlines, receiver_hull.outline);
        scratch.polygon.assign(outline.begin(), outline.end());
        double reach = 0.0;
        if (has_size)
            reach = receiver_hull.parallel ? sun_reach_m(scene, filter, receiver_hull)
                                           : lamp_reach(filter, request.map.resolution_px, frusta.items[b]);
        if (has_size) widen(scratch.polygon, glm::dvec2(reach), scratch);
        const double reach_m = 2.0 * reach * (receiver_hull.parallel ? 1.0 : receiver_hull.far_m);
        const SweptVolume volume =
            swept_volume(receiver_hull, scratch.polygon, seen_by_the_only_consumer(out.camera_frusta), reach_m);
        visit_instances(
            scene, tests_of(volume),
            [&](const math::Aabb& box, math::OpenTests& open) { return overlap(volume, box, open); },
            [&](std::uint32_t i) {
                if (scratch.layers->casts_under(light, i)) scratch.marks.add(i);
            });
    }
    if (has_size && light_facts(light.kind).area())
        for (std::uint32_t b = 0; b < hulls.count; ++b) {
            const IndexRange points = out.hulls[hulls.first + b].receiver_points;
            if (points.count > 0) mark_around_source(scene, light, slice(out.receiver_points_ws, points), scratch);
        }
    const std::size_t first = out.caster_items.size();
    scratch.marks.for_each([&](std::uint32_t i) { out.caster_items.push_back(i); });
    return since(first, out.caster_items.size());
}

/// Half-space without a point.
constexpr math::Plane kNothing{glm::dvec3(0.0), -1.0};

/// Returns the camera's frustum from its nearest receiver on. Without shapes of meshes it is the whole frustum:
/// bounding boxes do not help, because a camera is inside of the larger ones.
math::Frustum seen_receivers(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                             SetScratch& scratch) {
    if (scene.meshes.shapes.empty()) return consumer_frustum(consumer);
    const double from_m = nearest_receiver_m(scene, consumer, layers, scratch.points_ws);
    if (std::isfinite(from_m)) return consumer_frustum(consumer, std::max(consumer.near_m, from_m));
    math::Frustum nothing = consumer_frustum(consumer);
    nothing.planes[0] = kNothing;
    return nothing;
}

ShadowLayers layers_of_all(const SceneSnapshot& scene, std::span<const ShadowRequest> requests) {
    ShadowLayers layers = 0;
    for (std::size_t i = 0; i < requests.size(); ++i)
        if (requests[i].skip == Reason::none) layers |= scene.lights[i].shadow.layers;
    return layers;
}

/// Calls `select` for each light, on several threads, and puts what they find in the order of the lights.
template <class Select>
void select_on_threads(const SetInputs& inputs, const Select& select, StageStorage& storage, ReceiverCasterSets& sets) {
    for (ThreadResults& results : storage.results) {
        results.sets.clear();
        results.sets.camera_frusta = sets.camera_frusta;
        results.sets.nearest_surface_m = sets.nearest_surface_m;
        results.sets.occluders = sets.occluders;
    }
    for_each_light(inputs.jobs, sets.lights.size(), [&](std::size_t light, std::size_t thread) {
        storage.thread_of[light] = thread;
        select(light, thread, storage.results[thread].sets);
    });
    for (std::size_t i = 0; i < sets.lights.size(); ++i)
        sets.lights[i] = append_sets(storage.results[storage.thread_of[i]].sets, sets.lights[i], sets);
    for (ThreadResults& results : storage.results) reserve_as(sets, results.sets);  // any may find most next time
}

}  // namespace

std::span<const math::Plane> seen_by_the_only_consumer(std::span<const math::Frustum> camera_frusta) {
    if (camera_frusta.size() != 1) return {};
    return math::planes_of(camera_frusta.front());
}

LightSets select_light_sets(const SceneSnapshot& scene, std::uint32_t light, const ShadowRequest& request,
                            const glm::dvec3& lamp_ws_m, SetScratch& scratch, ReceiverCasterSets& out) {
    const LightItem& item = scene.lights[light];
    LightSets sets = Search(scene, item, lamp_ws_m, scratch, out).run(request);
    if (!light_facts(item.kind).parallel &&
        are_hidden(out.occluders, slice(out.receiver_points_ws, sets.receiver_points))) {
        sets.receivers.count = sets.receiver_points.count = sets.error_points.count = 0;
        return sets;
    }
    sets.casters = select_casters(scene, item, request, sets.hulls, scratch, out);
    return sets;
}

void select_sets(const SceneSnapshot& scene, const SetInputs& inputs, StageStorage& storage, ReceiverCasterSets& sets,
                 const LightAccounts& accounts) {
    sets.clear();
    storage.layers.update(scene);
    const std::size_t lights = inputs.requests.size(), threads = threads_for(inputs.jobs, lights);
    provide_threads(threads, lights, storage);
    const ShadowLayers layers = layers_of_all(scene, inputs.requests);
    SetScratch& first = storage.scratch.front().sets;
    for (const ConsumerItem& consumer : scene.consumers) {
        sets.camera_frusta.push_back(seen_receivers(scene, consumer, layers, first));
        if (scene.air.any)
            sets.nearest_surface_m.push_back(
                nearest_receiver_m(scene, consumer, layers, first.points_ws, ReceiverKinds::surfaces));
    }
    if (scene.consumers.size() == 1 && scene.pictures.empty())
        find_occluders(scene, scene.consumers.front(), sets.occluders);
    sets.lights.resize(lights);
    const auto select = [&](std::size_t index, std::size_t thread, ReceiverCasterSets& out) {
        const auto i = static_cast<std::uint32_t>(index);
        if (accounts.statuses[i].is_skipped()) return;
        const LightTimer time(accounts.cpu_us, i);
        sets.lights[i] = select_light_sets(scene, i, inputs.requests[i], lamp_ws_m(inputs.lamps_ws_m, scene, i),
                                           storage.scratch[thread].sets, out);
    };
    if (threads > 1)
        select_on_threads(inputs, select, storage, sets);
    else
        for (std::size_t i = 0; i < lights; ++i) select(i, 0, sets);
    for (std::size_t i = 0; i < lights; ++i) {
        LightStatus& status = accounts.statuses[i];
        if (status.is_skipped()) continue;
        if (sets.lights[i].receivers.count == 0) status.skip(Reason::no_visible_receiver);
        if (sets.lights[i].casters.count == 0) status.skip(Reason::no_caster);
    }
    find_lit_areas(scene, inputs.jobs, storage, sets);
}

}  // namespace gnomon::shadow
