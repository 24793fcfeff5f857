#include "systems/visibility/light_queries.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "tests/unit/allocation_counter.h"
#include "tests/unit/rays/triangle_soup.h"
#include "tests/unit/visibility/query_scene.h"

namespace gnomon::visibility {
namespace {

using test::QueryScene;

/// Makes a cube of 1 m with its middle 1 m above the origin.
QueryScene cube_scene() {
    QueryScene scene;
    scene.place(scene.add_cube(), {0.0, 1.0, 0.0});
    scene.finish();
    return scene;
}

constexpr Place kBelow{{0.1, 0.0, 0.2}}, kBeside{{1.0, 0.0, 0.2}};

TEST(LightQueries, ACasterDarkensWhatIsBehindItAndNothingElse) {
    const QueryScene scene = cube_scene();
    for (const LightItem& light :
         {scene.sun({0.0, 1.0, 0.0}), scene.lamp({0.0, 5.0, 0.0}), scene.spot({0.0, 5.0, 0.0}, {0.0, 1.0, 0.0}, 0.5)}) {
        EXPECT_EQ(scene.ask(light, kBelow), 0.0f);
        EXPECT_EQ(scene.ask(light, kBeside), 1.0f);
        EXPECT_EQ(scene.ask(light, Place{{0.1, 2.0, 0.2}}), 1.0f) << "it lies before the caster";
    }
    EXPECT_EQ(scene.ask(scene.lamp({0.0, 1.0, 0.0}), kBelow), 0.0f) << "a lamp in a closed box";
    EXPECT_EQ(scene.ask(scene.lamp({0.0, 0.3, 0.0}), kBelow), 1.0f) << "a lamp below it";
}

TEST(LightQueries, ASurfaceSeesOnlyThePartOfASourceThatIsBeforeIt) {
    const QueryScene scene = cube_scene();
    LightItem sun = scene.sun({0.0, 1.0, 0.0});
    sun.sun_radius_rad = 0.1f;
    // A side of the cube: half of the sun is behind its plane, and the cube stands before that half.
    const glm::dvec3 side_m{0.5, 1.0, 0.2};
    EXPECT_NEAR(scene.ask(sun, Place{side_m}, {.samples = 64}), 0.5f, 0.05f) << "a place in the air";
    EXPECT_EQ(scene.ask(sun, Place{side_m, 0.0, {1.0, 0.0, 0.0}}, {.samples = 64}), 1.0f);
    EXPECT_EQ(scene.ask(sun, Place{side_m, 0.0, {0.0, -1.0, 0.0}}, {.samples = 64}), 0.0f) << "all is behind it";
}

TEST(LightQueries, WithoutTheCasterItIsLight) {
    QueryScene scene = cube_scene();
    const LightItem sun = scene.sun({0.0, 1.0, 0.0});
    CasterTrees trees(scene.library);
    LightQueries queries(trees);
    float answer = -1.0f;
    const auto ask = [&] {
        ++scene.snapshot.version;
        scene.snapshot.tree_version = scene.snapshot.version;
        queries.ask(scene.snapshot, sun, std::span(&kBelow, 1), {}, std::span(&answer, 1));
        return answer;
    };
    EXPECT_EQ(ask(), 0.0f);
    scene.snapshot.instances[0].casts = false;
    EXPECT_EQ(ask(), 1.0f);
    scene.snapshot.instances[0].casts = true;
    scene.snapshot.instances[0].visible = false;
    EXPECT_EQ(ask(), 0.0f) << "an unseen caster still casts";
    scene.snapshot.instances[0].translation_ws_m.x += 3.0;
    scene.finish();
    EXPECT_EQ(ask(), 1.0f) << "it has moved away";
    scene.snapshot.instances.clear();
    scene.finish();
    EXPECT_EQ(ask(), 1.0f);
}

TEST(LightQueries, RangeConeAndLayersDecideAsInThePicture) {
    const QueryScene scene = cube_scene();
    LightItem lamp = scene.lamp({4.0, 0.0, 0.2});
    lamp.range_m = 3.001;
    EXPECT_EQ(scene.ask(lamp, kBeside), 1.0f);
    lamp.range_m = 2.999;
    EXPECT_EQ(scene.ask(lamp, kBeside), 0.0f);
    const LightItem spot = scene.spot({3.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.3);
    EXPECT_EQ(scene.ask(spot, Place{{3.0, 0.0, -2.0}}), 1.0f);
    EXPECT_EQ(scene.ask(spot, Place{{3.0, 0.0, 2.0}}), 0.0f) << "behind the lamp";
    EXPECT_EQ(scene.ask(spot, Place{{3.0 + 2.0 * std::tan(0.299), 0.0, -2.0}}), 1.0f);
    EXPECT_EQ(scene.ask(spot, Place{{3.0 + 2.0 * std::tan(0.301), 0.0, -2.0}}), 0.0f);
    QueryScene layered = cube_scene();
    layered.snapshot.instances[0].cast_layers = 0x02;
    LightItem sun = layered.sun({0.0, 1.0, 0.0});
    sun.shadow.layers = 0x02;
    EXPECT_EQ(layered.ask(sun, kBelow), 0.0f);
    sun.shadow.layers = 0x01;
    EXPECT_EQ(layered.ask(sun, kBelow), 1.0f) << "a caster of no layer of the light";
}

TEST(LightQueries, LookThroughMaskedTexelsAndBlendedSurfaces) {
    QueryScene scene;
    scene.library.textures.push_back({"", 2, 1, {0, 0, 0, 255, 0, 0, 0, 0}});
    scene.library.textures[0].linear_filter = false;
    scene.library.textures[0].wrap_u = assets::TextureWrap::clamp;
    assets::Material& leaf = scene.library.materials.emplace_back();
    leaf.alpha_mode = assets::AlphaMode::mask;
    leaf.base_colour_texture = 0;
    scene.library.materials.emplace_back().alpha_mode = assets::AlphaMode::blend;
    const glm::dmat3 lying({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    scene.place(scene.add_square(1), {0.0, 1.0, 0.0}, lying);
    scene.place(scene.add_square(2), {0.0, 2.0, 0.0}, lying);
    scene.finish();
    const LightItem sun = scene.sun({0.0, 1.0, 0.0});
    EXPECT_EQ(scene.ask(sun, Place{{-0.3, 0.0, 0.1}}), 0.0f);
    EXPECT_EQ(scene.ask(sun, Place{{0.3, 0.0, 0.1}}), 1.0f);
    scene.library.materials[1].alpha_cutoff = 0.0f;
    EXPECT_EQ(scene.ask(sun, Place{{0.3, 0.0, 0.1}}), 0.0f) << "nothing is below a cutoff of 0";
    EXPECT_EQ(scene.ask(sun, Place{{0.3, 1.5, 0.1}}), 1.0f) << "the blended one lets all through";
}

TEST(LightQueries, LookThroughVerticesThatAreClear) {
    QueryScene scene;
    scene.library.materials.emplace_back().alpha_mode = assets::AlphaMode::mask;
    const std::uint32_t square = scene.add_square(1);
    for (const assets::Vertex& vertex : scene.library.meshes[square].vertices)
        scene.library.meshes[square].colours.emplace_back(1.0f, 1.0f, 1.0f, vertex.position_ms.x < 0.0f ? 1.0f : 0.0f);
    scene.place(square, {0.0, 1.0, 0.0}, glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
    scene.finish();
    const LightItem sun = scene.sun({0.0, 1.0, 0.0});
    EXPECT_EQ(scene.ask(sun, Place{{-0.1, 0.0, 0.1}}), 0.0f) << "alpha of 0.6, or more if it is smaller";
    EXPECT_EQ(scene.ask(sun, Place{{0.1, 0.0, 0.1}}), 1.0f);
}

TEST(LightQueries, BothFacesCastAndWhatAPlaceLiesOnDoesNot) {
    QueryScene scene;
    scene.place_floor(10.0);
    scene.finish();
    EXPECT_EQ(scene.ask(scene.sun({0.0, 1.0, 0.0}), kBelow), 1.0f) << "it lies on the floor";
    EXPECT_EQ(scene.ask(scene.sun({0.0, 1.0, 0.0}), Place{{0.1, -1e-9, 0.2}}), 0.0f) << "a hair below";
    EXPECT_EQ(scene.ask(scene.sun({0.0, 1.0, 0.0}), Place{{0.1, -1e-9, 0.2}}, {.nearest_m = 1e-6}), 1.0f);
    EXPECT_EQ(scene.ask(scene.sun({0.0, 1.0, 0.0}), Place{{0.1, -1.0, 0.2}}), 0.0f) << "from its back";
    EXPECT_EQ(scene.ask(scene.lamp({0.0, -2.0, 0.0}), Place{{0.1, 1.0, 0.2}}), 0.0f);
    QueryScene mirrored;
    mirrored.place(mirrored.add_cube(), {0.0, 1.0, 0.0}, glm::dmat3({-2, 0, 0}, {0, 1, 0}, {0.5, 0, 1}));
    mirrored.finish();
    EXPECT_EQ(mirrored.ask(mirrored.sun({0.0, 1.0, 0.0}), Place{{-0.9, 0.0, 0.1}}), 0.0f);
    EXPECT_EQ(mirrored.ask(mirrored.sun({0.0, 1.0, 0.0}), Place{{-1.4, 0.0, 0.1}}), 1.0f);
}

TEST(LightQueries, WhatIsNotFiniteIsDark) {
    const QueryScene scene = cube_scene();
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    std::vector<Place> places{
        kBeside, {{nan, 0.0, 0.0}}, kBeside, {{0.0, infinity, 0.0}}, {{0.0, 0.0, -infinity}}, {{1e300, 1e300, 0.0}},
        kBelow};
    const auto expect = [&](const LightItem& light, std::vector<float> wanted) {
        EXPECT_EQ(scene.ask(light, places), wanted);
        LightItem broken = light;
        broken.rotation_ws[2].x = nan;
        broken.position_ws_m.y = nan;
        EXPECT_THAT(scene.ask(broken, places), testing::Each(0.0f));
    };
    expect(scene.sun({0.0, 1.0, 0.0}), {1, 0, 1, 0, 0, 1, 0});
    expect(scene.lamp({0.0, 5.0, 0.0}), {1, 0, 1, 0, 0, 1, 0});
    EXPECT_EQ(scene.ask(scene.lamp(kBeside.at_ws_m), kBeside), 0.0f) << "where the lamp is, no direction leads to it";
    EXPECT_EQ(scene.ask(scene.lamp({0, 5, 0}), std::span<const Place>()).size(), 0u);
}

TEST(LightQueries, OfAnEmptySceneAllIsLit) {
    QueryScene scene;
    scene.finish();
    EXPECT_EQ(scene.ask(scene.sun({0.0, 1.0, 0.0}), kBelow), 1.0f);
    EXPECT_EQ(scene.ask(scene.lamp({0.0, 5.0, 0.0}), kBelow), 1.0f);
}

/// Makes instances of soups, masked and not, turned, stretched and mirrored in any way, some within each other.
QueryScene random_scene(std::uint64_t seed, double offset_m) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    QueryScene scene;
    scene.offset_m = glm::dvec3(offset_m, -0.5 * offset_m, 0.25 * offset_m);
    scene.library.textures.push_back({"", 2, 2, {0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255}});
    assets::Material& masked = scene.library.materials.emplace_back();
    masked.alpha_mode = assets::AlphaMode::mask;
    masked.base_colour_texture = 0;
    for (int mesh = 0; mesh < 4; ++mesh) {
        const auto kind = static_cast<test::Soup>(random() % static_cast<std::uint64_t>(test::Soup::count));
        scene.library.meshes.push_back(test::soup(kind, 60, 1.0, random));
        assets::Mesh& made = scene.library.meshes.back();
        made.submeshes[0].material = mesh == 3 ? 1 : 0;
        for (assets::Vertex& vertex : made.vertices) vertex.uv = {vertex.position_ms.x, vertex.position_ms.z};
    }
    for (int i = 0; i < 12; ++i) {
        glm::dmat3 basis(1.0);
        for (int column = 0; column < 3; ++column)
            basis[column] = glm::dvec3(share(random), share(random), share(random)) * 1.5;
        if (std::abs(glm::determinant(basis)) < 1e-3) basis = glm::dmat3(1.0);
        scene.place(static_cast<std::uint32_t>(i % 4), glm::dvec3(share(random), share(random), share(random)) * 4.0,
                    basis);
    }
    scene.finish();
    return scene;
}

std::vector<Place> random_places(const QueryScene& scene, std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(-5.0, 5.0);
    std::vector<Place> places(count);
    for (Place& place : places)
        place.at_ws_m = scene.offset_m + glm::dvec3(share(random), share(random), share(random));
    return places;
}

std::vector<LightItem> lights_of(const QueryScene& scene) {
    LightItem lamp = scene.lamp({1.0, 2.0, -0.5});
    lamp.range_m = 6.0;
    return {scene.sun({0.3, 1.0, 0.2}), lamp, scene.spot({-1.0, 6.0, 0.5}, {-0.1, 1.0, 0.1}, 0.9)};
}

TEST(LightQueries, AgreeWithTheReferenceOnRandomScenesHereAndFarAway) {
    for (const double offset_m : {0.0, 1e8}) {
        test::Agreement agreement;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const QueryScene scene = random_scene(seed, offset_m);
            const oracle::TracedWorld world(scene.snapshot, scene.library, scene.offset_m);
            const std::vector<Place> places = random_places(scene, 1000, seed);
            const std::size_t before = agreement.wrong;
            for (const LightItem& light : lights_of(scene))
                test::compare(world, light, places, scene.ask(light, places), 10.0, agreement);
            EXPECT_EQ(agreement.wrong, before) << "seed " << seed << " at " << offset_m << " m";
        }
        EXPECT_LE(agreement.ambiguous, 60u) << "one in a thousand, at " << offset_m << " m";
        EXPECT_GT(agreement.lit, 5000u);
        EXPECT_GT(agreement.dark, 5000u);
    }
}

TEST(LightQueries, DependOnNeitherBatchesNorOrderNorThreadsNorTheTree) {
    QueryScene scene = random_scene(5, 0.0);
    std::vector<Place> places = random_places(scene, 5000, 5);
    for (std::size_t i = 0; i < places.size(); i += 3) places[i].radius_m = 0.2;
    for (LightItem light : lights_of(scene)) {
        light.source_radius_m = 0.1f;
        const std::vector<float> answers = scene.ask(light, places);
        EXPECT_EQ(scene.ask(light, places, {.threads = 3}), answers);
        for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(scene.ask(light, places[i]), answers[i]) << i;
        std::vector<Place> turned(places.rbegin(), places.rend());
        std::vector<float> back = scene.ask(light, turned);
        std::reverse(back.begin(), back.end());
        EXPECT_EQ(back, answers);
        scene.snapshot.tree_version = 0;
        EXPECT_EQ(scene.ask(light, places), answers) << "without the instances' tree";
        scene.snapshot.tree_version = scene.snapshot.version;
    }
}

TEST(LightQueries, OfASourceWithASizeCountTheShareThatIsSeen) {
    QueryScene scene;
    scene.place(scene.add_square(), {5.0, 2.0, 0.0}, glm::dmat3({10, 0, 0}, {0, 0, -10}, {0, 1, 0}));  // x from 0
    scene.finish();
    LightItem lamp = scene.lamp({0.0, 4.0, 0.0});
    lamp.source_radius_m = 1.0f;
    LightItem sun = scene.sun({0.0, 1.0, 0.0});
    sun.sun_radius_rad = 0.1f;
    const QueryOptions many{.samples = 400};
    for (const LightItem& light : {lamp, sun}) {
        EXPECT_EQ(scene.ask(light, Place{{-3.0, 0.0, 0.0}}, many), 1.0f);
        EXPECT_EQ(scene.ask(light, Place{{3.0, 0.0, 0.0}}, many), 0.0f);
        EXPECT_NEAR(scene.ask(light, Place{{0.0, 0.0, 0.0}}, many), 0.5f, 0.02f);
        EXPECT_NEAR(scene.ask(light, Place{{0.0, 0.0, 0.0}}), 0.5f, 0.13f) << "16 samples";
    }
    // Half a radius beyond the edge the disk is cut at x = 0.5 r: 1/2 - (asin(1/2) + 1/2 sqrt(3/4)) / pi of it is seen.
    const float segment = static_cast<float>(0.5 - (std::asin(0.5) + 0.5 * std::sqrt(0.75)) / glm::pi<double>());
    EXPECT_NEAR(scene.ask(lamp, Place{{0.5, 0.0, 0.0}}, many), segment, 0.02f);
    EXPECT_NEAR(scene.ask(sun, Place{{std::tan(0.1), 0.0, 0.0}}, many), segment, 0.02f);
}

TEST(LightQueries, OfASphereCountTheShareOfItThatIsReached) {
    QueryScene scene;
    scene.place(scene.add_square(), {5.0, 2.0, 0.0}, glm::dmat3({10, 0, 0}, {0, 0, -10}, {0, 1, 0}));  // x from 0
    scene.finish();
    const QueryOptions many{.samples = 400};
    const LightItem sun = scene.sun({0.0, 1.0, 0.0});
    EXPECT_NEAR(scene.ask(sun, Place{{0.0, 0.0, 0.0}, 0.5}, many), 0.5f, 0.02f);
    EXPECT_EQ(scene.ask(sun, Place{{-0.51, 0.0, 0.0}, 0.5}, many), 1.0f);
    EXPECT_EQ(scene.ask(sun, Place{{0.51, 0.0, 0.0}, 0.5}, many), 0.0f);
    LightItem lamp = scene.lamp({-6.0, 0.0, 0.0});
    lamp.range_m = 5.0;
    EXPECT_GT(scene.ask(lamp, Place{{-1.0, 0.0, 0.0}, 0.5}, many), 0.2f) << "what is nearer is within its range";
    EXPECT_LT(scene.ask(lamp, Place{{-1.0, 0.0, 0.0}, 0.5}, many), 1.0f);
    EXPECT_EQ(scene.ask(lamp, Place{{-6.2, 0.0, 0.0}, 0.5}, many), 1.0f) << "the lamp is within the sphere";
}

TEST(CasterTrees, HoldNothingUntilSomethingAsks) {
    const QueryScene scene = random_scene(9, 0.0);
    const std::size_t before = allocation_count();
    CasterTrees trees(scene.library);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(trees.counts().bytes, 0u);
    EXPECT_EQ(trees.tree(0), nullptr);
    trees.update(scene.snapshot);
    EXPECT_EQ(trees.counts().trees, 4u);
    EXPECT_GT(trees.counts().bytes, 240u * sizeof(rays::BvhTriangle));
}

TEST(CasterTrees, AreMadeOfMeshesThatCastAlone) {
    QueryScene scene = random_scene(9, 0.0);
    for (InstanceItem& item : scene.snapshot.instances) item.casts = item.mesh == 2;
    CasterTrees trees(scene.library);
    trees.update(scene.snapshot);
    EXPECT_EQ(trees.counts().trees, 1u);
    EXPECT_EQ(trees.tree(1), nullptr);
    EXPECT_NE(trees.tree(2), nullptr);
}

TEST(CasterTrees, AreNotTouchedWhileTheSceneStandsStillAndOnceItIsKnownNothingIsAllocated) {
    QueryScene scene = random_scene(9, 0.0);
    CasterTrees trees(scene.library);
    LightQueries queries(trees);
    const std::vector<Place> places = random_places(scene, 3000, 9);
    std::vector<float> answers(places.size());
    const LightItem lamp = scene.lamp({1.0, 2.0, -0.5});
    const auto ask = [&] { queries.ask(scene.snapshot, lamp, places, {.samples = 9}, answers); };
    ask();
    EXPECT_EQ(trees.counts().builds, 4u);
    const std::size_t before = allocation_count();
    ask();
    scene.snapshot.instances[3].translation_ws_m.x += 0.5;
    ++scene.snapshot.version;
    scene.snapshot.tree_version = scene.snapshot.version;
    ask();
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(trees.counts().builds + trees.counts().refits, 0u) << "who moves whole needs no new tree";
}

}  // namespace
}  // namespace gnomon::visibility
