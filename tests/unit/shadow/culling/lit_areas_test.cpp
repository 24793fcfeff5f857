#include "systems/shadow/culling/lit_areas.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "systems/extract/scene_tree.h"
#include "systems/shadow/publish/publish_lights.h"
#include "tests/unit/shadow/random_scene.h"

/// The part of a picture that a light's pass covers: all that the light lights is in it, and little else.
namespace gnomon::shadow {
namespace {

constexpr std::array kLampKinds = {LightKind::spot, LightKind::point, LightKind::rectangle, LightKind::sphere};

/// Returns whether the light's rays can reach the point, were nothing in the way.
bool shines_on(const LightItem& light, const glm::dvec3& p) {
    if (light.kind == LightKind::rectangle && !(glm::dot(p - light.position_ws_m, -light.rotation_ws[2]) > 0.0))
        return false;
    LightItem lamp = light;
    if (light.kind != LightKind::spot) lamp.kind = LightKind::point;
    return reaches(lamp, p);
}

/// Place in the picture, pixels, and reversed depth of a point before the camera.
struct Seen {
    glm::dvec2 px{0.0};
    float depth = 0.0f;
};
Seen seen_at(const ConsumerItem& c, const glm::dvec3& p_ws) {
    const glm::vec4 clip =
        glm::mat4(camera_record(c).clip_from_anchor) * glm::vec4(glm::vec3(p_ws - c.position_ws_m), 1.0f);
    return {(glm::dvec2(clip.x, clip.y) / static_cast<double>(clip.w) * 0.5 + 0.5) * glm::dvec2(c.viewport_px),
            clip.z / clip.w};
}
bool holds(const gl::Rect& area, const glm::dvec2& px) {
    return px.x >= area.x && px.y >= area.y && px.x <= area.x + area.width && px.y <= area.y + area.height;
}
double pixels(const gl::Rect& area) { return static_cast<double>(area.width) * area.height; }

/// Returns the lit areas of a scene, by the stage.
std::vector<LitArea> areas_of(const SceneSnapshot& scene) {
    FitStages stages;
    stages.decide(scene);
    stages.select(scene);
    return stages.frame.sets.lit_areas;
}

/// How instances of a random world take part.
enum class World { all_receive, some_do_not, unshadowed, others_look };

class LitAreas : public ::testing::TestWithParam<World> {
protected:
    SceneSnapshot world(int round) {
        SceneSnapshot scene = random.scene(kLampKinds[static_cast<std::size_t>(round) % kLampKinds.size()], 12);
        LightItem& light = scene.lights[0];
        light.source_radius_m = light.kind == LightKind::sphere ? 0.1f : 0.0f;
        light.range_m = round % 5 == 0 ? random.number(2.0, 15.0) : 0.0;
        light.has_shadow = GetParam() != World::unshadowed;
        if (GetParam() == World::all_receive)
            for (InstanceItem& item : scene.instances) item.receives = item.casts = true;
        if (GetParam() == World::others_look) {
            ConsumerItem other = scene.consumers[0];
            other.position_ws_m = 15.0 * random.direction();
            other.rotation_ws = math::basis_from_back(other.position_ws_m);
            scene.pictures = {other};
        }
        return scene;
    }
    RandomScene random{print_seed()};
};

TEST_P(LitAreas, HoldEveryVisiblePointThatTheLightReaches) {
    int points = 0, bounded = 0;
    for (int round = 0; round < 600; ++round) {
        const SceneSnapshot scene = world(round);
        const ConsumerItem& camera = scene.pictures.empty() ? scene.consumers[0] : scene.pictures[0];
        const std::vector<LitArea> areas = areas_of(scene);
        ASSERT_EQ(areas.size(), 1u);
        const LitArea& area = areas[0];
        bounded += pixels(area.screen) < 0.5 * 640 * 360 ? 1 : 0;
        for (const InstanceItem& item : scene.instances) {
            for (int k = 0; item.visible && k < 20; ++k) {
                const glm::dvec3 p = random_point(random, item.bounds_ws);
                if (!seen(camera, p) || !shines_on(scene.lights[0], p)) continue;
                ++points;
                const Seen at = seen_at(camera, p);
                EXPECT_TRUE(holds(area.screen, at.px)) << "round " << round << ": " << at.px.x << ", " << at.px.y;
                EXPECT_TRUE(holds(area.reach, at.px));
                EXPECT_GT(at.depth, area.farthest_depth) << "round " << round;
            }
        }
    }
    EXPECT_GT(points, 3000);
    EXPECT_GT(bounded, 100) << "whole pictures would pass too";
}

INSTANTIATE_TEST_SUITE_P(Worlds, LitAreas,
                         ::testing::Values(World::all_receive, World::some_do_not, World::unshadowed,
                                           World::others_look));

/// Returns a lamp above a floor of 100 m and a post, seen from afar.
SceneSnapshot street() {
    SceneSnapshot scene;
    scene.instances.resize(2);
    scene.instances[0].bounds_ws = {{-50.0, -0.1, -100.0}, {50.0, 0.0, 0.0}};
    scene.instances[1].bounds_ws = {{-0.1, 0.0, -40.2}, {0.1, 2.0, -40.0}};  // a post below the lamp
    for (InstanceItem& item : scene.instances) item.casts = item.receives = item.visible = true;
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 2.0, 0.0};
    camera.viewport_px = {640, 360};
    scene.consumers.push_back(camera);
    LightItem lamp;
    lamp.kind = LightKind::spot;
    lamp.position_ws_m = {0.0, 5.0, -40.0};
    lamp.rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    lamp.outer_cone_rad = 0.6;
    lamp.intensity = 1.0f;
    lamp.has_shadow = true;
    scene.lights.push_back(lamp);
    return scene;
}

TEST(LitArea, OfAFarLampWithoutARangeIsThatOfItsConeOnTheGround) {
    SceneSnapshot scene = street();
    const LitArea area = areas_of(scene).at(0);
    // The cone without a floor: from the lamp, 28 pixels above the middle, to the picture's lower edge.
    EXPECT_EQ(area.reach.y, 0);
    EXPECT_NEAR(area.reach.height, 180 + 28, 3);
    EXPECT_GT(area.reach.width, 200);
    EXPECT_LT(area.reach.width, 400);
    // The cone's disc of 6.8 m and the post of 2 m, 40 m away: 63 by 24 pixels.
    EXPECT_GT(area.screen.width, 60);
    EXPECT_LT(area.screen.width, 130);
    EXPECT_GT(area.screen.height, 20);
    EXPECT_LT(area.screen.height, 65);
    EXPECT_GT(area.farthest_depth, 0.0f);
    // The same from all that it lights: a light without a shadow has no receivers.
    scene.lights[0].has_shadow = false;
    const LitArea unshadowed = areas_of(scene).at(0);
    EXPECT_GE(pixels(unshadowed.screen), 0.9 * pixels(area.screen));
    EXPECT_LE(pixels(unshadowed.screen), 1.3 * pixels(area.screen));
    // Control: seen to the side, the same lamp lights nothing of the picture.
    scene.consumers[0].rotation_ws = math::basis_from_back({1.0, 0.0, 0.0});
    EXPECT_EQ(areas_of(scene).at(0).screen.width, 0);
}

TEST(LitArea, HoldsWhatTakesNoShadowToo) {
    SceneSnapshot scene = street();
    const double before = pixels(areas_of(scene).at(0).screen);
    scene.instances[0].receives = false;  // the floor is lit, and not shadowed
    EXPECT_GE(pixels(areas_of(scene).at(0).screen), 0.9 * before);
    // Control: an invisible floor is not lit.
    scene.instances[0].visible = false;
    EXPECT_LT(pixels(areas_of(scene).at(0).screen), 0.6 * before);
}

TEST(LitArea, StaysWhereItIsWhileAReceiverMovesLittle) {
    SceneSnapshot scene = street();
    const LitArea before = areas_of(scene).at(0);
    int moved = 0;
    for (int i = 1; i <= 20; ++i) {
        scene.instances[1].bounds_ws.max.y = 2.0 + 0.001 * i;  // 0.01 pixels
        moved += areas_of(scene).at(0).screen == before.screen ? 0 : 1;
    }
    EXPECT_LE(moved, 1) << "a step of the grid at most";
}

TEST(LitArea, IsTheWholePictureForSunsAndAllThatIsReachedForLightsOfMoreThanTheLimits) {
    SceneSnapshot scene = street();
    const gl::Rect whole{0, 0, 640, 360};
    scene.lights[0].kind = LightKind::directional;
    EXPECT_EQ(areas_of(scene).at(0).screen, whole);
    scene = street();
    const InstanceItem post = scene.instances[1];
    scene.lights[0].has_shadow = false;
    while (scene.instances.size() < kMostLitInstances) scene.instances.push_back(post);
    LitArea area = areas_of(scene).at(0);
    EXPECT_LT(pixels(area.screen), 0.5 * pixels(area.reach));
    scene.instances.push_back(post);
    area = areas_of(scene).at(0);
    EXPECT_EQ(area.screen, area.reach);
    EXPECT_LT(area.reach.width, 640);
    scene.lights[0].kind = LightKind::point;
    EXPECT_EQ(areas_of(scene).at(0).screen, whole);
}

TEST(LitArea, OfSeveralCamerasIsThatOfEach) {
    SceneSnapshot scene = street();
    const LitArea alone = areas_of(scene).at(0);
    ConsumerItem away = scene.consumers[0];
    away.rotation_ws = math::basis_from_back({0.0, 0.0, -1.0});
    away.position_ws_m.z = -80.0;  // sees the lamp from the other side
    scene.consumers.push_back(away);
    const std::vector<LitArea> both = areas_of(scene);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_GE(pixels(both[0].screen), pixels(alone.screen));
    EXPECT_LE(pixels(both[0].screen), 2.0 * pixels(alone.screen));
    EXPECT_GT(both[1].screen.width, 0);
    EXPECT_LT(both[1].screen.width, 200);
}

}  // namespace
}  // namespace gnomon::shadow
