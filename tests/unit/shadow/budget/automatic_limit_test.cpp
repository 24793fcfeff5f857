#include "systems/shadow/budget/automatic_limit.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "systems/shadow/budget/allocate_quality.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {
namespace {

ConsumerItem camera(std::uint32_t width_px, std::uint32_t height_px) {
    ConsumerItem consumer;
    consumer.viewport_px = {width_px, height_px};
    return consumer;
}

TEST(AutomaticLimit, GrowsWithPixelsFrom1080pOn) {
    EXPECT_EQ(automatic_limit({}), kAutomatic_bytes);
    EXPECT_EQ(automatic_limit(std::array{camera(320, 180)}), kAutomatic_bytes) << "a small picture needs no less";
    EXPECT_EQ(automatic_limit(std::array{camera(1920, 1080)}), kAutomatic_bytes);
    EXPECT_EQ(automatic_limit(std::array{camera(3840, 2160)}), 4 * kAutomatic_bytes);
    EXPECT_EQ(automatic_limit(std::array{camera(1920, 1080), camera(1920, 1080)}), 2 * kAutomatic_bytes);
    EXPECT_LT(automatic_limit(std::array{camera(16384, 16384)}), BudgetLimits::kNone);
}

TEST(AutomaticLimit, IsForLightsThatLeaveSizeAndAccuracy) {
    LightItem light;
    EXPECT_TRUE(leaves_size(light));
    light.shadow.resolution_px = 512;
    EXPECT_FALSE(leaves_size(light));
    light.shadow = {};
    light.shadow.max_error_px = 0.5f;
    EXPECT_FALSE(leaves_size(light));
    light.shadow = {};
    light.shadow.narrowest_caster_px = 2.0f;
    EXPECT_FALSE(leaves_size(light));
    light.shadow = {};
    light.shadow.max_error_px = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(leaves_size(light)) << "as no target (targets_of)";
    light.shadow.max_error_px = -1.0f;
    EXPECT_TRUE(leaves_size(light));
}

TEST(AutomaticLimit, CountsMapsOfLightsWithViews) {
    SceneSnapshot scene;
    scene.lights.resize(5);
    for (LightItem& light : scene.lights) light.kind = LightKind::spot;
    scene.lights[1].shadow.resolution_px = 256;
    FittedViews fitted;
    fitted.lights.resize(scene.lights.size());
    std::uint32_t edge_px = 256;
    for (std::size_t i = 0; i < scene.lights.size(); ++i, edge_px += 256) {
        FitChoice& choice = fitted.lights[i];
        choice.request.map.view_count = 1;
        set_resolution(scene.lights[i], edge_px, choice.request);
        choice.views = {static_cast<std::uint32_t>(i), 1};
    }
    fitted.lights[2].views.count = 0;
    fitted.lights[3].request.skip = Reason::shadows_off;
    std::vector<LightStatus> statuses(scene.lights.size());
    const auto bytes_of = [&](std::size_t i) { return map_bytes(scene.lights[i], fitted.lights[i].request); };
    ASSERT_GT(bytes_of(0), 0u);
    const WantedBytes all = wanted_bytes(scene, fitted, statuses);
    EXPECT_EQ(all.limited, bytes_of(0) + bytes_of(4));
    EXPECT_EQ(all.given, bytes_of(1));
    statuses[4].skip(Reason::below_display_step);
    EXPECT_EQ(wanted_bytes(scene, fitted, statuses).limited, bytes_of(0));
}

TEST(AutomaticLimit, IsNoLimitOfTheBudgetItself) {
    EXPECT_EQ(limits_of({}).bytes, BudgetLimits::kNone);
    EXPECT_EQ(limits_of({ShadowBudget::kUnlimited}).bytes, BudgetLimits::kNone);
}

}  // namespace
}  // namespace gnomon::shadow
