#include "systems/lighting/ambient.h"

#include <gtest/gtest.h>

#include <cmath>

#include "systems/lighting/picture_range.h"

// What falls on a scene, and how its picture is stored in 16 bits.
namespace gnomon::lighting {
namespace {

void add_box(SceneSnapshot& scene, const glm::dvec3& centre, double half_m) {
    InstanceItem item;
    item.bounds_ws = {centre - half_m, centre + half_m};
    scene.instances.push_back(item);
}

SceneSnapshot yard(double scale) {
    SceneSnapshot scene;
    add_box(scene, glm::dvec3(0.0), 1.0 * scale);
    add_box(scene, glm::dvec3(3.0, 0.0, 0.0) * scale, 1.0 * scale);
    add_box(scene, glm::dvec3(0.0, 0.0, 3.0) * scale, 1.0 * scale);
    LightItem lamp;
    lamp.kind = LightKind::point;
    lamp.position_ws_m = glm::dvec3(0.0, 5.0, 0.0) * scale;
    lamp.intensity = static_cast<float>(100.0 * scale * scale);
    scene.lights.push_back(lamp);
    return scene;
}

SceneLight light_of(const SceneSnapshot& scene) {
    MidstFinder finder;
    return scene_light(scene, finder.find(scene));
}

TEST(SceneLight, OfAnyScaleIsTheSameToTheBitIfItsLampsGiveAsMuch) {
    const SceneLight unit = light_of(yard(1.0));
    EXPECT_GT(unit.bounce_lux.r, 0.1f);
    for (const double scale : {0x1p-13, 0x1p4, 0x1p26})
        EXPECT_EQ(light_of(yard(scale)).bounce_lux, unit.bounce_lux) << scale;
}

TEST(SceneLight, AWideGroundIsNotTheScenesSize) {
    SceneSnapshot scene = yard(1.0);
    const float before = light_of(scene).bounce_lux.r;
    add_box(scene, glm::dvec3(0.0), 1.0e6);
    const float after = light_of(scene).bounce_lux.r;
    EXPECT_GT(after, 0.5f * before);
    EXPECT_LT(after, 2.0f * before);
}

TEST(SceneLight, OfAnEmptySceneIsTheSunsAlone) {
    SceneSnapshot scene = yard(1.0);
    scene.instances.clear();
    scene.lights.front().position_ws_m = glm::dvec3(0.0);
    LightItem sun;
    sun.kind = LightKind::directional;
    sun.intensity = 1000.0f;
    scene.lights.push_back(sun);
    const SceneLight light = light_of(scene);
    EXPECT_EQ(light.bounce_lux, glm::vec3(0.0f));
    EXPECT_EQ(light.suns_lux, 1000.0);
    EXPECT_GT(ambient_for(light).sky_lux.r, 50.0f);
}

TEST(SceneLight, FollowsASceneThatChangesUnderItsVersion) {
    MidstFinder finder;
    SceneSnapshot scene = yard(1.0);
    scene.version = 1;
    const double before_m = finder.find(scene).reach_m;
    for (InstanceItem& item : scene.instances) item.bounds_ws = {item.bounds_ws.min * 2.0, item.bounds_ws.max * 2.0};
    EXPECT_EQ(finder.find(scene).reach_m, before_m) << "it looked at a scene that stood still";
    scene.version = 2;
    EXPECT_NEAR(finder.find(scene).reach_m, 2.0 * before_m, 1e-9);
}

TEST(PictureRange, IsAPowerOfTwoThatHoldsWhatFallsOnTheScene) {
    for (double candela = 1e-25; candela < 1e35; candela *= 7.3) {
        SceneSnapshot scene = yard(1.0);
        scene.lights.front().intensity = static_cast<float>(candela);
        const SceneLight light = light_of(scene);
        const PictureRange range = picture_range(light, 0.0f, {});
        int power = 0;
        EXPECT_EQ(std::frexp(range.per_radiance, &power), 0.5f) << candela;
        const double held = light.lamps_lux * static_cast<double>(range.per_radiance);
        EXPECT_GT(held, 0.02) << candela;
        EXPECT_LT(held, 1.0) << candela;
        EXPECT_TRUE(std::isfinite(range.per_unlit) && range.per_unlit > 0.0f) << candela;
    }
    for (float ev = -64.0f; ev <= 64.0f; ev += 3.7f) {
        const PictureRange range = picture_range({}, 0.0f, ev);
        EXPECT_GE(range.per_unlit, 32.0f) << ev;
        EXPECT_LE(range.per_unlit, 64.0f) << ev;
    }
}

TEST(PictureRange, OfNothingIsOne) {
    EXPECT_EQ(picture_range({}, 0.0f, {}).per_radiance, 1.0f);
    EXPECT_EQ(picture_range({}, 0.0f, {}).per_unlit, 1.0f);
}

}  // namespace
}  // namespace gnomon::lighting
