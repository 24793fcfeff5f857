#include <gmock/gmock.h>

#include "bench/accuracy/reference_images.h"
#include "bench/compare/evaluate_configuration.h"
#include "bench/sweep/sweep_plan.h"
#include "tests/gl/truth_scenes.h"

// What is predicted of shadow edges holds for every way to cast shadows, not for the defaults alone.
namespace gnomon {
namespace {

class SweepBounds : public TruthTest {
protected:
    void SetUp() override {
        bench::StageOptions options;
        options.size_px = {320, 180};
        stage_ = open(options);
        ASSERT_TRUE(stage_);
        auto truths = bench::trace_truths(*stage_);
        ASSERT_TRUE(truths) << to_line(truths.error());
        truths_ = std::move(truths).value();
    }

    std::vector<bench::LightRow> judge(const std::string& name) {
        for (const bench::SweepRow& row : bench::sweep_plan(bench::SweepSize::full)) {
            if (row.name != name) continue;
            bench::JudgedRow judged = bench::judge_row(*stage_, truths_, row, {});
            EXPECT_FALSE(judged.error) << judged.error.value_or("");
            return judged.lights;
        }
        ADD_FAILURE() << "there is no row " << name;
        return {};
    }

private:
    std::unique_ptr<bench::Stage> stage_;
    bench::TracedTruths truths_;
};

TEST_F(SweepBounds, HoldUnderWideFiltersSteepReceiversAndCoarseDepths) {
    for (const char* name : {"hard, resolution=1024", "poisson_4", "exponential_7", "evsm4_7, resolution=2048",
                             "depth_format=d24", "depth_format=d16"})
        for (const bench::LightRow& light : judge(name)) {
            SCOPED_TRACE(std::string(name) + ", " + light.light);
            EXPECT_GT(light.figures.edge_places.value_or(0.0), 100.0);
            EXPECT_EQ(light.figures.unexplained, 0.0);
            EXPECT_EQ(light.figures.other_bias, 0.0);
        }
}

TEST_F(SweepBounds, AreBrokenByABiasThatIsNotGnomonsAndItIsNamed) {
    double beyond = 0.0;
    for (const bench::LightRow& light : judge("hard, bias=tutorial_cosine, resolution=2048")) {
        EXPECT_EQ(light.figures.unexplained, 0.0) << light.light;
        beyond += light.figures.other_bias.value_or(0.0);
    }
    EXPECT_GT(beyond, 100.0);
}

}  // namespace
}  // namespace gnomon
