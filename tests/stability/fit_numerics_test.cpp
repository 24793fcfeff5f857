#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/shadow/in_map.h"
#include "tests/unit/shadow/random_scene.h"

/// The fits do not care how large the world is or where it lies, and stay finite whatever they are given.
namespace gnomon::shadow {
namespace {

class FitNumerics : public ::testing::TestWithParam<LightKind> {};

/// Returns map coordinates that stay the same when the map is turned by quarters. A sun's rectangle may start from any
/// of its sides, and rounding decides which. What lies where in the map, and how deep, is the same.
glm::dvec3 folded(const glm::dvec3& q) {
    const double x = std::abs(q.x - 0.5), y = std::abs(q.y - 0.5);
    return {std::min(x, y), std::max(x, y), q.z};
}

/// Returns how far floats may move a point in the map. A cascade's anchor may be eight of its longest sides away. The
/// matrix makes a few roundings (2^-24) of that distance. They count relative to the shortest of its sides.
double tolerance(const ShadowView& view) {
    constexpr double kAnchor = 8.0, kRoundings = 10.0, kPerspective = 5e-5;
    if (view.projection != ViewProjection::orthographic) return kPerspective;
    const glm::dvec2 sides = 2.0 * view.plane.half_extent_m;
    const double depth = view.depth.far_m - view.depth.near_m;
    return kRoundings * kAnchor * 0x1p-24 * std::max({sides.x, sides.y, depth}) / std::min({sides.x, sides.y, depth});
}

/// Expects of the scene placed elsewhere the same sets, the same views, and everything at the same place in their maps.
void expect_same(const SceneSnapshot& scene, double scale, const glm::dvec3& offset) {
    SceneSnapshot other = scene;
    place(other, scale, offset);
    const ShadowFrame a = fitted(scene), b = fitted(other);
    EXPECT_EQ(a.sets.receiver_items, b.sets.receiver_items);
    EXPECT_EQ(a.sets.caster_items, b.sets.caster_items);
    EXPECT_EQ(a.fitted.casters, b.fitted.casters);
    ASSERT_EQ(a.fitted.views.size(), b.fitted.views.size());
    for (std::size_t v = 0; v < a.fitted.views.size(); ++v) {
        double worst = 0.0;
        for (const glm::dvec3& p : a.sets.receiver_points_ws) {
            const glm::dvec3 at = in_map(a.fitted.views[v], p), there = folded(in_map(b.fitted.views[v], p * scale + offset));
            if (std::abs(at.x - 0.5) > 0.5 || std::abs(at.y - 0.5) > 0.5 || at.z < 0.0 || at.z > 1.0) continue;
            for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(folded(at)[i] - there[i]));
        }
        EXPECT_LE(worst, tolerance(a.fitted.views[v])) << "view " << v;
    }
}

TEST_P(FitNumerics, AScaleByAPowerOfTwoGivesTheSameMapCoordinates) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        const SceneSnapshot scene = random.scene(GetParam());
        for (const int power : {-13, -4, 3, 20}) {
            SCOPED_TRACE("round " + std::to_string(round) + ", power " + std::to_string(power));
            expect_same(scene, std::exp2(power), glm::dvec3(0.0));
        }
    }
}

TEST_P(FitNumerics, AMillionMetresAwayTheMapCoordinatesAreTheSame) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        SceneSnapshot scene = random.scene(GetParam());
        scene.lights[0].tuning.cascades.fit = ShadowFit::tight;  // the others lie on lattices of the world
        expect_same(scene, 1.0, glm::dvec3(1e6, -1e6, 1e6));
    }
}

/// Makes a wall edge-on to a high sun, seen from aside through a narrow lens. A roof is over it, and beside it a post
/// that darkens nothing of it.
SceneSnapshot wall_edge_on(const glm::dvec3& at, std::uint32_t cascades) {
    SceneSnapshot s = RandomScene(1).scene(LightKind::directional, 3);
    const math::Aabb wall{{0, -2, -2}, {0, 2, 2}}, roof{{-10, 3, -10}, {10, 4, 10}}, post{{12, -2, -1}, {13, 4, 1}};
    for (std::uint32_t i = 0; i < s.instances.size(); ++i) {
        s.instances[i].bounds_ws = std::array{wall, roof, post}[i];
        s.instances[i].casts = !(s.instances[i].receives = s.instances[i].visible = i == 0);
    }
    s.consumers[0].position_ws_m = {-1.5, -0.4, -0.3};
    s.consumers[0].rotation_ws = math::basis_from_back(s.consumers[0].position_ws_m);
    s.consumers[0].fov_y_rad = 0.04;
    s.lights[0].rotation_ws = math::basis_from_back({0, 1, 0});
    s.lights[0].shadow.cascades = cascades;
    s.lights[0].tuning.cascades.fit = ShadowFit::tight;
    place(s, 1.0, at);
    return s;
}

TEST(FarFromTheOrigin, AWallEdgeOnToTheSunKeepsItsCasters) {
    for (const double away_m : {0.0, 1e3, 1e5, 4e6, 1e7})
        for (const std::uint32_t cascades : {1u, 4u, 7u}) {
            SCOPED_TRACE(std::to_string(away_m) + " m away, cascades " + std::to_string(cascades));
            const ShadowFrame frame = fitted(wall_edge_on(away_m * glm::dvec3(1.0, -1.0, 0.25), cascades));
            ASSERT_EQ(frame.fitted.views.size(), cascades);
            for (const ShadowView& view : frame.fitted.views) {
                ASSERT_EQ(view.casters.count, 1u);
                EXPECT_EQ(frame.fitted.casters[view.casters.first], 1u);
            }
        }
}

bool finite(const ShadowView& view) {
    bool all = std::isfinite(view.depth.near_m) && std::isfinite(view.depth.far_m) && std::isfinite(view.plane.texel_u + view.plane.texel_v) &&
               std::isfinite(view.error.edge_px);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) all = all && std::isfinite(view.clip_from_anchor[c][r]) && std::isfinite(view.map_from_anchor[c][r]);
    return all;
}

TEST_P(FitNumerics, DegenerateInputGivesFiniteViewsOrAReason) {
    const std::vector<std::pair<const char*, void (*)(SceneSnapshot&)>> cases = {
        {"points for boxes", [](SceneSnapshot& s) { for (auto& i : s.instances) i.bounds_ws.max = i.bounds_ws.min; }},
        {"all in one point", [](SceneSnapshot& s) { for (auto& i : s.instances) i.bounds_ws = {glm::dvec3(1.0), glm::dvec3(1.0)}; }},
        {"a line", [](SceneSnapshot& s) { for (auto& i : s.instances) i.bounds_ws = {glm::dvec3(-5, 0, 0), glm::dvec3(5, 0, 0)}; }},
        {"a plane", [](SceneSnapshot& s) { for (auto& i : s.instances) i.bounds_ws = {glm::dvec3(-5, 0, -5), glm::dvec3(5, 0, 5)}; }},
        {"tiny", [](SceneSnapshot& s) { place(s, 1e-4, glm::dvec3(0.0)); }},
        {"huge", [](SceneSnapshot& s) { place(s, 1e8, glm::dvec3(0.0)); }},
        {"far", [](SceneSnapshot& s) { place(s, 1.0, glm::dvec3(1e8)); }},
        {"light in a receiver's corner", [](SceneSnapshot& s) { s.lights[0].position_ws_m = s.instances[1].bounds_ws.min; }},
        {"narrow cone", [](SceneSnapshot& s) { s.lights[0].outer_cone_rad = 1e-4; }},
        {"widest cone", [](SceneSnapshot& s) { s.lights[0].outer_cone_rad = 1.5707963267948966; }},
        {"short range", [](SceneSnapshot& s) { s.lights[0].range_m = 1e-6; }},
        {"smallest map", [](SceneSnapshot& s) { s.lights[0].shadow.resolution_px = 1; }},
        {"infinite far plane", [](SceneSnapshot& s) { s.consumers[0].far_m = std::numeric_limits<double>::infinity(); }},
        {"light straight down", [](SceneSnapshot& s) { s.lights[0].rotation_ws = math::basis_from_back({0, 1, 0}); }},
        {"everything around everything", [](SceneSnapshot& s) { for (auto& i : s.instances) i.bounds_ws = {glm::dvec3(-50.0), glm::dvec3(50.0)}; }},
    };
    RandomScene random(print_seed());
    int views = 0;
    for (int round = 0; round < 10; ++round) {
        const SceneSnapshot scene = random.scene(GetParam());
        for (const auto& [name, edit] : cases) {
            SceneSnapshot odd = scene;
            edit(odd);
            const ShadowFrame frame = fitted(odd);
            EXPECT_EQ(frame.fitted.views.empty(), frame.statuses.at(0).skipped() != Reason::none) << name;
            for (const ShadowView& view : frame.fitted.views) EXPECT_TRUE(finite(view)) << name;
            views += static_cast<int>(frame.fitted.views.size());
        }
    }
    EXPECT_GT(views, 10);
}

TEST_P(FitNumerics, TheSameInputGivesTheSameBits) {
    RandomScene random(print_seed());
    const SceneSnapshot scene = random.scene(GetParam());
    const ShadowFrame a = fitted(scene), b = fitted(scene);
    ASSERT_EQ(a.fitted.views.size(), b.fitted.views.size());
    for (std::size_t v = 0; v < a.fitted.views.size(); ++v) EXPECT_EQ(a.fitted.views[v].clip_from_anchor, b.fitted.views[v].clip_from_anchor);
}

INSTANTIATE_TEST_SUITE_P(EachKind, FitNumerics, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

}  // namespace
}  // namespace gnomon::shadow
