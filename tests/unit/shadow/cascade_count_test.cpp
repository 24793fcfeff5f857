#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <vector>

#include "systems/shadow/contract.h"
#include "tests/unit/shadow/random_scene.h"

/// How many maps a sun gets, and how they share their texels.
namespace gnomon::shadow {
namespace {

TEST(SharedTexels, AreNeverMoreThanFourMapsHaveAndNearlyAsMany) {
    for (std::uint32_t edge_px = kLeastMap_px; edge_px <= 4096; edge_px += kLeastMap_px) {
        const std::uint64_t all = std::uint64_t{4} * edge_px * edge_px;
        EXPECT_EQ(shared_edge_px(edge_px, 1), 2 * edge_px);
        EXPECT_EQ(shared_edge_px(edge_px, 4), edge_px);
        for (std::uint32_t count = 1; count <= 4; ++count) {
            const std::uint64_t shared_px = shared_edge_px(edge_px, count), next_px = shared_px + kLeastMap_px;
            EXPECT_EQ(shared_px % kLeastMap_px, 0u);
            EXPECT_LE(count * shared_px * shared_px, all) << edge_px << " " << count;
            EXPECT_GT(count * next_px * next_px, all) << edge_px << " " << count;
            for (std::uint32_t other = 1; other <= 4; ++other)
                EXPECT_EQ(edge_for_count_px(static_cast<std::uint32_t>(shared_px), count, other),
                          shared_edge_px(edge_px, other));
        }
    }
}

/// A budget may leave any size.
TEST(SharedTexels, AreNoMoreForMoreMapsAndForTheSameNumberTheSame) {
    for (const std::uint32_t edge_px : {1u, 16u, 200u, 256u, 300u, 512u, 1000u, 2816u, 16384u})
        for (std::uint32_t of = 1; of <= 4; ++of)
            for (std::uint32_t count = of; count <= 4; ++count) {
                const std::uint32_t px = edge_for_count_px(edge_px, of, count);
                EXPECT_LE(px, edge_px);
                EXPECT_GE(px, std::min(edge_px, kLeastMap_px));
                if (count == of) {
                    EXPECT_EQ(px, edge_px);
                }
            }
}

std::uint32_t chosen(std::vector<double> predicted_px, std::vector<std::uint64_t> texels, std::uint32_t held = 0) {
    std::vector<CascadeTrial> trials;
    for (std::uint32_t i = 0; i < texels.size(); ++i) trials.push_back({1u << i, predicted_px[i], texels[i]});
    return contract_cascades(trials, held, 1.0);
}

TEST(ContractCascades, AreTheFewestThatKeepTheWordWithNoMoreTexels) {
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {400, 200, 400}), 1u);
    EXPECT_EQ(chosen({1.9, 2.1, 1.9}, {401, 200, 400}), 4u);
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {401, 300, 400}), 2u);
}

TEST(ContractCascades, StayWhileTheyTakeLessThanTwiceTheTexelsAndKeepTheWord) {
    EXPECT_EQ(chosen({2.1, 1.9, 1.9}, {1, 799, 400}, 2), 2u);
    EXPECT_EQ(chosen({2.1, 1.9, 1.9}, {1, 800, 400}, 2), 4u);
    EXPECT_EQ(chosen({2.1, 2.1, 1.9}, {1, 799, 400}, 2), 4u);
    EXPECT_EQ(chosen({1.9, 1.9, 1.9}, {400, 799, 400}, 2), 1u) << "fewer do";
}

/// Beside a pixel of the picture's own, which no map takes away.
TEST(ContractCascades, WhereNoneKeepTheWordEachDoublingHalvesTheErrorOrIsLeft) {
    const std::vector<std::uint64_t> same{400, 400, 400};
    EXPECT_EQ(chosen({9.0, 5.1, 3.1}, same), 1u);
    EXPECT_EQ(chosen({9.2, 5.0, 3.1}, same), 2u);
    EXPECT_EQ(chosen({9.2, 5.1, 3.0}, same), 4u) << "both together";
    constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(chosen({kInf, 1e9, kInf}, same), 2u);
    EXPECT_EQ(chosen({kNan, kNan, 1e9}, same), 4u);
    EXPECT_EQ(chosen({kNan, kNan, kNan}, same), 1u);
}

TEST(ContractCascades, StayWhileAnotherNumberIsHardlyBetter) {
    const std::vector<std::uint64_t> same{400, 400, 400};
    EXPECT_EQ(chosen({9.2, 5.0, 3.1}, same, 1), 1u);
    EXPECT_EQ(chosen({12.4, 5.0, 4.1}, same, 1), 2u);
    EXPECT_EQ(chosen({9.2, 5.0, 3.7}, same, 4), 4u);
    EXPECT_EQ(chosen({9.2, 5.0, 3.9}, same, 2), 2u);
}

class CountedCascades : public ::testing::Test {
protected:
    /// A small thing far away, or close by with all behind it: what a sun's light falls on.
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
        for (const ShadowView& view : frame.views) worst = std::max(worst, view.predicted_error_px);
        return worst;
    }
    static std::uint64_t texels(const ShadowFrame& frame) {
        const std::uint64_t edge_px = frame.demands[0].resolution_px;
        return edge_px * edge_px * frame.demands[0].view_count;
    }
};

TEST_F(CountedCascades, AreFewWhereAllThatIsSeenIsAsFarAndNeverCostMoreTexelsOrTheWord) {
    int fewer = 0;
    for (const double far_m : {20.5, 21.0, 25.0, 40.0, 200.0})
        for (const float wish_px : {1.0f, 2.0f, 4.0f}) {
            SceneSnapshot s = scene(20.0, far_m);
            s.lights[0].shadow.max_error_px = wish_px;
            const ShadowFrame chosen = fitted(s);
            ASSERT_FALSE(chosen.views.empty());
            s.lights[0].shadow.cascades = 4;
            const ShadowFrame four = fitted(s);
            EXPECT_LE(texels(chosen), texels(four)) << far_m;
            if (keeps_contract(predicted_px(four), wish_px)) {
                EXPECT_TRUE(keeps_contract(predicted_px(chosen), wish_px)) << far_m;
            }
            fewer += chosen.demands[0].view_count < 4 ? 1 : 0;
            EXPECT_EQ(fitted(s).next_history.lights[0].cascades, 0u) << "a number that is given is no choice";
        }
    EXPECT_GT(fewer, 5);
}

TEST_F(CountedCascades, StayWhileTheCameraSwaysAndComeToRest) {
    for (const double far_m : {20.5, 25.0, 200.0}) {
        SceneSnapshot s = scene(20.0, far_m);
        s.lights[0].shadow.max_error_px = 4.0f;
        History held;
        std::uint32_t changes = 0, last = 0;
        for (int f = 0; f < 200; ++f) {
            s.consumers[0].position_ws_m.z = 0.3 * std::sin(0.9 * f);
            const ShadowFrame frame = fitted(s, held);
            held = frame.next_history;
            changes += f > 0 && last != frame.demands[0].view_count ? 1 : 0;
            last = frame.demands[0].view_count;
        }
        EXPECT_LE(changes, 1u) << far_m;
        for (int f = 0; f < 3; ++f) held = fitted(s, held).next_history;
        EXPECT_TRUE(fitted(s, held).next_history == held) << far_m;
    }
}

TEST_F(CountedCascades, HardlyChangeOverRandomScenesWhileTheCameraSways) {
    RandomScene random(print_seed());
    int changes = 0, fewer = 0, scenes = 0;
    for (int i = 0; i < 40; ++i) {
        SceneSnapshot s = random.scene(LightKind::directional);
        s.lights[0].shadow = {};
        s.lights[0].shadow.max_error_px = 4.0f;
        const glm::dvec3 from = s.consumers[0].position_ws_m;
        History held;
        std::uint32_t last = 0;
        for (int f = 0; f < 120; ++f) {
            s.consumers[0].position_ws_m = from * (1.0 + 0.02 * std::sin(0.9 * f));  // seven frames to and fro
            const ShadowFrame frame = fitted(s, held);
            held = frame.next_history;
            if (frame.views.empty()) continue;
            changes += last > 0 && last != frame.demands[0].view_count ? 1 : 0;
            last = frame.demands[0].view_count;
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
    ASSERT_LT(frame.demands[0].view_count, 4u);
    s.consumers[0].position_ws_m.z = -19.0;
    frame = fitted(s, frame.next_history);
    SceneSnapshot four = s;
    four.lights[0].shadow.cascades = 4;
    if (keeps_contract(predicted_px(fitted(four)), 4.0)) {
        EXPECT_TRUE(keeps_contract(predicted_px(frame), 4.0));
    } else {
        EXPECT_EQ(frame.demands[0].view_count, 4u);
    }
}

TEST_F(CountedCascades, AreFourWhereTheirEndsOrTheirSizeAreGiven) {
    for (int i = 0; i < 3; ++i) {
        SceneSnapshot s = scene(20.0, 20.5);
        LightShadow& shadow = s.lights[0].shadow;
        shadow.max_error_px = 4.0f;
        if (i == 0) shadow.resolution_px = 512;
        if (i == 1) shadow.fit = ShadowFit::stable;
        if (i == 2) shadow.splits = CascadeSplits::manual, shadow.split_m = {20.1f, 20.2f, 20.3f};
        EXPECT_EQ(fitted(s).demands[0].view_count, 4u) << i;
    }
}

}  // namespace
}  // namespace gnomon::shadow
