#include "systems/shadow/culling/occluders.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "engine/math/aabb.h"
#include "tests/unit/shadow/random_scene.h"

/// What occluders hide: never a point that a camera sees past an instance's triangles, and most of what is behind.
namespace gnomon::shadow {
namespace {

/// Mesh of a box with a roof: twice as high as the box inside of it.
constexpr math::Aabb kInner_ms{glm::dvec3(-1.0, 0.0, -1.0), glm::dvec3(1.0, 1.0, 1.0)};
constexpr math::Aabb kMesh_ms{glm::dvec3(-1.0, 0.0, -1.0), glm::dvec3(1.0, 2.0, 1.0)};

InstanceItem house(const glm::dmat3& basis, const glm::dvec3& at_m) {
    InstanceItem item;
    item.basis = basis;
    item.translation_ws_m = at_m;
    item.bounds_ws = math::transformed(kMesh_ms, basis, at_m);
    item.casts = item.receives = item.visible = true;
    return item;
}

/// Returns a house of 10 m before a camera 20 m away.
SceneSnapshot house_ahead() {
    SceneSnapshot scene;
    scene.meshes.inner_boxes_ms = {kInner_ms};
    scene.instances = {house(glm::dmat3(10.0), {0.0, 0.0, -30.0})};
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 2.0, 0.0};
    camera.viewport_px = {640, 360};
    scene.consumers = {camera};
    return scene;
}

std::vector<Occluder> occluders_of(const SceneSnapshot& scene) {
    std::vector<Occluder> occluders;
    find_occluders(scene, scene.consumers[0], occluders);
    return occluders;
}

bool is_hidden(const SceneSnapshot& scene, const std::vector<glm::dvec3>& points_ws) {
    return are_hidden(occluders_of(scene), points_ws);
}

const std::vector<glm::dvec3> kBehind = {{-5.0, 0.0, -60.0}, {5.0, 4.0, -60.0}, {0.0, 8.0, -70.0}};

TEST(Occluders, HideWhatIsBehindTheirBox) {
    EXPECT_TRUE(is_hidden(house_ahead(), kBehind));
    EXPECT_FALSE(is_hidden(house_ahead(), {}));
    for (const glm::dvec3& seen : {glm::dvec3(0.0, 2.0, -10.0), glm::dvec3(40.0, 2.0, -60.0),
                                   glm::dvec3(0.0, 40.0, -60.0), glm::dvec3(0.0, 2.0, 30.0)}) {
        std::vector<glm::dvec3> points = kBehind;
        points.push_back(seen);
        EXPECT_FALSE(is_hidden(house_ahead(), points)) << seen.x << ", " << seen.y << ", " << seen.z;
    }
    EXPECT_FALSE(is_hidden(house_ahead(), {{0.0, 25.0, -60.0}})) << "behind the roof, which no box represents";
}

TEST(Occluders, AreInstancesThatAreSeenAlone) {
    const auto change_hides = [](const auto& change) {
        SceneSnapshot scene = house_ahead();
        change(scene);
        return is_hidden(scene, kBehind);
    };
    EXPECT_TRUE(change_hides([](SceneSnapshot&) {}));
    EXPECT_TRUE(change_hides([](SceneSnapshot& s) { s.instances[0].casts = s.instances[0].receives = false; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].visible = false; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].shadow_catcher = true; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].mesh = kNoMesh; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].drawable.by_depth = true; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.meshes.inner_boxes_ms = {math::Aabb{}}; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.meshes.inner_boxes_ms.clear(); }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.consumers[0].projection = CameraProjection::orthographic; }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].basis[0] = glm::dvec3(0.0); }));
    EXPECT_FALSE(change_hides([](SceneSnapshot& s) { s.instances[0].basis[0].x = std::nan(""); }));
}

TEST(Occluders, AreFartherThanTheNearPlane) {
    SceneSnapshot scene = house_ahead();
    scene.consumers[0].position_ws_m = {0.0, 2.0, -19.0};  // a metre before the wall
    const std::vector<glm::dvec3> behind = {{0.0, 2.0, -60.0}};
    scene.consumers[0].near_m = 0.5;
    EXPECT_TRUE(is_hidden(scene, behind));
    scene.consumers[0].near_m = 0.95;  // its corners are 1.2 m away
    EXPECT_FALSE(is_hidden(scene, behind)) << "the near plane opens the wall";
    scene.consumers[0].near_m = 0.05;
    scene.consumers[0].position_ws_m.z = -21.0;
    EXPECT_FALSE(is_hidden(scene, behind)) << "the camera is inside";
}

TEST(Occluders, AreSmallerThanTheirBoxByTwoPixels) {
    const SceneSnapshot scene = house_ahead();
    // The wall's edge is 10 m aside and 20 m away: a pixel is a twentieth of a metre there, the house's far side twice.
    const auto hidden_at = [&](double aside_m) { return is_hidden(scene, {{3.0 * aside_m, 2.0, -60.0}}); };
    EXPECT_FALSE(hidden_at(9.95));
    EXPECT_TRUE(hidden_at(9.6));
}

TEST(Occluders, AreThoseThatLookLargest) {
    SceneSnapshot scene = house_ahead();
    scene.instances.clear();
    for (int i = 0; i < 100; ++i) scene.instances.push_back(house(glm::dmat3(10.0), {0.0, 0.0, -500.0 + 4.0 * i}));
    const std::vector<Occluder> occluders = occluders_of(scene);
    ASSERT_EQ(occluders.size(), kMostOccluders);
    for (const Occluder& occluder : occluders) EXPECT_LT(occluder.eye_ms.z, (104.0 + 4.0 * kMostOccluders) / 10.0);
    scene.instances = {house(glm::dmat3(10.0), {0.0, 0.0, -1000.0})};
    EXPECT_TRUE(occluders_of(scene).empty()) << "three hundredths of a radian";
}

/// Returns whether the segment meets the box, tested by sampling it: no test of the code's own.
bool meets(const math::Aabb& box, const glm::dvec3& a, const glm::dvec3& b) {
    const Crossing c = crossing(box, a, b);
    return c.from <= c.to;
}

TEST(Occluders, HideNoPointThatIsSeenPastTheirBox) {
    RandomScene random(print_seed());
    int hidden = 0, not_hidden = 0;
    for (int round = 0; round < 4000; ++round) {
        SceneSnapshot scene = random.scene(LightKind::point, 0);
        scene.meshes.inner_boxes_ms = {kInner_ms};
        for (int i = 0; i < 4; ++i) {
            glm::dmat3 basis = glm::mat3_cast(glm::angleAxis(random.number(0.0, 6.0), random.direction()));
            for (int k = 0; k < 3; ++k)
                basis[k] *= random.number(0.3, 6.0) * (random.number(0.0, 1.0) < 0.2 ? -1.0 : 1.0);
            basis[0] += random.number(0.0, 0.5) * basis[1];  // sheared
            scene.instances.push_back(house(basis, random.vector(8.0)));
        }
        const std::vector<Occluder> occluders = occluders_of(scene);
        const glm::dvec3 eye = scene.consumers[0].position_ws_m;
        const glm::dvec3 around = random.vector(20.0);
        std::vector<glm::dvec3> points;
        for (int k = 0; k < 6; ++k) points.push_back(around + random.vector(random.number(0.0, 3.0)));
        if (!are_hidden(occluders, points)) {
            ++not_hidden;
            continue;
        }
        ++hidden;
        for (int k = 0; k < 20; ++k) {
            glm::dvec3 at(0.0);
            double sum = 0.0;
            for (const glm::dvec3& point : points) {
                const double weight = random.number(0.0, 1.0);
                at += weight * point;
                sum += weight;
            }
            at /= sum;
            const bool behind_any =
                std::any_of(scene.instances.begin(), scene.instances.end(), [&](const InstanceItem& item) {
                    const glm::dmat3 to_mesh = glm::inverse(item.basis);
                    return meets(kInner_ms, to_mesh * (eye - item.translation_ws_m),
                                 to_mesh * (at - item.translation_ws_m));
                });
            EXPECT_TRUE(behind_any) << "round " << round;
        }
    }
    EXPECT_GT(hidden, 100);
    EXPECT_GT(not_hidden, 1000);
}

/// Adds a lamp above a receiver behind the house.
SceneSnapshot lamp_behind_house() {
    SceneSnapshot scene = house_ahead();
    InstanceItem yard = scene.instances[0];
    yard.mesh = 1;
    yard.bounds_ws = {{-4.0, 0.0, -60.0}, {4.0, 0.1, -52.0}};
    scene.instances.push_back(yard);
    scene.meshes.inner_boxes_ms.emplace_back();
    LightItem lamp;
    lamp.kind = LightKind::spot;
    lamp.position_ws_m = {0.0, 4.0, -56.0};
    lamp.rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    lamp.outer_cone_rad = 0.6;
    lamp.range_m = 8.0;
    lamp.intensity = 1.0f;
    lamp.has_shadow = true;
    scene.lights = {lamp};
    return scene;
}

struct Selected {
    Reason skip;
    LitArea area;
};
Selected selected(const SceneSnapshot& scene) {
    FitStages stages;
    stages.decide(scene);
    stages.select(scene);
    return {stages.frame.statuses[0].skipped(), stages.frame.sets.lit_areas.at(0)};
}

TEST(Occluders, LeaveOutLightsWithReceiversBehindThem) {
    SceneSnapshot scene = lamp_behind_house();
    EXPECT_EQ(selected(scene).skip, Reason::no_visible_receiver);
    EXPECT_EQ(selected(scene).area.screen.width, 0);
    scene.lights[0].has_shadow = false;
    EXPECT_EQ(selected(scene).area.screen.width, 0) << "nor is it drawn without a shadow";
    // Control: without the house's inside, as for a house that is open.
    scene = lamp_behind_house();
    scene.meshes.inner_boxes_ms.clear();
    EXPECT_NE(selected(scene).skip, Reason::no_visible_receiver);
    EXPECT_GT(selected(scene).area.screen.width, 0);
    scene.lights[0].has_shadow = false;
    EXPECT_GT(selected(scene).area.screen.width, 0);
}

TEST(Occluders, OfOneCameraHideNothingFromOthers) {
    SceneSnapshot scene = lamp_behind_house();
    ConsumerItem other = scene.consumers[0];
    other.position_ws_m = {30.0, 2.0, -80.0};
    other.rotation_ws = math::basis_from_back({1.0, 0.0, -1.0});
    scene.consumers.push_back(other);
    EXPECT_NE(selected(scene).skip, Reason::no_visible_receiver);
    scene.consumers.pop_back();
    scene.pictures = {other};  // shadows are fitted to the first, and the other draws
    EXPECT_NE(selected(scene).skip, Reason::no_visible_receiver);
}

}  // namespace
}  // namespace gnomon::shadow
