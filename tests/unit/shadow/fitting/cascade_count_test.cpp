#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <vector>

#include "systems/shadow/request/accuracy_target.h"
#include "tests/unit/shadow/random_scene.h"

/// How many maps a sun gets.
namespace gnomon::shadow {
namespace {

std::uint32_t chosen(std::vector<double> predicted_px, std::vector<std::uint64_t> texels, std::uint32_t previous = 0) {
    std::vector<CascadeTrial> trials;
    for (std::uint32_t i = 0; i < texels.size(); ++i) trials.push_back({1u << i, predicted_px[i], texels[i]});
    return choose_cascades(trials, previous, 1.0);
}

TEST(ContractCascades, AreTheFewestThatMeetTheTargetWithNoMoreTexels) {
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {400, 200, 400}), 1u);
    EXPECT_EQ(chosen({1.9, 2.1, 1.9}, {401, 200, 400}), 4u);
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {401, 300, 400}), 2u);
}

TEST(ContractCascades, StayWhileTheyTakeLessThanTwiceTheTexelsAndMeetTheTarget) {
    EXPECT_EQ(chosen({2.1, 1.9, 1.9}, {1, 799, 400}, 2), 2u);
    EXPECT_EQ(chosen({2.1, 1.9, 1.9}, {1, 800, 400}, 2), 4u);
    EXPECT_EQ(chosen({2.1, 2.1, 1.9}, {1, 799, 400}, 2), 4u);
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {400, 799, 400}, 2), 1u) << "fewer do";
}

/// Counts errors beyond a pixel: that pixel is the picture's own, and no map takes it away.
TEST(ContractCascades, WhereNoneMeetTheTargetEachDoublingHalvesTheErrorOfTheSameTexelsOrIsLeft) {
    // Twice as many maps of one size have twice the texels, which of themselves divide the error by the root of 2.
    const std::vector<std::uint64_t> same{100, 200, 400};
    EXPECT_EQ(chosen({17.0, 6.7, 3.1}, same), 1u);
    EXPECT_EQ(chosen({17.0, 6.6, 3.1}, same), 2u);
    EXPECT_EQ(chosen({17.0, 6.7, 2.9}, same), 4u) << "both together";
    constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(chosen({kInf, 1e9, kInf}, same), 2u);
    EXPECT_EQ(chosen({kNan, kNan, 1e9}, same), 4u);
    EXPECT_EQ(chosen({kNan, kNan, kNan}, same), 1u);
}

TEST(ContractCascades, StayWhileAnotherNumberIsHardlyBetter) {
    const std::vector<std::uint64_t> same{100, 200, 400};
    EXPECT_EQ(chosen({17.0, 6.6, 3.1}, same), 2u);
    EXPECT_EQ(chosen({17.0, 6.6, 3.1}, same, 1), 1u);
    EXPECT_EQ(chosen({24.0, 6.6, 4.1}, same, 1), 2u);
    EXPECT_EQ(chosen({17.0, 6.6, 3.7}, same, 4), 4u) << "16 by 4 maps: 21.6";
    EXPECT_EQ(chosen({17.0, 6.6, 2.5}, same, 2), 2u) << "12 by 4 maps: 15.8 by 2";
}

class CountedCascades : public ::testing::Test {
protected:
    /// Makes ground and casters that a sun lights: small and far away, or close by with all behind.
    static SceneSnapshot scene(double near_m, double far_m) {
        SceneSnapshot s;
        const auto add = [&](const glm::dvec3& centre, const glm::dvec3& half, bool casts) {
            InstanceItem item;
            item.bounds_ws = {centre - half, centre + half};
            item.casts = casts;
            item.gpu_slot = static_cast<std::uint32_t>(s.instances.size());
            s.instances.push_back(item);
        };
        const double middle_m = 0.5 * (near_m + far_m), length_m = 0.5 * (far_m - near_m);
        add({0.0, -1.0, -middle_m}, {0.5 * far_m, 0.1, length_m}, false);
        for (double z_m = near_m; z_m < far_m; z_m += 0.05 * (far_m - near_m))
            add({0.2, 0.0, -z_m}, glm::dvec3(0.1), true);
        ConsumerItem camera;
        camera.viewport_px = {640, 360};
        s.consumers.push_back(camera);
        LightItem sun;
        sun.entity = {1, 0};
        sun.kind = LightKind::directional;
        sun.intensity = 1.0f;
        sun.has_shadow = true;
        sun.shadow.filter = ShadowFilter::hard;
        sun.rotation_ws = math::basis_from_back({0.3, 1.0, 0.2});
        s.lights.push_back(sun);
        return s;
    }
    static double predicted_px(const ShadowFrame& frame) {
        double worst = 0.0;
        for (const ShadowView& view : frame.fitted.views) worst = std::max(worst, view.error.texel_edge_px);
        return worst;
    }
    static std::uint64_t texels(const ShadowFrame& frame) {
        const std::uint64_t edge_px = frame.fitted.lights[0].request.map.resolution_px;
        return edge_px * edge_px * frame.fitted.lights[0].request.map.view_count;
    }
};

TEST_F(CountedCascades, AreFewWhereAllThatIsSeenIsAsFarAndNeverCostMoreTexelsOrTheWord) {
    int fewer = 0;
    for (const double far_m : {20.5, 21.0, 25.0, 40.0, 200.0})
        for (const float wish_px : {1.0f, 2.0f, 4.0f}) {
            SceneSnapshot s = scene(20.0, far_m);
            s.lights[0].shadow.max_error_px = wish_px;
            const ShadowFrame chosen = fitted(s);
            ASSERT_FALSE(chosen.fitted.views.empty());
            s.lights[0].shadow.cascades = 4;
            const ShadowFrame four = fitted(s);
            EXPECT_LE(texels(chosen), texels(four)) << far_m;
            if (meets_target(predicted_px(four), wish_px)) {
                EXPECT_TRUE(meets_target(predicted_px(chosen), wish_px)) << far_m;
            }
            fewer += chosen.fitted.lights[0].request.map.view_count < 4 ? 1 : 0;
            EXPECT_EQ(fitted(s).next_history.lights[0].count.cascades, 0u) << "a number that is given is no choice";
        }
    EXPECT_GT(fewer, 5);
}

TEST_F(CountedCascades, StayWhileTheCameraSwaysAndComeToRest) {
    for (const double far_m : {20.5, 25.0, 200.0}) {
        SceneSnapshot s = scene(20.0, far_m);
        s.lights[0].shadow.max_error_px = 4.0f;
        History previous;
        std::uint32_t changes = 0, last = 0;
        for (int f = 0; f < 200; ++f) {
            s.consumers[0].position_ws_m.z = 0.3 * std::sin(0.9 * f);
            const ShadowFrame frame = fitted(s, previous);
            previous = frame.next_history;
            changes += f > 0 && last != frame.fitted.lights[0].request.map.view_count ? 1 : 0;
            last = frame.fitted.lights[0].request.map.view_count;
        }
        EXPECT_LE(changes, 1u) << far_m;
        for (int f = 0; f < 3; ++f) previous = fitted(s, previous).next_history;
        EXPECT_TRUE(fitted(s, previous).next_history == previous) << far_m;
    }
}

TEST_F(CountedCascades, HardlyChangeOverRandomScenesWhileTheCameraSways) {
    RandomScene random(print_seed());
    int changes = 0, fewer = 0, scenes = 0;
    for (int i = 0; i < 40; ++i) {
        SceneSnapshot s = random.scene(LightKind::directional);
        s.lights[0].shadow = {.filter = ShadowFilter::triangles, .max_error_px = 4.0f};
        const glm::dvec3 from = s.consumers[0].position_ws_m;
        History previous;
        std::uint32_t last = 0;
        for (int f = 0; f < 120; ++f) {
            s.consumers[0].position_ws_m = from * (1.0 + 0.02 * std::sin(0.9 * f));  // seven frames to and fro
            const ShadowFrame frame = fitted(s, previous);
            previous = frame.next_history;
            if (frame.fitted.views.empty()) continue;
            changes += last > 0 && last != frame.fitted.lights[0].request.map.view_count ? 1 : 0;
            last = frame.fitted.lights[0].request.map.view_count;
        }
        scenes += last > 0 ? 1 : 0;
        fewer += last > 0 && last < 4 ? 1 : 0;
    }
    std::cout << fewer << " of " << scenes << " scenes have fewer than four; " << changes << " changes\n";
    EXPECT_LE(changes, scenes / 2) << "in two seconds each; 0 to 7 over thirty seeds";
}

TEST_F(CountedCascades, AreMoreAtOnceWhereTheWordWouldBeBroken) {
    SceneSnapshot s = scene(20.0, 20.5);
    s.lights[0].shadow.max_error_px = 4.0f;
    ShadowFrame frame = fitted(s);
    ASSERT_LT(frame.fitted.lights[0].request.map.view_count, 4u);
    s.consumers[0].position_ws_m.z = -19.0;
    frame = fitted(s, frame.next_history);
    SceneSnapshot four = s;
    four.lights[0].shadow.cascades = 4;
    if (meets_target(predicted_px(fitted(four)), 4.0)) {
        EXPECT_TRUE(meets_target(predicted_px(frame), 4.0));
    } else {
        EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, 4u);
    }
}

TEST_F(CountedCascades, AreFourWhereTheirEndsOrTheirSizeAreGiven) {
    for (int i = 0; i < 3; ++i) {
        SceneSnapshot s = scene(20.0, 20.5);
        LightItem& light = s.lights[0];
        light.shadow.max_error_px = 4.0f;
        if (i == 0) light.shadow.resolution_px = 512;
        if (i == 1) light.tuning.cascades.fit = ShadowFit::stable;
        if (i == 2) light.tuning.cascades = {.splits = CascadeSplits::manual, .split_m = {20.1f, 20.2f, 20.3f}};
        EXPECT_EQ(fitted(s).fitted.lights[0].request.map.view_count, 4u) << i;
    }
}

}  // namespace
}  // namespace gnomon::shadow
