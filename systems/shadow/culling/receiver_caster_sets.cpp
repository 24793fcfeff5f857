#include "systems/shadow/culling/receiver_caster_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/culling/nearest_receiver.h"
#include "systems/shadow/culling/receiver_hull.h"
#include "systems/shadow/culling/swept_volume.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/projection/light_range.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/filter_settings.h"

namespace gnomon::shadow {
namespace {

using math::Overlap;

IndexRange since(std::size_t first, std::size_t end) {
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first)};
}

/// One light's share of the stage.
class Search {
public:
    Search(const SceneSnapshot& scene, const ShadowDemand& demand, ShadowFrame& frame)
        : scene_(scene),
          demand_(demand),
          light_(scene.lights[demand.light]),
          frame_(frame),
          scratch_(frame.set_scratch),
          reach_(light_) {}

    PotentialSets run() {
        const std::size_t receivers = frame_.receiver_items.size(), points = frame_.receiver_points_ws.size(),
                          beams = frame_.beams.size();
        find_candidates();
        scratch_.receivers.clear(scene_.instances.size());
        if (light_.kind == LightKind::directional) look_along_sun();
        const LightOpenings openings = light_openings(light_, demand_);
        for (const LightOpening& opening : openings.span()) look_through(opening);
        scratch_.receivers.for_each([&](std::uint32_t i) { frame_.receiver_items.push_back(i); });
        PotentialSets sets;
        sets.receivers = since(receivers, frame_.receiver_items.size());
        sets.receiver_points = since(points, frame_.receiver_points_ws.size());
        sets.beams = since(beams, frame_.beams.size());
        return sets;
    }

private:
    /// Receivers whose bounds touch what a consumer sees and what the light reaches, consumer by consumer, by index.
    void find_candidates() {
        scratch_.candidates.clear();
        for (std::uint32_t c = 0; c < frame_.seen.size(); ++c) {
            scratch_.marks.clear(scene_.instances.size());
            const auto planes = math::planes_of(frame_.seen[c]);
            const auto classify = [&](const math::Aabb& box) {
                const Overlap seen = math::overlap(planes, box);
                if (seen == Overlap::outside) return seen;
                const Overlap reached = reach_.overlap(box);
                return reached == Overlap::inside ? seen : reached;
            };
            visit_instances(scene_, classify, [&](std::uint32_t i) {
                const InstanceItem& item = scene_.instances[i];
                if (item.visible && receives_under(light_, item)) scratch_.marks.add(i);
            });
            scratch_.marks.for_each([&](std::uint32_t i) { scratch_.candidates.push_back({i, c}); });
        }
    }

    /// Appends the corners of the candidates within what their consumer sees and the given planes; of whom, and for
    /// whom, goes to the beam.
    IndexRange clip_candidates(std::span<const math::Plane> opening, Beam& beam) {
        const std::size_t first = frame_.receiver_points_ws.size();
        std::array<math::Plane, math::kMaxClipPlanes> planes;
        for (const SetScratch::Candidate& candidate : scratch_.candidates) {
            const auto seen = math::planes_of(frame_.seen[candidate.consumer]);
            const auto middle = std::copy(seen.begin(), seen.end(), planes.begin());
            const auto end = std::copy(opening.begin(), opening.end(), middle);
            const math::Aabb box = reach_.clipped(scene_.instances[candidate.item].bounds_ws);
            const auto used = std::span(planes).first(static_cast<std::size_t>(end - planes.begin()));
            if (math::clip_box(used, box, frame_.receiver_points_ws) == 0) continue;
            scratch_.receivers.add(candidate.item);
            beam.consumers |= consumer_bit(candidate.consumer);
            ++beam.receivers;
        }
        return since(first, frame_.receiver_points_ws.size());
    }

    void look_along_sun() {
        Beam seen;
        const IndexRange range = clip_candidates({}, seen);
        if (range.count == 0) return;
        Beam beam =
            parallel_beam(math::basis_from_back(light_.rotation_ws[2]), points(range), frame_.outlines, scratch_);
        beam.receiver_points = range;
        beam.receivers = seen.receivers;
        beam.consumers = seen.consumers;
        frame_.beams.push_back(beam);
    }

    void look_through(const LightOpening& opening) {
        const glm::dvec3& lamp = lamp_ws_m(frame_, scene_, demand_.light);
        const auto sides = opening_planes(lamp, opening);
        std::array<math::Plane, 5> planes;
        const auto end = std::copy(sides.begin(), sides.end(), planes.begin());
        const glm::dvec3& back = light_.rotation_ws[2];
        if (light_.kind == LightKind::spot) *end = {-back, glm::dot(back, lamp)};
        Beam seen, beam;
        const IndexRange range = clip_candidates(std::span(planes).first(light_.kind == LightKind::spot ? 5 : 4), seen);
        if (range.count > 0) beam = opening_beam(lamp, opening, points(range), frame_.outlines, scratch_);
        beam.origin_ws_m = lamp;
        beam.axes = opening.axes;
        if (beam.outline.count > 0) {
            beam.receiver_points = range;
            beam.receivers = seen.receivers;
            beam.consumers = seen.consumers;
        }
        frame_.beams.push_back(beam);  // without receivers, too: beams are in the order of the openings
    }

    std::span<const glm::dvec3> points(IndexRange range) const {
        return std::span(frame_.receiver_points_ws).subspan(range.first, range.count);
    }

    const SceneSnapshot& scene_;
    const ShadowDemand& demand_;
    const LightItem& light_;
    ShadowFrame& frame_;
    SetScratch& scratch_;
    LightReach reach_;
};

/// How far beyond a lamp's beam, in tangents, casters hide part of a source with a size: as far as filters read texels.
double lamp_reach(const FilterDemand& filter, double size_px, const LightOpening& opening) {
    const glm::dvec2 sides = opening.high - opening.low;
    const double seen_px = size_px - 2.0 * border_px(size_px, static_cast<double>(filter.border_texel));
    return std::max(sides.x, sides.y) * static_cast<double>(filter.widest_texel) / seen_px;
}

/// Heights of a box and of one within it are not told apart by less of what they are sums of: 24 roundings.
constexpr double kHeightRounding = 0x1p-48;

/// Beyond a sun's, in metres: as far as the highest of them stands above the lowest receiver, times the tangent.
double sun_reach_m(const SceneSnapshot& scene, const FilterDemand& filter, const Beam& beam) {
    const auto height_m = [&](const math::Aabb& box) {
        return glm::dot(math::centre(box) - beam.origin_ws_m, beam.axes[2]) +
               glm::dot(math::half_extent(box), glm::abs(beam.axes[2])) + beam.far_m;
    };
    const auto rank = [&](const math::Aabb& box) {
        const glm::dvec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max)) + glm::abs(beam.origin_ws_m);
        return -height_m(box) - kHeightRounding * (largest.x + largest.y + largest.z + beam.far_m);
    };
    const double highest_m = -lowest_of_instances(scene, rank, [&](std::uint32_t i, double lowest) {
        const InstanceItem& item = scene.instances[i];
        return item.casts ? std::min(lowest, -height_m(item.bounds_ws)) : lowest;
    });
    return std::max(highest_m, 0.0) * static_cast<double>(filter.sun_radius_tan);
}

/// Casters that touch any of the light's beams.
void select_casters(const SceneSnapshot& scene, const ShadowDemand& demand, PotentialSets& sets, ShadowFrame& frame) {
    const LightItem& light = scene.lights[demand.light];
    Marks& marks = frame.set_scratch.marks;
    std::vector<glm::dvec2>& polygon = frame.set_scratch.polygon;
    marks.clear(scene.instances.size());
    const bool has_size = needs_distances(demand.filtering);
    const LightOpenings openings = has_size ? light_openings(light, demand) : LightOpenings{};
    for (std::uint32_t b = 0; b < sets.beams.count; ++b) {
        const Beam& beam = frame.beams[sets.beams.first + b];
        if (beam.outline.count == 0) continue;
        const auto outline = std::span(frame.outlines).subspan(beam.outline.first, beam.outline.count);
        polygon.assign(outline.begin(), outline.end());
        double reach = 0.0;
        if (has_size)
            reach = beam.parallel ? sun_reach_m(scene, demand.filtering, beam)
                                  : lamp_reach(demand.filtering, demand.resolution_px, openings.items[b]);
        if (has_size) widen(polygon, glm::dvec2(reach), frame.set_scratch);
        const double reach_m = 2.0 * reach * (beam.parallel ? 1.0 : beam.far_m);
        const SweptVolume volume = swept_volume(beam, polygon, seen_by_the_only_consumer(frame), reach_m);
        visit_instances(
            scene, [&](const math::Aabb& box) { return overlap(volume, box); },
            [&](std::uint32_t i) {
                if (casts_under(light, scene.instances[i])) marks.add(i);
            });
    }
    sets.casters.first = static_cast<std::uint32_t>(frame.caster_items.size());
    marks.for_each([&](std::uint32_t i) { frame.caster_items.push_back(i); });
    sets.casters.count = static_cast<std::uint32_t>(frame.caster_items.size()) - sets.casters.first;
}

/// A half-space without a point.
constexpr math::Plane kNothing{glm::dvec3(0.0), -1.0};

/// What the consumer sees from the nearest receiver on: bounds of meshes tell less, since a camera stands in the middle
/// of the larger ones. A scene without shapes has its bounds alone.
math::Frustum seen_receivers(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                             SetScratch& scratch) {
    if (scene.shapes.empty()) return consumer_frustum(consumer);
    const double from_m = nearest_receiver_m(scene, consumer, layers, scratch.points_ws);
    if (std::isfinite(from_m)) return consumer_frustum(consumer, std::max(consumer.near_m, from_m));
    math::Frustum nothing = consumer_frustum(consumer);
    nothing.planes[0] = kNothing;
    return nothing;
}

PotentialSets sets_of(const SceneSnapshot& scene, const ShadowDemand& demand, ShadowFrame& frame) {
    PotentialSets sets = Search(scene, demand, frame).run();
    select_casters(scene, demand, sets, frame);
    if (sets.casters.count == 0) sets.skip = Reason::no_caster;
    if (sets.receivers.count == 0) sets.skip = Reason::no_visible_receiver;
    return sets;
}

ShadowLayers layers_of_all(const SceneSnapshot& scene, const ShadowFrame& frame) {
    ShadowLayers layers = 0;
    for (const ShadowDemand& demand : frame.demands)
        if (demand.skip == Reason::none) layers |= scene.lights[demand.light].shadow.layers;
    return layers;
}

}  // namespace

bool reaches_anything_seen(const SceneSnapshot& scene, const LightItem& light, const ConsumerItem& consumer) {
    if (light.kind == LightKind::directional) return true;
    const LightReach reach(light);
    const math::Frustum frustum = consumer_frustum(consumer);
    const auto planes = math::planes_of(frustum);
    bool found = false;
    const auto classify = [&](const math::Aabb& box) {
        if (found) return Overlap::outside;
        const Overlap seen = math::overlap(planes, box);
        if (seen == Overlap::outside) return seen;
        const Overlap reached = reach.overlap(box);
        return reached == Overlap::inside ? seen : reached;
    };
    visit_instances(scene, classify, [&](std::uint32_t i) { found = found || scene.instances[i].visible; });
    return found;
}

std::span<const math::Plane> seen_by_the_only_consumer(const ShadowFrame& frame) {
    if (frame.seen.size() != 1) return {};
    return math::planes_of(frame.seen.front());
}

void select_sets(const SceneSnapshot& scene, ShadowFrame& frame) {
    frame.sets.clear();
    frame.receiver_items.clear();
    frame.caster_items.clear();
    frame.receiver_points_ws.clear();
    frame.beams.clear();
    frame.outlines.clear();
    frame.seen.clear();
    const ShadowLayers layers = layers_of_all(scene, frame);
    for (const ConsumerItem& consumer : scene.consumers)
        frame.seen.push_back(seen_receivers(scene, consumer, layers, frame.set_scratch));
    for (const ShadowDemand& demand : frame.demands) {
        const LightTime time(frame, demand.light);
        PotentialSets sets;
        sets.skip = demand.skip;
        if (demand.skip == Reason::none) sets = sets_of(scene, demand, frame);
        frame.sets.push_back(sets);
    }
}

void select_sets_again(const SceneSnapshot& scene, std::uint32_t d, ShadowFrame& frame) {
    const ShadowDemand& demand = frame.demands[d];
    if (scene.lights[demand.light].kind != LightKind::point) return;
    const Reason skip = frame.sets[d].skip;
    frame.sets[d] = sets_of(scene, demand, frame);
    frame.sets[d].skip = skip;
}

}  // namespace gnomon::shadow
