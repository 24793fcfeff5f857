#include "systems/shadow/culling/receiver_mask.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/math/aabb.h"
#include "tests/unit/shadow/random_scene.h"

/// Casters of a sun that turns: all that darken a receiver that is seen, and few others.
namespace gnomon::shadow {
namespace {

/// Rectangle of a box across the light, metres from the map's origin.
struct Across {
    glm::dvec2 low, high;
};
Across across(const ShadowView& view, const math::Aabb& box_ws) {
    Across a{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (const glm::dvec3& corner : math::corners(box_ws)) {
        const glm::dvec3 from = corner - view.pose.anchor_ws_m;
        const glm::dvec2 at(glm::dot(from, view.pose.axis_u), glm::dot(from, view.pose.axis_v));
        a.low = glm::min(a.low, at);
        a.high = glm::max(a.high, at);
    }
    return a;
}
/// Returns how far two rectangles are apart, along the axis along which they are farthest.
double apart_m(const Across& a, const Across& b) {
    const glm::dvec2 gap = glm::max(a.low - b.high, b.low - a.high);
    return std::max(gap.x, gap.y);
}

ShadowView map_of(RandomScene& random) {
    ShadowView view;
    const glm::dmat3 axes = math::basis_from_back(random.direction());
    view.pose.axis_u = axes[0];
    view.pose.axis_v = axes[1];
    view.pose.axis_back = axes[2];
    view.pose.anchor_ws_m = random.vector(1.0e5);
    view.plane.centre_ls_m = glm::dvec2(random.vector(30.0));
    view.plane.half_extent_m = glm::dvec2(random.number(10.0, 60.0), random.number(10.0, 60.0));
    return view;
}

InstanceItem box_at(RandomScene& random, const ShadowView& view) {
    const glm::dvec3 middle = view.pose.anchor_ws_m + random.vector(80.0), half = glm::abs(random.vector(7.0)) + 0.01;
    InstanceItem item;
    item.bounds_ws = {middle - half, middle + half};
    return item;
}

TEST(ReceiverMask, CoversWhatLiesOverAReceiverInTheMapAndLittleElse) {
    RandomScene random(print_seed());
    int covered = 0, free = 0;
    for (int round = 0; round < 240; ++round) {
        const ShadowView view = map_of(random);
        SceneSnapshot scene;
        std::vector<std::uint32_t> receivers;
        for (std::uint32_t i = 0; i < (round % 2 == 0 ? 12u : 40u); ++i) {
            scene.instances.push_back(box_at(random, view));
            receivers.push_back(i);
        }
        const glm::dvec2 reach_m(0.3, 0.1);
        ReceiverMask mask;
        build_receiver_mask(scene, receivers, view, reach_m, mask);
        const Across map{view.plane.centre_ls_m - view.plane.half_extent_m,
                         view.plane.centre_ls_m + view.plane.half_extent_m};
        const glm::dvec2 cell_m = (map.high - map.low) / static_cast<double>(mask.cells);
        for (int k = 0; k < 200; ++k) {
            const math::Aabb caster = box_at(random, view).bounds_ws;
            const Across at = across(view, caster);
            bool over = false, near = false;
            for (const InstanceItem& receiver : scene.instances) {
                Across of = across(view, receiver.bounds_ws);
                of = {of.low - reach_m, of.high + reach_m};
                // Both must meet in the map.
                const Across common{glm::max(glm::max(at.low, of.low), map.low),
                                    glm::min(glm::min(at.high, of.high), map.high)};
                over = over || (common.low.x < common.high.x && common.low.y < common.high.y);
                near = near || apart_m(at, of) < 2.0 * std::max(cell_m.x, cell_m.y);
            }
            const bool covered_by_mask = covers(mask, caster);
            EXPECT_TRUE(covered_by_mask || !over) << "round " << round;
            EXPECT_TRUE(!covered_by_mask || near) << "round " << round;
            covered += over ? 1 : 0;
            free += near ? 0 : 1;
        }
    }
    EXPECT_GT(covered, 500);
    EXPECT_GT(free, 2000);
}

TEST(ReceiverMask, HasAsManyCellsAsItsReceiversNeed) {
    RandomScene random(print_seed());
    const ShadowView view = map_of(random);
    SceneSnapshot scene;
    scene.instances.resize(2000, box_at(random, view));
    std::vector<std::uint32_t> receivers;
    ReceiverMask mask;
    const auto cells = [&](std::uint32_t count) {
        receivers.assign(count, 0);
        build_receiver_mask(scene, receivers, view, glm::dvec2(0.1), mask);
        EXPECT_EQ(mask.sums.size(), static_cast<std::size_t>((mask.cells + 1) * (mask.cells + 1)));
        return mask.cells;
    };
    EXPECT_EQ(cells(0), ReceiverMask::kFewestCells);
    EXPECT_EQ(cells(16), 32);
    EXPECT_EQ(cells(17), 64);
    EXPECT_EQ(cells(257), 256);
    EXPECT_EQ(cells(2000), ReceiverMask::kMostCells);
}

TEST(ReceiverMask, WithoutReceiversCoversNothing) {
    RandomScene random(print_seed());
    const ShadowView view = map_of(random);
    SceneSnapshot scene;
    ReceiverMask mask;
    build_receiver_mask(scene, {}, view, glm::dvec2(1.0), mask);
    EXPECT_FALSE(covers(mask, {view.pose.anchor_ws_m - 1.0e3, view.pose.anchor_ws_m + 1.0e3}));
    // One receiver around all of the map covers all of it, and a box of air without bounds does, too.
    scene.instances.resize(1);
    for (const double size_m : {1.0e3, 1.0e9, 1.0e300}) {
        scene.instances[0].bounds_ws = {view.pose.anchor_ws_m - size_m, view.pose.anchor_ws_m + size_m};
        const std::uint32_t all = 0;
        build_receiver_mask(scene, {&all, 1}, view, glm::dvec2(1.0), mask);
        const glm::dvec3 middle = view.pose.anchor_ws_m + view.pose.axis_u * view.plane.centre_ls_m.x +
                                  view.pose.axis_v * view.plane.centre_ls_m.y;
        EXPECT_TRUE(covers(mask, {middle - 0.01, middle + 0.01})) << size_m;
    }
}

/// Returns boxes with insides that cast and receive.
SceneSnapshot houses(RandomScene& random) {
    SceneSnapshot scene = random.scene(LightKind::directional, 0);
    ConsumerItem& camera = scene.consumers[0];
    camera.position_ws_m = {0.0, 1.7, 18.0};
    camera.rotation_ws = glm::dmat3(1.0);
    camera.fov_y_rad = 0.9;
    const math::Aabb unit{glm::dvec3(-1.0), glm::dvec3(1.0)};
    scene.meshes.inner_boxes_ms = {unit};
    for (int i = 0; i < 60; ++i) {
        InstanceItem item;
        item.gpu_slot = static_cast<std::uint32_t>(i);
        const bool house = i < 8;
        const glm::dvec3 half =
            house ? glm::dvec3(random.number(2.0, 4.0), 4.0, 2.0) : glm::dvec3(0.3, random.number(0.3, 1.0), 0.3);
        item.translation_ws_m = {random.number(-16.0, 16.0), half.y,
                                 house ? random.number(-6.0, 6.0) : random.number(-40.0, 14.0)};
        item.basis = glm::dmat3(1.0);
        for (int k = 0; k < 3; ++k) item.basis[k] *= half[k];
        item.bounds_ws = math::transformed(unit, item.basis, item.translation_ws_m);
        item.casts = item.receives = item.visible = true;
        scene.instances.push_back(item);
    }
    return scene;
}

/// Returns the fits of the last of three frames in which the sun turns.
ShadowFrame after_turns(SceneSnapshot scene, const glm::dvec3& back, double step_rad) {
    History history;
    ShadowFrame frame;
    for (int i = 0; i < 3; ++i) {
        scene.lights[0].rotation_ws = math::basis_from_back(back + glm::dvec3(step_rad * (i - 2), 0.0, 0.0));
        frame = fitted(scene, history);
        history = frame.next_history;
    }
    return frame;
}

TEST(ReceiverMask, LeavesATurningSunAllCastersThatDarkenWhatIsSeen) {
    RandomScene random(print_seed());
    std::size_t blocked = 0, listed = 0, without = 0;
    for (int round = 0; round < 150; ++round) {
        SceneSnapshot scene = houses(random);
        glm::dvec3 back = random.direction();
        back.y = std::abs(back.y) + 0.3;
        scene.lights[0].rotation_ws = math::basis_from_back(back);
        const ShadowFrame frame = after_turns(scene, back, 0.001);
        ASSERT_FALSE(frame.fitted.views_of(0).empty());
        SceneSnapshot open = scene;
        open.meshes.inner_boxes_ms.clear();
        listed += frame.fitted.casters.size();
        const ShadowFrame all = after_turns(open, back, 0.001), still = after_turns(scene, back, 0.0);
        without += all.fitted.casters.size();
        for (const ShadowView& view : frame.fitted.views_of(0)) EXPECT_FALSE(view.stays);
        for (const ShadowView& view : all.fitted.views_of(0)) EXPECT_TRUE(view.stays) << "no occluders";
        for (const ShadowView& view : still.fitted.views_of(0)) EXPECT_TRUE(view.stays) << "it does not turn";
        const ConsumerItem& camera = scene.consumers[0];
        for (const InstanceItem& receiver : scene.instances)
            for (int k = 0; k < 10; ++k) {
                const glm::dvec3 p = random_point(random, receiver.bounds_ws);
                const auto between = [&](const InstanceItem& item, const glm::dvec3& to) {
                    const Crossing c = crossing(item.bounds_ws, p, to);
                    return &item != &receiver && c.from <= c.to;
                };
                if (!seen(camera, p)) continue;
                if (std::any_of(scene.instances.begin(), scene.instances.end(),
                                [&](const InstanceItem& item) { return between(item, camera.position_ws_m); }))
                    continue;
                for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
                    if (!between(scene.instances[i], source_of(scene.lights[0], p))) continue;
                    ++blocked;
                    const auto lists = [&](const ShadowView& view) {
                        const auto casters = frame.fitted.casters_of(view);
                        return std::find(casters.begin(), casters.end(), i) != casters.end();
                    };
                    const auto views = frame.fitted.views_of(0);
                    EXPECT_TRUE(std::any_of(views.begin(), views.end(), lists))
                        << "round " << round << ", caster " << i;
                }
            }
    }
    EXPECT_GT(blocked, 1000u);
    EXPECT_LT(listed * 5, without * 4) << "occluders leave out a fifth and more";
}

}  // namespace
}  // namespace gnomon::shadow
