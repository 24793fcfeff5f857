#include <gtest/gtest.h>

#include <limits>

#include "systems/shadow/light_kinds.h"
#include "tests/unit/shadow/random_scene.h"

/// The fits do not care how large the world is or where it lies, and stay finite whatever they are given.
namespace gnomon::shadow {
namespace {

class FitNumerics : public ::testing::TestWithParam<LightKind> {};

glm::dvec3 in_map(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p_ws - view.anchor_ws_m), 1.0f);
    return glm::dvec3(q) / static_cast<double>(q.w);
}

/// Map coordinates but for a turn of the map by quarters: a sun's rectangle may start from any of its sides, and rounding
/// decides which. What lies where in the map, and how deep, is the same.
glm::dvec3 folded(const glm::dvec3& q) {
    const double x = std::abs(q.x - 0.5), y = std::abs(q.y - 0.5);
    return {std::min(x, y), std::max(x, y), q.z};
}

/// The largest difference of map coordinates between a scene and the same scene placed elsewhere. -1: other views.
double difference(const SceneSnapshot& scene, double scale, const glm::dvec3& offset) {
    SceneSnapshot other = scene;
    place(other, scale, offset);
    const ShadowFrame a = fitted(scene), b = fitted(other);
    if (a.views.size() != b.views.size() || a.caster_items != b.caster_items || a.receiver_items != b.receiver_items) return -1.0;
    double worst = 0.0;
    for (std::size_t v = 0; v < a.views.size(); ++v)
        for (const glm::dvec3& p : a.receiver_points_ws) {
            const glm::dvec3 at = in_map(a.views[v], p), there = folded(in_map(b.views[v], p * scale + offset));
            if (std::abs(at.x - 0.5) > 0.5 || std::abs(at.y - 0.5) > 0.5 || at.z < 0.0 || at.z > 1.0) continue;
            for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(folded(at)[i] - there[i]));
        }
    return worst;
}

TEST_P(FitNumerics, AScaleByAPowerOfTwoGivesTheSameMapCoordinates) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        const SceneSnapshot scene = random.scene(GetParam());
        for (const int power : {-13, -4, 3, 20}) {
            const double d = difference(scene, std::exp2(power), glm::dvec3(0.0));
            EXPECT_GE(d, 0.0) << "power " << power;
            EXPECT_LE(d, 1e-6) << "power " << power;
        }
    }
}

TEST_P(FitNumerics, AMillionMetresAwayTheMapCoordinatesAreTheSame) {
    // A sun's anchor may be eight map widths away, and its depth range a tenth of one: 80 roundings of 2^-24, a few times.
    constexpr double kTolerance = 5e-5;
    // Where two of a sun's sides are equally good and the hull's first corner is a tie as well, rounding may still
    // choose. About one spot's scene in 150 comes to other sets there, as measured over 300 seeds; why is not known.
    const int ties = GetParam() == LightKind::directional ? 3 : 1;
    const glm::dvec3 offset(1e6, -1e6, 1e6);
    RandomScene random(print_seed());
    int other_choice = 0;
    for (int round = 0; round < 60; ++round) {
        SceneSnapshot scene = random.scene(GetParam());
        const double d = difference(scene, 1.0, offset);
        if (!(d >= 0.0 && d <= kTolerance)) ++other_choice;
        if (d < 0.0) continue;
        const ShadowFrame here = fitted(scene);
        place(scene, 1.0, offset);
        const ShadowFrame there = fitted(scene);
        for (std::size_t v = 0; v < here.views.size(); ++v)
            EXPECT_NEAR(there.views[v].texel_u * there.views[v].texel_v / (here.views[v].texel_u * here.views[v].texel_v), 1.0, 1e-5);
    }
    EXPECT_LE(other_choice, ties);
}

bool finite(const ShadowView& view) {
    bool all = std::isfinite(view.near_m) && std::isfinite(view.far_m) && std::isfinite(view.texel_u + view.texel_v) &&
               std::isfinite(view.predicted_error_px);
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
            EXPECT_EQ(frame.views.empty(), frame.sets.at(0).skip != Reason::none) << name;
            for (const ShadowView& view : frame.views) EXPECT_TRUE(finite(view)) << name;
            views += static_cast<int>(frame.views.size());
        }
    }
    EXPECT_GT(views, 10);
}

TEST_P(FitNumerics, TheSameInputGivesTheSameBits) {
    RandomScene random(print_seed());
    const SceneSnapshot scene = random.scene(GetParam());
    const ShadowFrame a = fitted(scene), b = fitted(scene);
    ASSERT_EQ(a.views.size(), b.views.size());
    for (std::size_t v = 0; v < a.views.size(); ++v) EXPECT_EQ(a.views[v].clip_from_anchor, b.views[v].clip_from_anchor);
}

INSTANTIATE_TEST_SUITE_P(EachKind, FitNumerics, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

}  // namespace
}  // namespace gnomon::shadow
