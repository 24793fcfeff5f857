#include <algorithm>

#include "bench/check/check.h"
#include "bench/check/check_scene.h"
#include "gnomon/components.h"
#include "tests/gl/gl_test_context.h"

// The check of a machine finds what is wrong on it.
namespace gnomon {
namespace {

constexpr glm::uvec2 kPicture_px{96, 54};

/// Judges the rows of one filter, each with its way of drawing a cube, without times.
std::vector<bench::CheckRow> rows_of(bench::Stage& stage, const bench::TracedTruths& truths, ShadowFilter filter,
                                     const bench::RowCheckOptions& options = {{}, 0}) {
    std::vector<bench::CheckRow> rows;
    for (const bench::CheckRowSetup& setup : bench::check_row_setups())
        if (setup.filter->id == filter) rows.push_back(bench::check_row(stage, truths, setup, options));
    return rows;
}

class CheckOfRows : public ::testing::Test {
protected:
    void SetUp() override {
        bench::StageOptions options;
        options.size_px = kPicture_px;
        auto stage = bench::Stage::open(options, bench::check_scene());
        ASSERT_TRUE(stage) << to_line(stage.error());
        stage_ = std::move(stage).value();
        auto truths = bench::trace_check_truths(*stage_, {});  // no row of these tests softens
        ASSERT_TRUE(truths) << to_line(truths.error());
        truths_ = std::move(truths).value();
    }
    void take_away(const char* name) {
        const std::vector<assets::Node> nodes = bench::check_scene().nodes;
        const auto at =
            std::find_if(nodes.begin(), nodes.end(), [&](const assets::Node& node) { return node.name == name; });
        ASSERT_NE(at, nodes.end());
        stage_->world().remove<ShadowCaster>(stage_->spawned().nodes[static_cast<std::size_t>(at - nodes.begin())]);
    }
    std::unique_ptr<bench::Stage> stage_;
    bench::TracedTruths truths_;
};

constexpr ShadowFilter kOfEachSort[] = {ShadowFilter::triangles, ShadowFilter::evsm4, ShadowFilter::exact};

TEST_F(CheckOfRows, FailsWhereACasterIsMissing) {
    for (const ShadowFilter filter : kOfEachSort)
        for (const bench::CheckRow& row : rows_of(*stage_, truths_, filter))
            EXPECT_NE(row.verdict, bench::CheckVerdict::failed) << row.setup.name << ": " << row.why;
    take_away(bench::kCheckBlock);
    for (const ShadowFilter filter : kOfEachSort)
        for (const bench::CheckRow& row : rows_of(*stage_, truths_, filter)) {
            // The other two lights reach the block beneath the board with little of their light.
            if (row.setup.kind != LightKind::point || row.verdict == bench::CheckVerdict::not_judged) continue;
            EXPECT_EQ(row.verdict, bench::CheckVerdict::failed) << row.setup.name;
            EXPECT_GT(row.errors.unexplained, 0u) << row.setup.name;
        }
}

TEST_F(CheckOfRows, SaysWhyARowCannotBeJudged) {
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::exact})
        for (const bench::CheckRow& row : rows_of(*stage_, truths_, filter)) {
            const bool layered =
                row.setup.route == CubeRoute::layered_vertex || row.setup.route == CubeRoute::layered_geometry;
            const bool cannot = row.setup.route == CubeRoute::layered_vertex && !stage_->device().info().vertex_layer;
            const bool possible = !layered || (filter == ShadowFilter::hard && !cannot);
            EXPECT_EQ(row.verdict, possible ? bench::CheckVerdict::ok : bench::CheckVerdict::not_judged)
                << row.setup.name << ": " << row.why;
            EXPECT_EQ(row.why.empty(), possible) << row.setup.name;
        }
}

TEST_F(CheckOfRows, FirstFramesOfNewSystemsShowTheSame) {
    const auto quiet = [](const std::string&, std::size_t, std::size_t) {};
    const bench::FirstFrames same = bench::check_first_frames(*stage_, 3, quiet);
    EXPECT_EQ(same.drawn, 3u);
    EXPECT_EQ(same.differ, 0u);
    EXPECT_GT(same.dark_px, 100u);
    EXPECT_TRUE(same.well());
    const auto taken_before_the_last = [&](const std::string&, std::size_t i, std::size_t) {
        if (i == 2) take_away(bench::kCheckBlock);
    };
    const bench::FirstFrames lost = bench::check_first_frames(*stage_, 3, taken_before_the_last);
    EXPECT_EQ(lost.differ, 1u);
    EXPECT_GT(lost.most_px, 50u);
    EXPECT_FALSE(lost.well());
}

class CheckOfADevice : public GlTest {};

TEST_F(CheckOfADevice, ReadsWhatTheDeviceWorksBy) {
    const bench::DeviceCheck check = bench::check_device(gl::read_device_facts(), device().info());
    EXPECT_EQ(check.short_of, std::vector<std::string>());
    EXPECT_EQ(check.info.name, check.facts.renderer + ", OpenGL " + check.facts.version);
    const auto limit = [&](std::string_view name) {
        const auto at = std::find_if(check.facts.limits.begin(), check.facts.limits.end(),
                                     [&](const gl::DeviceLimit& l) { return l.name == name; });
        return at == check.facts.limits.end() ? 0 : at->value;
    };
    EXPECT_EQ(std::min(limit("MAX_TEXTURE_SIZE"), limit("MAX_VIEWPORT_DIMS")), std::int64_t{check.info.max_texture_px});
    EXPECT_EQ(limit("MAX_ARRAY_TEXTURE_LAYERS"), std::int64_t{check.info.max_layers});
    EXPECT_EQ(static_cast<std::uint64_t>(limit("MAX_TEXTURE_BUFFER_SIZE")) * gl::kTexelBytes,
              check.info.max_texel_bytes);
    for (const gl::DeviceLimit& each : check.facts.limits) EXPECT_GT(each.value, 0) << each.name;
    EXPECT_EQ(check.facts.extensions.front().there, check.info.vertex_layer);
    EXPECT_NE(check.facts.vendor + check.facts.glsl, "");
}

TEST_F(CheckOfADevice, KeepsWhatADriverSaysOfAProgram) {
    std::vector<gl::ProgramDesc> programs = bench::check_programs();
    programs.resize(2);
    programs[0].fragment += "\nfloat unfinished( {\n";
    const bench::ProgramChecks checks =
        bench::compile_programs(device(), programs, [](const std::string&, std::size_t, std::size_t) {});
    take_messages();
    EXPECT_EQ(checks.compiled, 1u);
    ASSERT_EQ(checks.failed.size(), 1u);
    EXPECT_EQ(checks.failed[0].label, programs[0].label);
    EXPECT_GT(checks.failed[0].log.size(), std::string(gl::to_text(gl::Failure::compile_failed)).size() + 1);
}

}  // namespace
}  // namespace gnomon
