#include "systems/shadow/update/stale_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/projection/perspective_view.h"
#include "tests/unit/not_finite.h"
#include "tests/unit/shadow/random_scene.h"

/// How far off a map is that shows casters where they were.
namespace gnomon::shadow {
namespace {

struct Placement {
    glm::dmat3 basis{1.0};
    glm::dvec3 translation_m{0.0};
};

class RandomPlacements {
public:
    explicit RandomPlacements(std::uint64_t seed) : random(seed) {}

    /// Draws a placement: turned by up to 3 rad, stretched by 0 to 2, mirrored half of the time.
    Placement anywhere(double reach_m) {
        const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(random.number(0.0, 3.0), random.direction()));
        const glm::dvec3 scale(random.number(0.5, 2.0), random.number(0.5, 2.0), random.number(-2.0, 2.0));
        return {{turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z}, random.vector(reach_m)};
    }
    Placement moved(const Placement& from, double way_m, double turn_rad) {
        const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(random.number(0.0, turn_rad), random.direction()));
        return {turn * from.basis, from.translation_m + random.vector(way_m)};
    }
    RandomScene random;
};

InstanceItem item_at(const math::Aabb& box_ms, const Placement& at, std::uint64_t version) {
    InstanceItem item;
    item.basis = at.basis;
    item.translation_ws_m = at.translation_m;
    item.bounds_ws = math::transformed(box_ms, at.basis, at.translation_m);
    item.version = version;
    return item;
}

ShownCaster shown_of(const InstanceItem& item) {
    return {item.gpu_slot, item.mesh, item.version, item.basis, item.translation_ws_m, item.bounds_ws, 0, 0.0};
}

ShadowView flat_view(RandomScene& random) {
    ShadowView view;
    const glm::dmat3 axes = math::basis_from_back(random.direction());
    view.pose.axis_u = axes[0];
    view.pose.axis_v = axes[1];
    view.pose.axis_back = axes[2];
    view.plane.texel_u = view.plane.texel_v = 0.01;
    view.error.metre_px = 1.0;
    return view;
}

ShadowView lamp_view(RandomScene& random) {
    const glm::dmat3 axes = math::basis_from_back(random.direction());
    const glm::dvec2 low(random.number(-1.5, 0.0), random.number(-1.5, 0.0));
    ShadowView view = perspective_view(random.vector(3.0), axes, {low, low + 1.5}, {0.1, 100.0}, 512.0);
    view.error.metre_px = 1.0;
    view.error.extent_px = glm::length(glm::dvec2(view.plane.texel_u, view.plane.texel_v));  // a tangent is a pixel
    return view;
}

/// Computes the point's place in the view: x and y across, z along.
glm::dvec3 in_view(const ShadowView& view, const glm::dvec3& p) {
    const glm::dvec3 d = p - view.pose.anchor_ws_m;
    return {glm::dot(d, view.pose.axis_u), glm::dot(d, view.pose.axis_v), -glm::dot(d, view.pose.axis_back)};
}
bool in_map(const ShadowView& view, const glm::dvec2& tangent) {
    return glm::all(glm::greaterThanEqual(tangent, view.plane.tan_low)) &&
           glm::all(glm::lessThanEqual(tangent, view.plane.tan_high));
}

TEST(CasterShift, HoldsWhateverAnyPointOfACasterMoves) {
    RandomPlacements moves(print_seed());
    RandomScene& random = moves.random;
    int judged = 0;
    for (int round = 0; round < 2000; ++round) {
        const math::Aabb box_ms{-glm::abs(random.vector(1.0)) - 0.1, glm::abs(random.vector(1.0)) + 0.1};
        const Placement from = moves.anywhere(10.0);
        const Placement to = moves.moved(from, random.number(0.0, 1.0), random.number(0.0, 0.5));
        const InstanceItem before = item_at(box_ms, from, 1), after = item_at(box_ms, to, 2);
        const ShadowView views[] = {flat_view(random), lamp_view(random)};
        for (const ShadowView& view : views) {
            const bool flat = view.projection == ViewProjection::orthographic;
            const CasterShift shift = caster_shift(view, shown_of(before), after, nullptr);
            for (int k = 0; k < 40 && shift.across < kInfinity; ++k) {
                glm::dvec3 p_ms = random_point(random, box_ms);
                if (k < 8) p_ms = math::corners(box_ms)[static_cast<std::size_t>(k)];
                const glm::dvec3 p0 = from.basis * p_ms + from.translation_m, p1 = to.basis * p_ms + to.translation_m;
                EXPECT_LE(glm::distance(p0, p1), shift.any_m * (1.0 + 1e-12) + 1e-12);
                const glm::dvec3 q0 = in_view(view, p0), q1 = in_view(view, p1);
                const glm::dvec2 at0 = glm::dvec2(q0) / (flat ? 1.0 : q0.z), at1 = glm::dvec2(q1) / (flat ? 1.0 : q1.z);
                if (!flat && !in_map(view, at0) && !in_map(view, at1)) continue;
                EXPECT_LE(glm::distance(at0, at1), shift.across * (1.0 + 1e-9) + 1e-12);
                ++judged;
            }
        }
    }
    EXPECT_GT(judged, 20000);
}

TEST(CasterShift, IsTheWayOfWhatIsMovedAlone) {
    RandomScene random(print_seed());
    for (int round = 0; round < 100; ++round) {
        const math::Aabb box_ms{glm::dvec3(-1.0), glm::dvec3(1.0)};
        const glm::dvec3 way = random.vector(2.0);
        const ShadowView view = flat_view(random);
        const CasterShift shift =
            caster_shift(view, shown_of(item_at(box_ms, {}, 1)), item_at(box_ms, {glm::dmat3(1.0), way}, 2), nullptr);
        const glm::dvec3 seen = in_view(view, way);
        EXPECT_NEAR(shift.any_m, glm::length(way), 1e-12);
        EXPECT_NEAR(shift.across, glm::length(glm::dvec2(seen)), 1e-12);
    }
}

TEST(CasterShift, CannotBeToldOfWhatHoldsALampOrHasNoVolumeOrBentAnew) {
    const math::Aabb box_ms{glm::dvec3(-1.0), glm::dvec3(1.0)};
    RandomScene random(print_seed());
    const ShadowView lamp = lamp_view(random), sun = flat_view(random);
    const InstanceItem around = item_at(box_ms, {glm::dmat3(1.0), lamp.pose.anchor_ws_m}, 1);
    const InstanceItem moved = item_at(box_ms, {glm::dmat3(1.0), lamp.pose.anchor_ws_m + 0.1}, 2);
    EXPECT_EQ(caster_shift(lamp, shown_of(around), moved, nullptr).across, kInfinity);
    EXPECT_LT(caster_shift(sun, shown_of(around), moved, nullptr).across, 1.0);
    const InstanceItem flat = item_at(box_ms, {glm::dmat3(0.0), glm::dvec3(0.0)}, 1);
    EXPECT_EQ(caster_shift(sun, shown_of(flat), moved, nullptr).any_m, kInfinity);
    const PoseItem pose{.since = 3};
    EXPECT_EQ(caster_shift(sun, shown_of(around), moved, &pose).any_m, kInfinity) << "it did not bend then";
    EXPECT_EQ(caster_shift(sun, shown_of(around), around, nullptr).any_m, 0.0);
}

TEST(CasterShift, CountsWhatAMeshBentSinceInItsInstancesOwnScale) {
    RandomScene random(print_seed());
    const ShadowView sun = flat_view(random);
    const math::Aabb box_ms{glm::dvec3(-1.0), glm::dvec3(1.0)};
    ShownCaster then = shown_of(item_at(box_ms, {glm::dmat3(2.0), glm::dvec3(0.0)}, 1));
    then.bends_since = 3;
    then.bent_m = 5.0;
    const PoseItem pose{.since = 3, .bent_m = 5.25};
    const CasterShift shift = caster_shift(sun, then, item_at(box_ms, {glm::dmat3(2.0), glm::dvec3(0.0)}, 2), &pose);
    EXPECT_GE(shift.any_m, 2.0 * 0.25);
    EXPECT_LE(shift.any_m, std::sqrt(3.0) * 2.0 * 0.25 + 1e-12) << "of three axes, the bound adds all";
    EXPECT_EQ(shift.any_m, shift.across);
}

class StaleViews : public ::testing::Test {
protected:
    void SetUp() override {
        view.error.metre_px = 4.0;
        view.static_casters = 1;
        for (std::uint32_t i = 0; i < 3; ++i) {
            InstanceItem item = item_at({glm::dvec3(-1.0), glm::dvec3(1.0)}, {glm::dmat3(1.0), glm::dvec3(5.0 * i)}, 1);
            item.gpu_slot = i;
            scene.instances.push_back(item);
        }
        remember(scene, std::span(casters).subspan(1), kStill, shown);
    }
    void move(std::uint32_t i, const glm::dvec3& way) {
        InstanceItem& item = scene.instances[i];
        item.translation_ws_m += way;
        item.bounds_ws = {item.bounds_ws.min + way, item.bounds_ws.max + way};
        ++item.version;
    }
    Staleness now() const { return staleness(scene, view, shown, kStill, casters); }

    static constexpr std::uint64_t kStill = 77;
    SceneSnapshot scene;
    ShadowView view;
    std::vector<std::uint32_t> casters{0, 1, 2};  // the first stands still
    ShownCasters shown;
};

TEST_F(StaleViews, AreOffByTheFarthestMoverAcrossTheLightAndByItsWholeWayAtContacts) {
    EXPECT_EQ(now().error_px, 0.0);
    move(1, {0.3, 0.4, 0.0});
    EXPECT_NEAR(now().moved_m, 0.5, 1e-12);
    EXPECT_NEAR(now().error_px, 4.0 * (0.5 + 0.5), 1e-12);
    move(2, {0.0, 0.0, 1.0});  // along the light
    EXPECT_NEAR(now().moved_m, 1.0, 1e-12);
    EXPECT_NEAR(now().error_px, 4.0 * (0.5 + 1.0), 1e-12);
}

TEST_F(StaleViews, AreOffByNobodyKnowsWhatWhereOthersAreThereOrStillOnesChanged) {
    EXPECT_EQ(staleness(scene, view, shown, kStill + 1, casters).error_px, kInfinity);
    EXPECT_EQ(staleness(scene, view, shown, kStill, std::span(casters).first(2)).error_px, kInfinity);
    EXPECT_EQ(staleness(scene, view, {}, kStill, casters).error_px, kInfinity) << "nothing was remembered";
    scene.instances[2].gpu_slot = 9;
    EXPECT_EQ(now().error_px, kInfinity);
    scene.instances[2].gpu_slot = 2;
    scene.instances[2].mesh = 9;
    EXPECT_EQ(now().error_px, kInfinity);
    scene.instances[2].mesh = 0;
    EXPECT_EQ(now().error_px, 0.0);
    move(1, glm::dvec3(kInfinity));
    EXPECT_EQ(now().error_px, kInfinity);
    view.error.metre_px = 0.0;
    SetUp();
    view.error.metre_px = 0.0;
    EXPECT_EQ(now().error_px, kInfinity) << "nobody sees it, or it is warped";
}

TEST(MetrePx, IsTheTexelsExtentPerMetreOfATexel) {
    RandomScene random(print_seed());
    int suns = 0;
    for (int round = 0; round < 50; ++round) {
        const ShadowFrame frame = fitted(random.scene(LightKind::directional));
        for (const ShadowView& view : frame.fitted.views) {
            if (view.error.texel_m == 0.0) continue;
            EXPECT_NEAR(view.error.metre_px * view.error.texel_m, view.error.extent_px, 1e-9 * view.error.extent_px);
            ++suns;
        }
    }
    EXPECT_GT(suns, 50);
}

}  // namespace
}  // namespace gnomon::shadow
