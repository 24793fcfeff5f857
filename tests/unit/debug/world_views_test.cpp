#include <cmath>

#include "tests/unit/debug/view_fixture.h"

namespace gnomon::debug {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::size_t kBox = 24, kPyramid = kBox + 8;  // vertices

struct WorldViews : ViewTest {
    WorldViews() {
        for (int i = 0; i < 6; ++i) {
            const double x = 10.0 * i;
            scene.instances.emplace_back().bounds_ws = {{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}};
        }
        frame.fitted.lights[0].sets.receivers = add(frame.sets.receiver_items, {4, 0, 1});
        frame.fitted.lights[0].sets.casters = add(frame.sets.caster_items, {1, 5, 2, 3});
        frame.fitted.views[2].casters = add(frame.fitted.casters, {3, 1});
    }
};

TEST_F(WorldViews, SetsAreBoxesOfWhatReceivesCastsAndDoesBoth) {
    const auto drawing = draw("sets", "sun");
    ASSERT_TRUE(drawing);
    EXPECT_THAT(drawing->lines, SizeIs(6 * kBox));
    EXPECT_THAT(texts(*drawing), ElementsAre("sun: potential sets", "2 receive only", "3 cast only", "1 do both"));
    // Each box has its own set's colour.
    std::vector<glm::vec4> colours(6);
    for (const LineVertex& v : drawing->lines) colours[static_cast<std::size_t>(v.position_ca_m.x / 10.0f)] = v.colour;
    EXPECT_EQ(colours[0], colours[4]);
    EXPECT_EQ(colours[2], colours[3]);
    EXPECT_EQ(colours[3], colours[5]);
    EXPECT_NE(colours[0], colours[2]);
    EXPECT_NE(colours[1], colours[0]);
    EXPECT_NE(colours[1], colours[2]);
}

TEST_F(WorldViews, SetsOfOneMapHoldItsOwnCastersAlone) {
    const auto drawing = draw("sets", "sun", 2);
    ASSERT_TRUE(drawing);
    EXPECT_THAT(texts(*drawing), ElementsAre("sun: potential sets", "2 receive only", "1 cast only", "1 do both"));
    EXPECT_THAT(texts(*draw("sets", "sun", 7)), Contains("0 cast only"));
}

TEST_F(WorldViews, ALightWithoutShadowsSaysWhyAndOneThatIsNotThereShowsNothing) {
    const auto drawing = draw("sets", "dark");
    ASSERT_TRUE(drawing);
    EXPECT_TRUE(drawing->lines.empty());
    EXPECT_THAT(drawing->labels.front().text, HasSubstr(reason_code(Reason::no_caster)));
    EXPECT_THAT(draw("frusta", "dark")->labels.front().text, HasSubstr(reason_code(Reason::no_caster)));
    for (const char* view : {"sets", "frusta", "cascades", "texels", "bias", "penumbra"})
        EXPECT_FALSE(draw(view, "nobody")) << view;
}

TEST_F(WorldViews, FrustaAreABoxPerCascadeAndAPyramidPerLampsView) {
    EXPECT_THAT(draw("frusta", "sun")->lines, SizeIs(4 * kBox));
    EXPECT_THAT(draw("frusta", "sun", 1)->lines, SizeIs(kBox));
    EXPECT_THAT(draw("frusta", "lamp")->lines, SizeIs(kPyramid));
    const auto all = draw("frusta", "");
    EXPECT_THAT(all->lines, SizeIs(4 * kBox + kPyramid));
    EXPECT_THAT(texts(*all), SizeIs(3 + 5)) << "a line per light, and per map";
    scene.lights[1].has_shadow = false;
    EXPECT_THAT(draw("frusta", "")->lines, SizeIs(4 * kBox));
}

TEST_F(WorldViews, TheCameraThatFitsAreFrozenToIsDrawnAsFarAsItsFarthestReceiver) {
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 0.0, 5.0};
    camera.rotation_ws = glm::dmat3(1.0);
    camera.near_m = 0.1;
    camera.fov_y_rad = 2.0 * std::atan(0.5);
    camera.viewport_px = {200, 100};
    frame.sets.receiver_points_ws = {{0.0, 0.0, -3.0}, {2.0, 1.0, -11.0}, {0.0, 0.0, 100.0}};
    fitted = &camera;
    const auto drawing = draw("frusta", "sun", 0);
    ASSERT_THAT(drawing->lines, SizeIs(2 * kBox));
    glm::vec3 low(1e9f), high(-1e9f);
    for (std::size_t i = kBox; i < 2 * kBox; ++i) {
        low = glm::min(low, glm::vec3(drawing->lines[i].position_ca_m));
        high = glm::max(high, glm::vec3(drawing->lines[i].position_ca_m));
    }
    EXPECT_NEAR(low.z, -11.0f, 1e-4f);
    EXPECT_NEAR(high.z, 4.9f, 1e-4f);
    EXPECT_NEAR(high.y, 8.0f, 1e-4f);   // 16 m ahead, half the height there
    EXPECT_NEAR(high.x, 16.0f, 1e-4f);  // the picture is twice as wide
    EXPECT_NEAR(low.x, -16.0f, 1e-4f);
}

}  // namespace
}  // namespace gnomon::debug
