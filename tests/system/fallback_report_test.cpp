#include <set>

#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"

/// If a light falls back while its pictures are recorded, its report states how it is looked up, and how well.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint32_t kSize_px = 128;
const char* const kLamp = "lamp";

/// Returns the names, sorted, of the filters in the programs that draw the light. `group`: the group of passes in which
/// it looks, depth passes excepted.
std::vector<std::string> drawn_filters(const std::vector<Pass>& passes, const gl::RecordingDevice& device,
                                       const std::string& group = kLamp) {
    std::set<std::string> names;
    for (const Pass& pass : passes) {
        if (pass.group != group || pass.is_depth) continue;
        for (const gl::PipelineState& state : pass.pipelines)
            for (const shadow::FilterRow& row : shadow::filter_table())
                if (device.program(state.program)->label.find(row.file) != std::string::npos)
                    names.insert(std::string(row.name));
    }
    return {names.begin(), names.end()};
}

std::string name_of(ShadowFilter filter) { return std::string(shadow::filter_row(filter).name); }

class FallbackReport : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        world.add_stage();
    }
    ecs::Entity add_light(LightKind kind, ShadowFilter filter) {
        const ecs::Entity light = world.add_light(kind, kLightPlace_m, kLamp);
        world.registry.patch<LightShadow>(light, [&](LightShadow& s) {
            s.filter = filter;
            s.resolution_px = kSize_px;
        });
        edit_light(world.registry, light, [](Light& l) { l.source_radius_m = 0.1f, l.sun_radius_rad = 0.01f; });
        edit_light(world.registry, light, [](ShadowTuning& t) { t.reuse.keep_visibility = false; });
        return light;
    }
    const LightReport& lamp() const { return light(kLamp); }
    std::vector<std::string> drawn() const { return drawn_filters(passes(), device); }

    /// Expects that the report states what is drawn.
    void expect_agreement() const {
        if (lamp().state == LightState::skipped) {
            EXPECT_THAT(drawn(), IsEmpty());
            EXPECT_EQ(lamp().filter.filter, ShadowFilter::automatic);
            EXPECT_EQ(lamp().predicted_error_px, 0.0);
            EXPECT_EQ(lamp().counts.views + lamp().views.count, 0u);
            EXPECT_FALSE(lamp().keeps_max_error);
            EXPECT_EQ(lamp().resolved.px + lamp().resolved.m, 0.0);
            EXPECT_FALSE(lamp().resolved.keeps_narrowest);
            return;
        }
        EXPECT_THAT(drawn(), ElementsAre(name_of(lamp().filter.filter)));
        if (shadow::filter_row(lamp().filter.filter).rays) {
            EXPECT_EQ(lamp().predicted_error_px, 0.0);
            EXPECT_TRUE(lamp().keeps_max_error);
            EXPECT_EQ(lamp().resolved.px + lamp().resolved.m, 0.0);
            return;
        }
        EXPECT_GT(lamp().resolved.px, 0.0);
        EXPECT_GT(lamp().resolved.m, 0.0);
        EXPECT_TRUE(lamp().resolved.keeps_narrowest) << "none is set";
        if (shadow::filter_row(lamp().filter.filter).storage.triangle_ids) {
            EXPECT_GT(lamp().predicted_error_px, 0.5) << "half a pixel of the picture's, and more";
            EXPECT_TRUE(lamp().keeps_max_error);
        } else {
            EXPECT_GT(lamp().predicted_error_px, 1.0) << "the picture's own pixel, and more";
            EXPECT_EQ(lamp().keeps_max_error, shadow::meets_target(lamp().predicted_error_px, 1.0));
        }
    }
    void expect_fallback(ShadowFilter filter, Reason reason) const {
        EXPECT_EQ(lamp().state, filter == ShadowFilter::automatic ? LightState::skipped : LightState::degraded);
        EXPECT_STREQ(reason_code(lamp().reason), reason_code(reason));
        EXPECT_EQ(lamp().filter.filter, filter);
        if (filter != ShadowFilter::automatic) {
            EXPECT_STREQ(reason_code(lamp().filter.reason), reason_code(reason));
        }
        expect_agreement();
    }
};

/// What fails, of a light with which filter, and what is then drawn, and why.
struct Loss {
    const char* label;
    ShadowFilter own;
    ShadowFilter drawn;
    Reason reason;
};
void PrintTo(const Loss& loss, std::ostream* out) { *out << loss.label << ", " << name_of(loss.own); }

constexpr ShadowFilter kHard = ShadowFilter::hard, kNone = ShadowFilter::automatic, kExact = ShadowFilter::exact,
                       kSoft = ShadowFilter::exact_soft, kTriangles = ShadowFilter::triangles,
                       kMoments = ShadowFilter::vsm;
constexpr Loss kLosses[] = {
    {"surface places", kExact, kHard, Reason::buffer_failed},
    {"surface places", kSoft, kHard, Reason::buffer_failed},
    {"surface with places", kExact, kHard, Reason::buffer_failed},
    {"verdicts of maps", kExact, kHard, Reason::buffer_failed},
    {"answers of rays", kExact, kHard, Reason::buffer_failed},
    {"pixels for rays", kSoft, kHard, Reason::buffer_failed},
    {"verdicts LIGHT_", kExact, kHard, Reason::filter_program_failed},
    {"rays LIGHT_", kExact, kHard, Reason::filter_program_failed},
    {"rays LIGHT_", kSoft, kHard, Reason::filter_program_failed},
    {"as found", kExact, kHard, Reason::filter_program_failed},
    {"ray trees of meshes", kExact, kHard, Reason::buffer_failed},
    {"ray instances", kSoft, kHard, Reason::buffer_failed},
    {"filters/triangles/triangles", kTriangles, kHard, Reason::filter_program_failed},
    {"filters/prefiltered/vsm", kMoments, kHard, Reason::filter_program_failed},
    {"moments shadow/filters/prefiltered/vsm", kMoments, kHard, Reason::filter_program_failed},
    {"filters/", kTriangles, kNone, Reason::lighting_program_failed},
    {"filters/pcf/hard", kHard, kNone, Reason::lighting_program_failed},
    {"caster triangles", kTriangles, kNone, Reason::buffer_failed},
    {"shadow moment records", kMoments, kNone, Reason::buffer_failed},
    {"shadow map", kExact, kExact, Reason::map_allocation_failed},
    {"sheet departures", kExact, kExact, Reason::depth_program_failed},
    {"sheet ends", kSoft, kSoft, Reason::depth_program_failed},
    {"depth opaque", kExact, kExact, Reason::depth_program_failed},
};

class FallbackReportOf : public FallbackReport, public ::testing::WithParamInterface<Loss> {};

TEST_P(FallbackReportOf, SaysWhatIsDrawnAndAgainWhenTheFaultIsOver) {
    const Loss loss = GetParam();
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        SCOPED_TRACE(static_cast<int>(kind));
        const ecs::Entity lamp_entity = add_light(kind, loss.own);
        device.fail_label(loss.label, gl::Failure::out_of_memory);
        step();
        expect_agreement();
        if (loss.drawn == loss.own) {
            EXPECT_EQ(lamp().state, LightState::degraded);
            EXPECT_STREQ(reason_code(lamp().reason), reason_code(loss.reason));
        } else {
            expect_fallback(loss.drawn, loss.reason);
        }
        step();
        expect_agreement();
        device.stop_failing();
        for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) {
            step();
            expect_agreement();
        }
        EXPECT_EQ(lamp().filter.filter, loss.own);
        EXPECT_EQ(lamp().filter.reason, Reason::none);
        EXPECT_TRUE(lamp().state == LightState::rendered || lamp().state == LightState::reused)
            << reason_code(lamp().reason);
        world.registry.destroy(lamp_entity);
        step();
        frame.reset();  // programs of the next kind are its own, buffers are not
        start();
    }
}

INSTANTIATE_TEST_SUITE_P(EachLoss, FallbackReportOf, ::testing::ValuesIn(kLosses));

/// Loses the trees that rays walked: the report must not count them.
TEST_F(FallbackReport, SaysSoWhereTheTreesAreLostThatThereWere) {
    add_light(LightKind::spot, kExact);
    step();
    ASSERT_EQ(lamp().filter.filter, kExact);
    const std::uint64_t trees = frame->report().rays.bytes;
    device.fail_label("ray triangles", gl::Failure::out_of_memory);
    world.add_mesh(kSolidBox, {1.5, 1, 0}, true);  // its mesh needs a new tree
    step();
    expect_fallback(kHard, Reason::buffer_failed);
    EXPECT_THAT(map_labels(device, "ray tr"), ElementsAre("ray tree of instances"));
    EXPECT_LT(frame->report().rays.bytes, trees);
}

/// Refuses the light both its map and its rays: it is lit, and its report states that.
TEST_F(FallbackReport, SaysThatALightIsLitThatLosesItsMapAndItsRays) {
    add_light(LightKind::spot, kExact);
    for (const char* label : {"ray triangles", "shadow map"}) device.fail_label(label, gl::Failure::out_of_memory);
    step();
    expect_fallback(kNone, Reason::map_allocation_failed);
}

TEST_F(FallbackReport, SaysOfOneTapWhatALightOfOneTapSays) {
    const ecs::Entity own = add_light(LightKind::spot, kHard);
    step();
    const double own_px = lamp().predicted_error_px, resolved_m = lamp().resolved.m;
    EXPECT_FALSE(lamp().keeps_max_error) << "a map this coarse does not";
    world.registry.destroy(own);
    const ecs::Entity exact = add_light(LightKind::spot, kExact);
    step();
    EXPECT_TRUE(lamp().keeps_max_error);
    world.registry.destroy(exact);
    for (const ShadowFilter filter : {kExact, kTriangles, ShadowFilter::pcf_grid}) {
        const ecs::Entity entity = add_light(LightKind::spot, filter);
        const std::string file(shadow::filter_row(filter).file);
        device.fail_label(filter == kExact ? "surface places" : file, gl::Failure::out_of_memory);
        frame.reset();
        start();
        step();
        EXPECT_NEAR(lamp().predicted_error_px, own_px, 0.2 * own_px) << name_of(filter);
        EXPECT_NEAR(lamp().resolved.m, resolved_m, 0.2 * resolved_m) << name_of(filter);
        EXPECT_FALSE(lamp().keeps_max_error) << name_of(filter);
        device.stop_failing();
        world.registry.destroy(entity);
    }
}

}  // namespace
}  // namespace gnomon
