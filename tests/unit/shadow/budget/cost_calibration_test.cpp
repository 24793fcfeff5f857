#include "systems/shadow/budget/cost_calibration.h"

#include <gtest/gtest.h>

#include "systems/frame_timers.h"
#include "systems/shadow/budget/cost_model.h"

namespace gnomon::shadow {
namespace {

constexpr double kPixels = 1000.0 * 1000.0;

/// Returns the factor that a clock learns for lighting. The light requests the exact filter, takes twice what the
/// model gives for `drawn`, and its report names `said`.
double learned_factor(ShadowFilter drawn, ShadowFilter said) {
    SceneSnapshot scene;
    scene.lights.resize(1);
    BudgetDecision decision;
    decision.request.map.filter = ShadowFilter::exact;
    LightingLight light;
    light.row.filter_file = "any";
    light.area.screen = {0, 0, 1000, 1000};
    LightingInputs inputs;
    inputs.lights = {light};
    FrameReport report;
    report.lights.resize(1);
    report.lights[0].filter.filter = said;
    const double fetches =
        drawn == ShadowFilter::automatic ? 0.0 : mean_fetches(scene.lights[0], decision.request, drawn);
    const double model_us = kPixels * (kShadedPixel_ns + fetches * kFetch_ns) / 1000.0;
    CostCalibration clock;
    for (std::uint64_t i = 0; i < 32; ++i) {
        clock.submitted(i, scene, {&decision, 1}, {&inputs, 1}, report);
        const gl::Timing timing{lighting_timer(0), i, 2.0 * model_us};
        clock.learn({&timing, 1});
    }
    return clock.factors().lighting;
}

/// Guards against a fault that lasts: it would make the device seem faster. A budget would then grant what does not fit
/// once the fault is over.
TEST(CostCalibration, CountsTheFilterThatWasDrawn) {
    for (const ShadowFilter drawn : {ShadowFilter::exact, ShadowFilter::hard, ShadowFilter::automatic})
        EXPECT_NEAR(learned_factor(drawn, drawn), 2.0, 0.05);
    EXPECT_LT(learned_factor(ShadowFilter::hard, ShadowFilter::exact), 1.0) << "the figure that it has to know";
}

}  // namespace
}  // namespace gnomon::shadow
