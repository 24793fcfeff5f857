#include "sample_game/game/rules.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "sample_game/game/scripted_walk.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::game {
namespace {

constexpr double kHalfPi = 0.5 * glm::pi<double>();

assets::Mesh box_mesh(const std::string& name, const glm::vec3& min, const glm::vec3& max) {
    assets::Mesh mesh;
    mesh.name = name;
    for (unsigned i = 0; i < 8; ++i)
        mesh.vertices.push_back({.position_ms = {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z}});
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    mesh.submeshes = {{0, 36, 0}};
    mesh.bounds_ms = {glm::dvec3(min), glm::dvec3(max)};
    return mesh;
}

assets::Node& add_node(assets::SceneData& scene, const std::string& name, const glm::dvec3& at_m) {
    assets::Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.translation_m = at_m;
    return node;
}

/// Makes a level with a walker at the origin that looks along +X, and a wall 4 m ahead. A spot 6 m behind and 3 m up
/// shines on the walker. `crate`: a crate stands between the two.
Level small_level(bool crate) {
    assets::SceneData scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(box_mesh("wall", {-0.5f, -0.1f, -3.0f}, {0.5f, 3.0f, 3.0f}));
    scene.meshes.push_back(box_mesh("crate", {-0.5f, 0.0f, -1.0f}, {0.5f, 2.5f, 1.0f}));
    add_node(scene, "wall", {4.5, 0.0, 0.0}).mesh = 0;
    const glm::dquat down_east = glm::angleAxis(-kHalfPi, glm::dvec3(0.0, 1.0, 0.0)) *
                                 glm::angleAxis(-std::atan2(2.0, 6.0), glm::dvec3(1.0, 0.0, 0.0));
    assets::Node& lamp = add_node(scene, "lamp", {-6.0, 3.0, 0.0});
    lamp.rotation = down_east;
    lamp.light = 0;
    assets::LightData& light = scene.lights.emplace_back();
    light.type = assets::LightType::spot;
    light.intensity = 6000.0f;
    light.inner_cone_rad = 0.3f;
    light.outer_cone_rad = 0.4f;
    if (crate) add_node(scene, "crate", {-1.5, 0.0, 0.0}).mesh = 1;
    Level level{.nodes = scene.nodes,
                .occluders = Occluders(scene, {}),
                .solids = {{0, scene.meshes[0].bounds_ms.min, scene.meshes[0].bounds_ms.max}},
                .lamps = {{1, scene.lights[0]}},
                .start_yaw_rad = -kHalfPi,
                .goal = {{100.0, 0.0, 0.0}, {101.0, 1.0, 1.0}}};
    return level;
}

Level courtyard() {
    auto scene = load_game_scene();
    EXPECT_TRUE(scene) << to_line(scene.error());
    auto level = courtyard_level(scene.value());
    EXPECT_TRUE(level) << to_line(level.error());
    return std::move(level).value();
}

void play(Game& game, const GameInput& input, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kStep_s); ++i) game.step(input);
}

/// Plays the walk of --demo to its end.
std::vector<GameState> demo(const Level& level) {
    Game game(level);
    std::vector<GameState> states{game.state()};
    while (game.state().phase == Phase::playing && states.size() < 60u * 60u) {
        game.step(demo_input(game.state()));
        states.push_back(game.state());
    }
    return states;
}

TEST(Game, AWallStopsTheWalkerAtArmsLengthOfItsFace) {
    Level level = small_level(true);
    level.lamps.clear();
    Game game(level);
    play(game, {.forward = 1.0}, 5.0);
    EXPECT_NEAR(game.state().feet_m.x, 3.7, 1e-9);
    level.solids.clear();
    Game free(level);
    play(free, {.forward = 1.0}, 5.0);
    EXPECT_GT(free.state().feet_m.x, 12.0);
}

TEST(Game, AlongAWallTheWalkerSlides) {
    Level level = small_level(true);
    level.lamps.clear();
    Game game(level);
    play(game, {.forward = 1.0, .right = 0.5}, 2.5);
    EXPECT_NEAR(game.state().feet_m.x, 3.7, 1e-9);
    EXPECT_GT(game.state().feet_m.z, 1.0);
}

TEST(Game, ATurnedSolidIsMetAtItsOwnFaces) {
    Level level = small_level(true);
    level.lamps.clear();
    level.nodes[0].rotation = glm::angleAxis(0.25 * glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0));
    Game game(level);
    play(game, {.forward = 1.0}, 1.2);
    // The near long face runs at 45 degrees: the foot stops 0.3 m off it, then slides along.
    const glm::dvec3 normal(-std::sqrt(0.5), 0.0, std::sqrt(0.5));
    EXPECT_NEAR(glm::dot(game.state().feet_m - glm::dvec3(4.5, 0.0, 0.0), normal), 0.8, 0.5);
    play(game, {.forward = 1.0}, 3.0);
    EXPECT_GT(std::abs(game.state().feet_m.z), 0.5);
}

TEST(Game, InTheLampsConeTheMeterFillsAndBehindACrateItDoesNot) {
    Game lit(small_level(false)), hidden(small_level(true));
    lit.step({});
    hidden.step({});
    EXPECT_DOUBLE_EQ(lit.state().light, 1.0);
    EXPECT_DOUBLE_EQ(hidden.state().light, 0.0);
    play(hidden, {}, 10.0);
    EXPECT_EQ(hidden.state().phase, Phase::playing);
    EXPECT_EQ(hidden.state().seen, 0.0);
}

TEST(Game, OutOfTheConeItIsDark) {
    Level level = small_level(false);
    level.start_m.z = 8.0;
    EXPECT_EQ(Game(level).state().light, 0.0);
}

TEST(Game, ALightSqueezedThroughTheEdgeOfTheCrateCountsByItsShare) {
    Level level = small_level(true);
    level.start_m.z = 1.4;  // the crate's shadow ends at z = 1.5 there: one shoulder is out of it
    const double light = Game(level).state().light;
    EXPECT_GT(light, 0.0);
    level.occluders = Occluders(assets::SceneData{}, {});
    EXPECT_LT(light, 0.5 * Game(level).state().light);
}

TEST(Game, DetectionRisesInLightAndFallsInShadow) {
    Level level = small_level(true);
    level.solids.clear();
    level.start_m = {0.0, 0.0, 2.0};
    level.start_yaw_rad = 0.0;
    Game game(level);
    play(game, {}, 1.0);
    const double risen = game.state().seen;
    EXPECT_GT(risen, 0.2);
    EXPECT_EQ(game.state().phase, Phase::playing);
    play(game, {.forward = 1.0}, 0.7);
    EXPECT_LT(game.state().light, kHiddenLight);
    const double before = game.state().seen;
    play(game, {}, 0.5);
    EXPECT_LT(game.state().seen, before);
}

TEST(Game, WhoStaysInTheLightLosesAndThenStandsStillUntilRestart) {
    Game game(small_level(false));
    play(game, {}, 3.0);
    EXPECT_EQ(game.state().phase, Phase::lost);
    const GameState end = game.state();
    EXPECT_NEAR(end.time_s(), 2.0, 0.05);
    play(game, {.forward = 1.0, .yaw_rad = 0.1, .toggle_pause = true}, 1.0);
    EXPECT_EQ(game.state(), end);
    game.step({.restart = true});
    EXPECT_EQ(game.state(), Game(small_level(false)).state());
}

TEST(Game, ReachingTheGoalWins) {
    Level level = small_level(true);
    level.lamps.clear();
    level.goal = {{2.0, -1.0, -1.0}, {3.0, 1.0, 1.0}};
    Game game(level);
    play(game, {.forward = 1.0}, 0.5);
    EXPECT_EQ(game.state().phase, Phase::playing);
    play(game, {.forward = 1.0}, 0.5);
    EXPECT_EQ(game.state().phase, Phase::won);
    EXPECT_NEAR(game.state().feet_m.x, 2.0, 0.1);
}

TEST(Game, PauseStopsTimeAndEverythingElse) {
    Game game(courtyard());
    play(game, {.forward = 1.0}, 0.5);
    game.step({.toggle_pause = true});
    const GameState paused = game.state();
    EXPECT_EQ(paused.phase, Phase::paused);
    play(game, {.forward = 1.0, .yaw_rad = 0.01, .sun = 1.0}, 1.0);
    EXPECT_EQ(game.state(), paused);
    game.step({.toggle_pause = true});
    EXPECT_EQ(game.state().phase, Phase::playing);
    EXPECT_EQ(game.state().steps, paused.steps + 1);
}

TEST(Game, TheSunTurnsWithinItsBoundsAndTheMeterIgnoresIt) {
    Game game(courtyard());
    const double light = game.state().light;
    play(game, {.sun = 1.0}, 2.0);
    EXPECT_NEAR(game.state().sun_hours, 2.0, 0.05);
    play(game, {.sun = 1.0}, 30.0);
    EXPECT_EQ(game.state().sun_hours, 3.0);
    EXPECT_NEAR(game.state().light, light, 0.2);
}

TEST(Courtyard, TheDemoWinsUnseenAndItsWalkIsTheSameBitForBit) {
    const Level level = courtyard();
    const std::vector<GameState> once = demo(level), again = demo(level);
    ASSERT_EQ(once.back().phase, Phase::won);
    EXPECT_EQ(once, again);
    double most_seen = 0.0;
    for (const GameState& state : once) most_seen = std::max(most_seen, state.seen);
    EXPECT_LT(most_seen, 0.5);
    EXPECT_LT(once.back().time_s(), 30.0);
}

TEST(Courtyard, WithoutTheScreensTheDemoIsCaught) {
    auto scene = load_game_scene();
    ASSERT_TRUE(scene);
    for (assets::Node& node : scene.value().nodes)
        if (node.name.starts_with("screen")) node.casts_shadow = false;
    const auto level = courtyard_level(scene.value());
    ASSERT_TRUE(level);
    EXPECT_EQ(demo(level.value()).back().phase, Phase::lost);
}

TEST(Courtyard, TheStraightWayThroughTheMiddleIsCaught) {
    Game game(courtyard());
    play(game, {.yaw_rad = 0.0}, kStep_s * 1.5);
    game.step({.forward = 1.0, .yaw_rad = 0.78});
    play(game, {.forward = 1.0}, 10.0);
    EXPECT_EQ(game.state().phase, Phase::lost);
}

TEST(Courtyard, TheWalkerCannotLeaveItButByTheGate) {
    Level level = courtyard();
    level.lamps.clear();
    for (int direction = 0; direction < 16; ++direction) {
        level.start_m = {-6.0, 0.0, 7.5};
        level.start_yaw_rad = glm::pi<double>() * direction / 8.0;
        Game game(level);
        play(game, {.forward = 1.0, .run = true}, 12.0);
        EXPECT_LT(game.state().feet_m.z, 10.5) << direction;
        EXPECT_GT(game.state().feet_m.z, -10.0) << direction;
        EXPECT_GT(game.state().feet_m.x, -10.0) << direction;
    }
}

TEST(Courtyard, TheCameraStandsBehindThePlayerAndNeverInAWall) {
    Level level = courtyard();
    level.start_m = {-9.5, 0.0, 3.0};
    level.start_yaw_rad = -kHalfPi;
    const glm::dvec3 at = Game(level).camera_m();
    EXPECT_GT(at.x, -10.0);
    level.solids.clear();
    EXPECT_LT(Game(level).camera_m().x, -12.0);
}

/// Makes the courtyard with the start before the flight of stairs, looking up along it.
Level before_the_stairs() {
    Level level = courtyard();
    level.lamps.clear();
    level.start_m = {4.6, 0.0, -3.4};
    level.start_yaw_rad = -kHalfPi;
    return level;
}

TEST(Courtyard, TheStairsAreWalkedUpAndDownAgainAtTheSpeedOfTheFlat) {
    constexpr double kLanding_m = 8 * 0.18;
    for (const bool run : {false, true}) {
        Game game(before_the_stairs());
        double last_m = 0.0;
        for (int i = 0; i < 90; ++i) {
            game.step({.forward = 1.0, .run = run});
            EXPECT_GE(game.state().feet_m.y, last_m);
            EXPECT_LT(game.state().feet_m.y - last_m, 0.06) << "the camera jerks";
            last_m = game.state().feet_m.y;
        }
        EXPECT_NEAR(last_m, kLanding_m, 1e-6);
        EXPECT_NEAR(game.state().feet_m.x, run ? 9.7 : 4.6 + 1.5 * 2.6, 0.02);  // run: at the wall
        for (int i = 0; i < 180; ++i) game.step({.forward = -1.0, .run = run});
        EXPECT_EQ(game.state().feet_m.y, 0.0);
        EXPECT_LT(game.state().feet_m.x, 5.0);
    }
}

TEST(Courtyard, OffTheLandingTheWalkerFallsAndItsRailHolds) {
    Game walker(before_the_stairs());
    play(walker, {.forward = 1.0}, 1.6);
    ASSERT_GT(walker.state().feet_m.y, 1.4);
    Game other = walker;
    play(walker, {.right = -1.0}, 1.5);
    EXPECT_EQ(walker.state().feet_m.y, 0.0);
    EXPECT_LT(walker.state().feet_m.z, -4.8);
    play(other, {.right = 1.0}, 3.0);
    EXPECT_NEAR(other.state().feet_m.y, 1.44, 1e-6);
    EXPECT_LT(other.state().feet_m.z, -2.5);
}

TEST(Courtyard, WhatIsHigherThanAStepStaysAWallFromEverySide) {
    Level level = before_the_stairs();
    level.start_m = {9.0, 0.0, -0.5};
    level.start_yaw_rad = 0.0;  // the landing's side, 1.44 m high
    Game game(level);
    play(game, {.forward = 1.0}, 3.0);
    EXPECT_EQ(game.state().feet_m.y, 0.0);
    EXPECT_GT(game.state().feet_m.z, -2.2);
}

TEST(Courtyard, AFallStandsStillWhilePaused) {
    Game game(before_the_stairs());
    play(game, {.forward = 1.0}, 1.6);
    for (int i = 0; i < 120 && game.state().fall_m_per_s == 0.0; ++i) game.step({.right = -1.0});
    ASSERT_GT(game.state().fall_m_per_s, 0.0);
    game.step({.toggle_pause = true});
    const GameState paused = game.state();
    play(game, {.right = -1.0}, 1.0);
    EXPECT_EQ(game.state(), paused);
}

TEST(Courtyard, ASceneWithoutThePlayerIsNoLevel) {
    const auto scene = load_scene(std::nullopt);
    ASSERT_TRUE(scene);
    const auto level = courtyard_level(scene.value());
    ASSERT_FALSE(level);
    EXPECT_EQ(level.error().rule, "game.level");
}

}  // namespace
}  // namespace gnomon::game
