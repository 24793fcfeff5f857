#include "gnomon/components.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"

/// What the report states of each view, and the numbers behind it.
namespace gnomon {
namespace {

using ::testing::SizeIs;

constexpr std::uint32_t kMap_px = 64;
constexpr std::uint64_t kLayer_bytes = 4 * kMap_px * kMap_px;

class WhyReport : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        device.set_timing(gl::TimingMode::finish);
        stage = world.add_stage();
    }
    ecs::Entity add(LightKind kind, const glm::dvec3& at_m = kLightPlace_m) {
        const ecs::Entity entity = world.add_light(kind, at_m, "lamp");
        world.registry.patch<LightShadow>(entity, [](LightShadow& s) { s.resolution_px = kMap_px; });
        return entity;
    }
    std::vector<ViewReport> views() const {
        const auto views = frame->report().views_of(light("lamp"));
        return {views.begin(), views.end()};
    }
    TestWorld::Stage stage;
};

TEST_F(WhyReport, ASpotsOnlyViewIsRenderedThenReused) {
    add(LightKind::spot);
    step();
    ASSERT_THAT(views(), SizeIs(1));
    EXPECT_EQ(views()[0].state, LightState::rendered);
    EXPECT_EQ(views()[0].reason, Reason::none);
    EXPECT_EQ(views()[0].why.receivers, 2u);
    EXPECT_EQ(views()[0].why.casters, 1u);
    EXPECT_EQ(views()[0].why.bytes_saved, 0u);
    EXPECT_FALSE(views()[0].why.saved_us) << "it was drawn";
    step();
    EXPECT_EQ(views()[0].state, LightState::reused);
    EXPECT_EQ(views()[0].reason, Reason::content_unchanged);
    EXPECT_EQ(views()[0].why.bytes_saved, kLayer_bytes);
    EXPECT_TRUE(views()[0].why.saved_us) << "it has been measured";
    EXPECT_EQ(light("lamp").why.bytes_saved, kLayer_bytes);
    EXPECT_EQ(light("lamp").why.receivers, 2u);
    EXPECT_EQ(light("lamp").why.casters, 1u);
}

TEST_F(WhyReport, EachFaceOfACubeSaysWhyItIsLeftOut) {
    // Above the box: what is below it is seen and in the way; beside it nothing stands before the ground; above
    // nothing.
    add(LightKind::point, {0, 3, 0});
    step();
    ASSERT_THAT(views(), SizeIs(6));
    std::uint32_t rendered = 0, without_receiver = 0;
    for (const ViewReport& view : views()) {
        rendered += view.state == LightState::rendered;
        if (view.state == LightState::rendered) continue;
        EXPECT_EQ(view.state, LightState::skipped);
        EXPECT_EQ(view.reason, view.why.receivers == 0 ? Reason::no_visible_receiver : Reason::no_caster) << view.layer;
        EXPECT_EQ(view.why.casters, 0u);
        EXPECT_EQ(view.why.bytes_saved, kLayer_bytes);
        without_receiver += view.reason == Reason::no_visible_receiver;
    }
    EXPECT_EQ(rendered, light("lamp").counts.views_drawn);
    EXPECT_GT(rendered, 0u);
    EXPECT_GT(without_receiver, 0u);
    EXPECT_EQ(light("lamp").why.bytes_saved, (6 - rendered) * kLayer_bytes);
}

TEST_F(WhyReport, ASkippedLightSavesItsMap) {
    add(LightKind::point, {0, 3, 0});
    world.registry.remove<ShadowCaster>(stage.box);
    step();
    EXPECT_EQ(light("lamp").reason, Reason::no_caster);
    EXPECT_THAT(views(), SizeIs(0));
    EXPECT_EQ(light("lamp").why.receivers, 2u);
    EXPECT_EQ(light("lamp").why.casters, 0u);
    EXPECT_EQ(light("lamp").why.bytes_saved, 6 * kLayer_bytes);
    EXPECT_FALSE(light("lamp").why.saved_us) << "it was never drawn";
}

TEST_F(WhyReport, AMapThatIsHeldForAWhileIsNotSavedYet) {
    add(LightKind::spot);
    step();
    world.registry.remove<ShadowCaster>(stage.box);
    step();
    EXPECT_EQ(light("lamp").counts.bytes, kLayer_bytes);
    EXPECT_EQ(light("lamp").why.bytes_saved, 0u);
    EXPECT_TRUE(light("lamp").why.saved_us);
    for (std::uint64_t i = 0; i <= shadow::MapCache::kHoldFrames; ++i) step();
    EXPECT_EQ(light("lamp").counts.bytes, 0u);
    EXPECT_EQ(light("lamp").why.bytes_saved, kLayer_bytes);
}

TEST_F(WhyReport, ALightWithoutShadowHasNothingToSave) {
    world.add_light(LightKind::spot, kLightPlace_m, "lamp", false);
    step();
    EXPECT_EQ(light("lamp").why.bytes_saved, 0u);
    EXPECT_THAT(views(), SizeIs(0));
}

TEST_F(WhyReport, EveryFiltersBytesAreThoseThatTheMapWouldHold) {
    const ecs::Entity lamp = add(LightKind::spot);
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = row.id; });
        world.registry.emplace<ShadowCaster>(stage.box);
        step();
        const std::uint64_t held = light("lamp").counts.bytes;
        EXPECT_GT(held, 0u);
        world.registry.remove<ShadowCaster>(stage.box);
        for (std::uint64_t i = 0; i <= shadow::MapCache::kHoldFrames + 1; ++i) step();
        EXPECT_EQ(light("lamp").why.bytes_saved, held) << row.name;
    }
}

}  // namespace
}  // namespace gnomon
