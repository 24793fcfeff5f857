#include "systems/shadow/culling/inner_receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "systems/extract/scene_tree.h"

namespace gnomon::shadow {
namespace {

using math::Overlap;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Rounds in which corners are looked for beyond the facets of the hull of those found before. One leaves a sixth of
/// what lies outside without it; another one takes longer than it saves (`./gnomon bench culling`).
constexpr int kRounds = 1;

/// Returns the corner of a box that is farthest along a direction.
glm::dvec3 farthest_corner(const math::Aabb& box, const glm::dvec3& direction) {
    return glm::mix(box.min, box.max, glm::greaterThan(direction, glm::dvec3(0.0)));
}

class Splitter {
public:
    Splitter(const SceneSnapshot& scene, const ReceiverVolume& volume, SplitScratch& scratch)
        : scene_(scene), volume_(volume), scratch_(scratch) {}

    void build_hull() {
        scratch_.corners_ws_m.clear();
        scratch_.known.assign(scene_.tree.numbers(), kUnknown);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (x != 0 || y != 0 || z != 0) add_farthest({x, y, z});
        scratch_.hull.build(scratch_.corners_ws_m);
        for (int round = 0; round < kRounds; ++round) {
            const std::size_t before = scratch_.corners_ws_m.size();
            for (const glm::dvec3& normal : scratch_.hull.normals()) add_farthest(normal);
            if (scratch_.corners_ws_m.size() == before) break;
            scratch_.hull.build(scratch_.corners_ws_m);
        }
    }

    void split() {
        scratch_.inner.clear();
        scratch_.marks.clear(scene_.instances.size());
        bool inner = false;
        std::size_t last_facet = 0;
        const auto classify = [&](const math::Aabb& box, math::OpenTests& open) {
            if (math::overlap(volume_.planes, box, open) == Overlap::outside || !math::overlaps(volume_.limit, box))
                return Overlap::outside;
            // A box that reaches beyond the limit may have parts outside.
            inner = math::intersection(box, volume_.limit) == box && scratch_.hull.contains(box, last_facet);
            return inner ? Overlap::inside : Overlap::partial;
        };
        // An instance is visited right after it, or a box around it, was classified.
        visit_instances(scene_, math::open_tests(volume_.planes.size()), classify, [&](std::uint32_t i) {
            if (!scratch_.wanted.contains(i)) return;
            if (inner)
                scratch_.inner.push_back(i);
            else
                scratch_.marks.add(i);
        });
        scratch_.others.clear();
        scratch_.marks.for_each([&](std::uint32_t i) { scratch_.others.push_back(i); });
    }

private:
    /// What is known of a box of the tree: SplitScratch::known.
    enum : std::uint8_t { kUnknown, kOutside, kMayTouch, kInCore, kNotInCore };

    bool is_outside(const math::Aabb& box) const {
        return math::overlap(volume_.planes, box) == Overlap::outside || !math::overlaps(volume_.limit, box);
    }

    bool is_in_core(const math::Aabb& box) const {
        return math::overlap(volume_.planes, box) == Overlap::inside &&
               math::overlap(volume_.core, box) == Overlap::inside;
    }

    /// Returns whether a box of the tree may touch the core. Tests each box once for all
    /// directions.
    bool may_touch_core(const math::Aabb& box, std::uint32_t number) {
        std::uint8_t& known = scratch_.known[number];
        if (known == kUnknown)
            known = is_outside(box) || math::overlap(volume_.core, box) == Overlap::outside ? kOutside : kMayTouch;
        return known != kOutside;
    }

    /// Returns whether an item of the tree that may touch the core is a receiver within it.
    bool is_wanted_in_core(std::uint32_t item, const math::Aabb& box, std::uint32_t number) {
        std::uint8_t& known = scratch_.known[number];
        if (known == kMayTouch) known = scratch_.wanted.contains(item) && is_in_core(box) ? kInCore : kNotInCore;
        return known == kInCore;
    }

    /// Adds the corner of a receiver within the core that is farthest along a direction, unless it is there.
    void add_farthest(const glm::dvec3& direction) {
        std::vector<glm::dvec3>& corners = scratch_.corners_ws_m;
        if (corners.size() >= math::InnerHull::kMostPoints) return;
        const auto corner_of = [&](const math::Aabb& box) {
            return farthest_corner(math::intersection(box, volume_.limit), direction);
        };
        const auto rank = [&](const math::Aabb& box, std::uint32_t number) {
            return may_touch_core(box, number) ? -glm::dot(direction, corner_of(box)) : kInfinity;
        };
        glm::dvec3 found;
        const auto value = [&](std::uint32_t i, double lowest, std::uint32_t number) {
            const math::Aabb box = math::intersection(scene_.instances[i].bounds_ws, volume_.limit);
            const glm::dvec3 corner = farthest_corner(box, direction);
            const double at = -glm::dot(direction, corner);
            if (!(at < lowest) || !is_wanted_in_core(i, box, number)) return lowest;
            found = corner;
            return at;
        };
        if (!(scene_.tree.lowest_by_number(rank, value) < kInfinity)) return;
        if (std::find(corners.begin(), corners.end(), found) == corners.end()) corners.push_back(found);
    }

    const SceneSnapshot& scene_;
    const ReceiverVolume& volume_;
    SplitScratch& scratch_;
};

}  // namespace

SplitReceivers split_receivers(const SceneSnapshot& scene, std::span<const std::uint32_t> receivers,
                               const ReceiverVolume& volume, SplitScratch& scratch) {
    if (receivers.size() <= kFewReceivers || !has_tree(scene)) return {{}, receivers, {}};
    scratch.wanted.clear(scene.instances.size());
    for (const std::uint32_t i : receivers) scratch.wanted.add(i);
    Splitter splitter(scene, volume, scratch);
    splitter.build_hull();
    splitter.split();
    return {scratch.inner, scratch.others, scratch.corners_ws_m};
}

}  // namespace gnomon::shadow
