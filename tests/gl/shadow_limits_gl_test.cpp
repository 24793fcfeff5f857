#include <limits>

#include "tests/gl/box_fixture.h"

// Where a light's reach, its map, or the numbers of an entity end.
namespace gnomon {
namespace {

class ShadowLimits : public BoxTest {
protected:
    static Light point(float range_m = 0.0f) {
        return {.kind = LightKind::point, .intensity = 3000.0f, .range_m = range_m};
    }
    static Light spot(float outer_rad, float range_m = 0.0f) {
        return {.kind = LightKind::spot, .intensity = 3000.0f, .range_m = range_m, .outer_cone_rad = outer_rad};
    }
    static constexpr glm::dvec3 kDown{0.0, -1.0, 0.0};
};

TEST_F(ShadowLimits, ARangeEndsTheLightAndNothingElse) {
    add_ground(6.0);
    add_box({0.5, 0.5, -0.5}, {1.2, 1.5, 0.5});
    add_light(point(4.0f), {-0.5, 3.0, 0.2}, kDown);
    add_light(point(), {-0.5, 3.0, 0.2}, kDown);
    look_down(5.0);
    draw();
    expect_true(5 * kSome, 5 * kSome, 0);
    expect_true(kSome, 20 * kSome, 1);
    const auto limited = visibility(0), unlimited = visibility(1);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < limited.size(); ++i) {
        EXPECT_LE(limited[i], unlimited[i] + 1e-5f) << "the range adds light at " << i;
        differ += limited[i] != unlimited[i];
    }
    EXPECT_GT(differ, 10 * kSome);
}

TEST_F(ShadowLimits, ALightInsideAClosedCasterLightsNothingOutside) {
    for (const LightKind kind : {LightKind::point, LightKind::spot}) {
        Light light = kind == LightKind::point ? point() : spot(0.9f);
        add_light(light, {0.1, 1.5, 0.0}, kDown, {.filter = ShadowFilter::hard, .resolution_px = 512});
    }
    add_ground(6.0);
    add_box({-0.6, 1.0, -0.5}, {0.6, 2.0, 0.5});
    look_down(5.0);
    draw();
    expect_true(10 * kSome, 0, 0);
    expect_true(10 * kSome, 0, 1);
    EXPECT_EQ(judged(0).lit, 0u);
}

TEST_F(ShadowLimits, BehindASpotAndOutsideItsConeThereIsNoLight) {
    add_ground(6.0);
    add_box({-0.5, 0.5, 0.8}, {0.4, 1.0, 1.4});
    // Level with the ground, along +z: half of the ground lies behind it.
    add_light(spot(0.7f), {0.0, 2.0, 0.0}, {0.0, -0.7, 1.0});
    look_down(5.0);
    draw();
    expect_true(20 * kSome, kSome);
    const auto field = visibility();
    const std::uint32_t width = settings.viewport_px.x;
    const ConsumerItem& camera = frame().snapshot().consumers.front();
    std::size_t behind = 0;
    for (std::uint32_t y = 0; y < settings.viewport_px.y; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            if (boxes::pixel_ray(camera, x, y).origin.z > -1.0) continue;
            ++behind;
            EXPECT_LE(field[y * width + x], 0.0f);
        }
    EXPECT_GT(behind, 10 * kSome);
}

TEST_F(ShadowLimits, AConeOfAlmostAHalfSpaceCastsShadowsOutToItsRim) {
    constexpr double kOneView_rad = 1.3962634;  // 80 degrees: no single perspective view would hold more
    add_ground(40.0);
    const double height_m = 1.0, rim_m = height_m * std::tan(kOneView_rad);
    truth.margin_m = 0.12;
    add_box({1.0, 0.2, -0.5}, {1.8, 0.6, 0.5});
    add_box({rim_m * 1.6, 0.0, -4.0}, {rim_m * 1.6 + 0.5, 0.8, 4.0});
    add_light(spot(1.55f), {0.0, height_m, 0.0}, kDown, {.filter = ShadowFilter::hard, .resolution_px = 2048});
    look_down(14.0);
    draw();
    const LightReport& report = frame().report().lights.front();
    EXPECT_EQ(report.state, LightState::rendered);
    EXPECT_EQ(report.counts.views, 1u) << "both boxes stand to one side, and only there does anything cast";
    expect_true(kSome, 10 * kSome);
}

TEST_F(ShadowLimits, AConeThatOpensBeyondOneViewFadesToFacesAnEighthPerFrame) {
    add_ground(40.0);
    truth.margin_m = 0.12;
    add_box({1.0, 0.2, -0.5}, {1.8, 0.6, 0.5});
    add_box({-0.6, 0.2, -1.2}, {0.1, 0.5, -0.7});
    const ecs::Entity lamp =
        add_light(spot(1.0f), {0.0, 1.0, 0.0}, kDown, {.filter = ShadowFilter::hard, .resolution_px = 1024});
    look_down(4.0);
    draw();
    world.patch<Light>(lamp, [](Light& light) { light.outer_cone_rad = 1.1f; });
    std::vector<float> last;
    float any = 0.0f;
    for (int i = 1; i <= 9; ++i) {
        SCOPED_TRACE(i);
        draw();
        const auto field = visibility();
        expect_true(kSome / 2, 4 * kSome);
        float jump = 0.0f;
        for (std::size_t p = 0; p < last.size(); ++p) jump = std::max(jump, std::abs(field[p] - last[p]));
        EXPECT_LE(jump, 1.0f / 8.0f + 1e-6f) << "edges of the two differ by texels, and cross over gently";
        any = std::max(any, jump);
        last = field;
    }
    EXPECT_GT(any, 0.0f) << "otherwise nothing faded";
    EXPECT_EQ(frame().report().lights.front().state, LightState::reused) << "the faces alone, and kept";
}

TEST_F(ShadowLimits, ANaNInOneEntityLeavesTheRestOfThePictureAsIfItWereNotThere) {
    add_ground(6.0);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    const ecs::Entity sick = add_box({-3.0, 0.5, -2.0}, {-2.0, 1.5, -1.0});
    world.emplace<Name>(sick, {"sick"});
    add_light(point(), {-1.0, 5.0, 2.0}, kDown);
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {1.0, -2.0, 0.5});
    add_light(spot(0.9f), {2.0, 6.0, 2.0}, kDown);
    look_down(5.0);
    draw();
    const auto with = picture();

    world.patch<Transform>(sick, [](Transform& t) { t.translation_m.y = std::numeric_limits<double>::quiet_NaN(); });
    draw();
    const auto quarantined = picture();
    ASSERT_EQ(frame().report().dropped.size(), 1u);
    EXPECT_EQ(frame().report().dropped.front().entity, sick);
    EXPECT_EQ(frame().report().dropped.front().name, "sick");
    std::vector<float> fields[3];
    for (std::uint32_t light = 0; light < 3; ++light) {
        fields[light] = visibility(light);
        for (const float v : fields[light]) ASSERT_TRUE(v == -1.0f || (v >= 0.0f && v <= 1.0f + 1e-5f)) << v;
    }

    world.destroy(sick);
    draw();
    EXPECT_TRUE(frame().report().dropped.empty());
    EXPECT_EQ(quarantined, picture());
    for (std::uint32_t light = 0; light < 3; ++light) EXPECT_EQ(fields[light], visibility(light));
    EXPECT_NE(with, quarantined) << "the entity never showed";
}

TEST_F(ShadowLimits, AnEntityThatIsWellAgainIsBack) {
    add_ground(6.0);
    const ecs::Entity box = add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {1.0, -2.0, 0.5});
    look_down(5.0);
    draw();
    const auto before = picture();
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        world.patch<Transform>(box, [bad](Transform& t) { t.scale.x = bad; });
        draw();
        EXPECT_NE(before, picture());
    }
    world.patch<Transform>(box, [](Transform& t) { t.scale.x = 1.0; });
    draw();
    EXPECT_EQ(before, picture());
}

TEST_F(ShadowLimits, ALightWithANaNIsDroppedAndTheOthersShineOn) {
    add_ground(6.0);
    add_box({-0.5, 1.0, -0.7}, {0.6, 2.0, 0.8});
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {1.0, -2.0, 0.5});
    const ecs::Entity sick = add_light(point(), {-1.0, 5.0, 2.0}, kDown);
    look_down(5.0);
    draw();
    const auto sun = visibility(0);
    world.patch<Transform>(sick, [](Transform& t) { t.translation_m.x = std::numeric_limits<double>::quiet_NaN(); });
    draw();
    ASSERT_EQ(frame().snapshot().lights.size(), 1u);
    EXPECT_EQ(frame().report().dropped.size(), 1u);
    EXPECT_EQ(sun, visibility(0));
}

}  // namespace
}  // namespace gnomon
