#include <limits>

#include "systems/shadow/request/filter_table.h"
#include "tests/gl/box_fixture.h"

// A sun that projects from an eye, and depth ranges that are given. The shadows are as of a lamp at the eye, inside the
// given range.
namespace gnomon {
namespace {

constexpr std::size_t kFew = 15;    // where the place itself is small
constexpr double kEye_m = 11.0;     // height of every light's place above the ground
constexpr glm::dvec3 kDown{0.0, -1.0, 0.0};

class ProjectionTest : public BoxTest {
protected:
    /// Adds a sun straight above with its eye kEye_m over the origin. `seen_height_m`: how high reaches what is seen.
    ecs::Entity add_sun(ShadowTuning::Projection projection, double seen_height_m,
                        ShadowFilter filter = ShadowFilter::automatic) {
        projection.eye_distance_m = static_cast<float>(kEye_m - 0.5 * seen_height_m);
        return add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, kDown,
                         {.filter = filter, .resolution_px = 1024}, {.projection = projection});
    }
    /// Judges the frame's visibility against a point source at the eye.
    boxes::Verdict judged_from_eye() {
        LightItem lamp;
        lamp.kind = LightKind::point;
        lamp.position_ws_m = {0.0, kEye_m, 0.0};
        return boxes::judge(truth, frame().snapshot().consumers.front(), lamp, visibility());
    }
    /// Returns the lit share of the field, among the pixels with a ray that meets the ground within the rectangle.
    double lit_share(const std::vector<float>& field, const glm::dvec2& from, const glm::dvec2& to) {
        const ConsumerItem& camera = frame().snapshot().consumers.front();
        std::size_t lit = 0, all = 0;
        for (std::uint32_t y = 0; y < camera.viewport_px.y; ++y)
            for (std::uint32_t x = 0; x < camera.viewport_px.x; ++x) {
                const glm::dvec3 p = boxes::pixel_ray(camera, x, y).origin;
                if (p.x < from.x || p.x > to.x || p.z < from.y || p.z > to.y) continue;
                ++all;
                lit += field[std::size_t{y} * camera.viewport_px.x + x] > 0.5f ? 1u : 0u;
            }
        EXPECT_GT(all, kFew);
        return static_cast<double>(lit) / static_cast<double>(std::max<std::size_t>(all, 1));
    }
};

TEST_F(ProjectionTest, ASunInPerspectiveCastsAsALampAtItsEyeDoes) {
    add_ground(6.0);
    add_box({1.5, 1.0, 1.0}, {2.5, 2.0, 2.0});
    add_box({-3.0, 0.0, -2.0}, {-2.5, 2.0, 1.0});
    add_sun({.kind = LightProjection::perspective, .eye_angle_rad = 1.6f}, 2.0);
    look_down(5.0);
    draw();
    const boxes::Verdict verdict = judged_from_eye();
    EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
    EXPECT_GE(verdict.dark, kSome);
    EXPECT_GE(verdict.lit, 10 * kSome);
    EXPECT_GT(judged().wrong, kSome / 3) << "rays from the eye are not parallel";
}

TEST_F(ProjectionTest, ASunWithoutTheWishIsNoLampAtItsEye) {
    add_ground(6.0);
    add_box({1.5, 1.0, 1.0}, {2.5, 2.0, 2.0});
    add_box({-3.0, 0.0, -2.0}, {-2.5, 2.0, 1.0});
    add_sun({.kind = LightProjection::orthographic}, 2.0);
    look_down(5.0);
    draw();
    expect_true(0, 10 * kSome);  // the boxes hide their own shadows from above
    EXPECT_GT(judged_from_eye().wrong, kSome / 3);
}

TEST_F(ProjectionTest, EveryFilterLeavesAPerspectiveSunsPlanesUnspotted) {
    for (const shadow::FilterRow& filter : shadow::filter_table())
        add_sun({.kind = LightProjection::perspective, .eye_angle_rad = 1.6f}, 2.0, filter.id);
    add_ground(6.0);
    place(add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 2.0, 0.5})),
          {.translation_m = {3.0, 0.0, 0.0}, .rotation = glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0))});
    look_down(5.0);
    draw();
    for (std::uint32_t light = 0; light < shadow::filter_table().size(); ++light) {
        if (shadow::filter_table()[light].rays) continue;  // its rays are parallel: no map is projected
        EXPECT_EQ(lit_share(visibility(light), {-5.5, -4.5}, {2.0, 4.5}), 1.0)
            << "acne on the ground, filter " << shadow::filter_table()[light].name;
        // Places of the sun itself are hidden by triangles, not by what the eye sees of them.
        if (shadow::filter_table()[light].id == ShadowFilter::soft_triangles) continue;
        EXPECT_LT(lit_share(visibility(light), {3.9, -0.2}, {4.0, 0.2}), 0.5) << "and no shadow, filter " << shadow::filter_table()[light].name;
    }
}

TEST_F(ProjectionTest, BeyondAPerspectiveSunsViewItIsLit) {
    add_ground(6.0);
    add_box({-0.4, 1.0, -0.4}, {0.4, 2.0, 0.4});
    add_box({4.0, 1.0, -0.5}, {5.0, 2.0, 0.5});
    add_sun({.kind = LightProjection::perspective, .eye_angle_rad = 0.4f}, 2.0);
    look_down(5.0);
    draw();
    const auto field = visibility();
    EXPECT_EQ(lit_share(field, {-0.3, -0.3}, {0.3, 0.3}), 1.0) << "the box's own top";
    EXPECT_LT(lit_share(field, {0.42, -0.3}, {0.46, 0.3}), 0.5) << "its shadow around it";
    const double half_m = std::tan(0.2) * kEye_m;
    EXPECT_EQ(lit_share(field, {half_m + 0.1, -4.5}, {5.5, 4.5}), 1.0) << "the other box would shade this";
}

// One light of each way to project, all at the same place, all looking down.
enum class DepthVariant { flat_sun, perspective_sun, spot, point };

class GivenRange : public ProjectionTest, public ::testing::WithParamInterface<DepthVariant> {
protected:
    /// Adds the light of this variant. What is seen reaches up to 6 m in these scenes.
    void add(float near_m, float far_m) {
        ShadowTuning::Projection projection{.eye_angle_rad = 1.6f, .near_m = near_m, .far_m = far_m};
        const LightShadow shadow{.resolution_px = 1024};
        const glm::dvec3 place_m(0.0, kEye_m, 0.0);
        if (GetParam() == DepthVariant::perspective_sun) projection.kind = LightProjection::perspective;
        if (GetParam() == DepthVariant::flat_sun || GetParam() == DepthVariant::perspective_sun)
            add_sun(projection, 6.0);
        else if (GetParam() == DepthVariant::spot)
            add_light({.kind = LightKind::spot, .intensity = 3000.0f, .outer_cone_rad = 0.8f}, place_m, kDown, shadow,
                      {.projection = projection});
        else
            add_light({.kind = LightKind::point, .intensity = 3000.0f}, place_m, kDown, shadow,
                      {.projection = projection});
    }
    /// Adds a ground; a box high up on the left; on the right a card at 4 m under a smaller card at 6 m.
    void add_scene() {
        add_ground(6.0);
        add_box({-3.0, 3.0, -1.0}, {-2.0, 4.0, 1.0});
        add_card({{2.0, 4.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}});
        place(add_mesh(game::make_box({1.6, 5.9, -0.4}, {2.4, 6.0, 0.4})));
        look_down(5.0);
    }
    bool flat() const { return GetParam() == DepthVariant::flat_sun; }
};

TEST_P(GivenRange, AbsurdOnesLeaveThePictureAsItIsAndAreReported) {
    add_scene();
    add(0.0f, 0.0f);
    draw();
    const auto fitted = visibility();
    EXPECT_EQ(frame().report().lights[0].reason, Reason::none);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [near_m, far_m] : {std::pair(9.0f, 8.0f), {kNan, 0.0f}, {-1.0f, 20.0f}, {3.0f, 3.0f}}) {
        const ecs::Entity light = frame().snapshot().lights[0].entity;
        edit_light(world, light, [n = near_m, f = far_m](ShadowTuning& t) {
            t.projection.near_m = n;
            t.projection.far_m = f;
        });
        draw();
        EXPECT_EQ(fitted, visibility()) << near_m << ", " << far_m;
        EXPECT_EQ(frame().report().lights[0].state, LightState::degraded);
        EXPECT_EQ(frame().report().lights[0].reason, Reason::range_invalid);
    }
}

TEST_P(GivenRange, AWideOneChangesNothingThatShows) {
    add_scene();
    add(0.0f, 0.0f);
    draw();
    const auto fitted = visibility();
    const ecs::Entity light = frame().snapshot().lights[0].entity;
    edit_light(world, light, [](ShadowTuning& t) { t.projection.near_m = 0.5f, t.projection.far_m = 500.0f; });
    draw();
    const auto wide = visibility();
    std::size_t differ = 0;
    for (std::size_t i = 0; i < wide.size(); ++i) differ += wide[i] != fitted[i] ? 1u : 0u;
    EXPECT_LT(differ, wide.size() / 500) << "edges, by a rounding";
}

TEST_P(GivenRange, BeyondFarItIsLitAndNothingCasts) {
    add_scene();
    add(0.0f, 7.5f);  // 3.5 m above the ground: through the left box, below the cards
    draw();
    const auto field = visibility();
    EXPECT_EQ(lit_share(field, {-5.5, -4.5}, {-0.5, 4.5}), 1.0) << "the ground is beyond";
    // The cards are before it: the lower one is shaded by the upper one, around its edge where rays diverge.
    if (!flat()) {
        EXPECT_LT(lit_share(field, {2.45, -0.3}, {2.6, 0.3}), 0.5);
    }
}

TEST_P(GivenRange, BeforeNearItIsLitYetItStillCasts) {
    add_scene();
    add(7.5f, 0.0f);  // the left box is cut, the cards lie before it
    draw();
    const auto field = visibility();
    EXPECT_EQ(lit_share(field, {1.2, -0.8}, {2.8, 0.8}), 1.0) << "the cards are before it";
    if (!flat()) {
        EXPECT_LT(lit_share(field, {-3.9, -0.8}, {-3.1, 0.8}), 0.5) << "the box still casts";
        EXPECT_LT(lit_share(field, {3.2, -0.8}, {4.5, 0.8}), 0.5) << "and so do the cards";
    }
    EXPECT_EQ(lit_share(field, {-1.5, -4.5}, {0.5, 4.5}), 1.0) << "no acne between";
}

std::string way_name(const ::testing::TestParamInfo<DepthVariant>& info) {
    constexpr const char* kNames[] = {"flat_sun", "perspective_sun", "spot", "point"};
    return kNames[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(EachWay, GivenRange,
                         ::testing::Values(DepthVariant::flat_sun, DepthVariant::perspective_sun, DepthVariant::spot, DepthVariant::point), way_name);

}  // namespace
}  // namespace gnomon
