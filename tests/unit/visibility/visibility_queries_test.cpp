#include <gmock/gmock.h>

#include <limits>
#include <random>
#include <utility>

#include "gnomon/frame.h"
#include "tests/unit/visibility/query_scene.h"

/// gnomon::VisibilityQueries: what LightQueries answer for the same casters, without a snapshot.
namespace gnomon {
namespace {

using test::QueryScene;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Light kLamp{.kind = LightKind::point};
const WorldTransform kAbove{glm::dmat3(1.0), {0.0, 5.0, 0.0}};
const glm::dvec3 kBelow_m(0.1, 0.0, 0.2), kBeside_m(1.0, 0.0, 0.2);

class VisibilityOfACube : public ::testing::Test {
protected:
    VisibilityOfACube() : box(scene.add_cube()), queries(scene.library) {
        assets::complete(scene.library.meshes[box]);
        caster = queries.add_caster(box);
        queries.place(caster, {glm::dmat3(1.0), {0.0, 1.0, 0.0}});
    }
    static float ask(VisibilityQueries& of, const glm::dvec3& at_m, const Light& light = kLamp) {
        const LitPlace place{at_m};
        float share = -1.0f;
        of.ask(light, kAbove, {&place, 1}, {&share, 1});
        return share;
    }
    QueryScene scene;
    std::uint32_t box;
    VisibilityQueries queries;
    std::size_t caster = 0;
};

TEST_F(VisibilityOfACube, IsAskedAsTheGuideSays) {
    const assets::MeshLibrary& library = scene.library;
    const Light& lamp = kLamp;
    const WorldTransform& lamp_at = kAbove;
    const glm::dvec3 feet_m = kBelow_m, chest_m(0.0, 3.0, 0.0);
    // [ask]
    gnomon::VisibilityQueries queries(library);  // keep it from frame to frame
    queries.place(queries.add_caster(box), {.translation_ws_m = {0.0, 1.0, 0.0}});
    const std::vector<gnomon::LitPlace> places{{feet_m}, {chest_m, 0.3}};  // a point, and a sphere of 0.3 m
    std::vector<float> shares(places.size());
    queries.ask(lamp, lamp_at, places, shares, {.threads = 2});
    // [ask]
    EXPECT_THAT(shares, testing::ElementsAre(0.0f, 1.0f));
}

TEST_F(VisibilityOfACube, FollowsWhereTheCasterIs) {
    EXPECT_EQ(ask(queries, kBelow_m), 0.0f);
    EXPECT_EQ(ask(queries, kBeside_m), 1.0f);
    queries.place(caster, {glm::dmat3(1.0), {0.9, 1.0, 0.0}});
    EXPECT_EQ(ask(queries, kBelow_m), 1.0f);
    EXPECT_EQ(ask(queries, kBeside_m), 0.0f);
    queries.place(queries.add_caster(box), {glm::dmat3(1.0), {0.0, 1.0, 0.0}});
    EXPECT_EQ(ask(queries, kBelow_m), 0.0f) << "a second one came";
    EXPECT_EQ(ask(queries, kBeside_m), 0.0f);
}

TEST_F(VisibilityOfACube, WhatIsNotPlacedCastsNothing) {
    const std::size_t second = queries.add_caster(box);
    EXPECT_EQ(ask(queries, {0.0, -2.0, 3.0}), 1.0f);
    queries.place(second, {glm::dmat3(1.0), {0.0, 0.0, 2.0}});
    EXPECT_EQ(ask(queries, {0.0, -2.0, 2.8}), 0.0f);
    for (const WorldTransform& nowhere :
         {WorldTransform{glm::dmat3(0.0), {0.0, 0.0, 2.0}}, WorldTransform{glm::dmat3(1.0), {kInfinity, 0.0, 2.0}}}) {
        queries.place(second, nowhere);
        EXPECT_EQ(ask(queries, {0.0, -2.0, 2.8}), 1.0f);
        queries.place(second, {glm::dmat3(1.0), {0.0, 0.0, 2.0}});
        EXPECT_EQ(ask(queries, {0.0, -2.0, 2.8}), 0.0f) << "it came back";
    }
    EXPECT_EQ(ask(queries, kBelow_m), 0.0f) << "the first one stayed";
}

TEST_F(VisibilityOfACube, TakesALightsPoseAndConeAsFramesDo) {
    Light light{.kind = LightKind::spot, .outer_cone_rad = 2.0f};
    EXPECT_EQ(ask(queries, {0.0, 7.0, 0.5}, light), 0.0f) << "no cone reaches behind its lamp";
    EXPECT_EQ(ask(queries, {0.0, 7.0, -0.5}, light), 1.0f);
    const LitPlace ahead{{0.0, 5.0, -2.0}};
    float share = -1.0f;
    queries.ask(light, {glm::dmat3(0.0), kAbove.translation_ws_m}, {&ahead, 1}, {&share, 1});
    EXPECT_EQ(share, 1.0f) << "a basis without a direction counts as none";
}

TEST_F(VisibilityOfACube, ReadsTheLightsRangeAndCone) {
    Light light = kLamp;
    light.range_m = 3.0f;
    EXPECT_EQ(ask(queries, kBeside_m, light), 0.0f);
    EXPECT_EQ(ask(queries, {1.0, 3.0, 0.0}, light), 1.0f);
    light = {.kind = LightKind::spot, .outer_cone_rad = 0.3f};
    EXPECT_EQ(ask(queries, kBeside_m, light), 0.0f) << "it shines along -Z";
    EXPECT_EQ(ask(queries, {0.0, 5.0, -2.0}, light), 1.0f);
}

TEST_F(VisibilityOfACube, CopiesAreOnesOfTheirOwn) {
    EXPECT_EQ(ask(queries, kBelow_m), 0.0f);
    VisibilityQueries copy(queries), assigned(scene.library);
    assigned = copy;
    copy.place(caster, {glm::dmat3(1.0), {9.0, 1.0, 0.0}});
    EXPECT_EQ(ask(copy, kBelow_m), 1.0f);
    EXPECT_EQ(ask(queries, kBelow_m), 0.0f);
    EXPECT_EQ(ask(assigned, kBelow_m), 0.0f);
    const VisibilityQueries moved(std::move(copy));
    assigned = moved;
    EXPECT_EQ(ask(assigned, kBelow_m), 1.0f);
}

TEST(VisibilityQueries, AnswerAsQueriesToASnapshotDo) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const auto point = [&](double reach_m) {
        return glm::dvec3(share(random), share(random), share(random)) * reach_m;
    };
    QueryScene scene;
    const std::uint32_t cube = scene.add_cube();
    assets::complete(scene.library.meshes[cube]);
    for (int i = 0; i < 20; ++i) scene.place(cube, point(4.0));
    scene.finish();
    VisibilityQueries queries(scene.library);
    for (const InstanceItem& item : scene.snapshot.instances)
        queries.place(queries.add_caster(item.mesh), {item.basis, item.translation_ws_m});
    std::vector<visibility::Place> places;
    std::vector<LitPlace> asked;
    for (int i = 0; i < 2000; ++i) {
        places.push_back({point(5.0), i % 2 == 0 ? 0.0 : 0.2});
        asked.push_back({places.back().at_ws_m, places.back().radius_m});
    }
    const std::vector<float> expected = scene.ask(scene.lamp({0.5, 6.0, 0.3}), places);
    std::vector<float> answers(asked.size(), -1.0f);
    queries.ask(kLamp, {glm::dmat3(1.0), {0.5, 6.0, 0.3}}, asked, answers);
    EXPECT_EQ(answers, expected);
    EXPECT_THAT(answers, testing::Contains(0.0f));
    EXPECT_THAT(answers, testing::Contains(1.0f));
}

}  // namespace
}  // namespace gnomon
