#include <cmath>
#include <cstring>
#include <iostream>

#include "tests/gl/tint_fixture.h"
#include "tests/oracle/light_reach.h"

/// Light that translucent casters let through, by maps, against rays.
namespace gnomon {
namespace {

/// Required accuracy of maps, for up to four layers (mean over all seen surfaces).
constexpr double kMostMean = 2.0;
const glm::vec3 kRed{0.9f, 0.2f, 0.1f}, kGreen{0.3f, 0.8f, 0.35f}, kBlue{0.25f, 0.4f, 0.95f}, kAmber{0.95f, 0.7f, 0.2f};
constexpr glm::dvec3 kLamp_m{0.7, 9.0, 0.4};

class Tints : public TintTest, public ::testing::WithParamInterface<LightKind> {
protected:
    ecs::Entity add_lamp() { return add_light_of(GetParam(), kLamp_m, {.filter = ShadowFilter::hardware_2x2}); }
    /// Adds the first `count` of four panes, one above the other, that overlap in part.
    std::vector<ecs::Entity> add_panes(std::size_t count) {
        const glm::vec3 colours[] = {kRed, kGreen, kBlue, kAmber};
        std::vector<ecs::Entity> panes;
        for (std::size_t i = 0; i < count; ++i) {
            const double at = static_cast<double>(i);
            turn = glm::angleAxis(0.37 * at + 0.2, glm::dvec3(0.0, 1.0, 0.0));
            panes.push_back(add_pane(glass(colours[i]), {0.5 * at - 0.8, 1.0 + 0.9 * at, 0.4 * at - 0.7}, 1.2));
        }
        return panes;
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Tints,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(Tints, AreThoseOfRaysForOneToFourLayers) {
    for (std::size_t count = 1; count <= 4; ++count) {
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f});
        add_ground();
        look_down();
        add_lamp();
        add_panes(count);
        draw();
        const Errors found = errors();
        std::cout << count << " layers: mean " << found.mean << "/255, most " << found.most << ", tinted "
                  << found.tinted << " of " << found.pixels << ", darkest " << found.darkest.r << '\n';
        EXPECT_GT(found.tinted, found.pixels / 50);
        EXPECT_LE(found.mean, kMostMean) << count;
    }
}

TEST_P(Tints, AreGoneWithTheirCasters) {
    add_ground();
    look_down();
    add_lamp();
    const std::vector<ecs::Entity> panes = add_panes(2);
    draw();
    const std::vector<glm::vec4> with = tint();
    EXPECT_GT(errors().tinted, 0u);
    // A control: judged without its panes, the same picture is far off.
    for (const ecs::Entity pane : panes) world.remove<ShadowCaster>(pane);
    double off = 0.0;
    for (const glm::vec4& value : with) off += 1.0 - static_cast<double>(value.g);
    EXPECT_GT(255.0 * off / static_cast<double>(with.size()), kMostMean);
    draw();
    for (const glm::vec4& value : tint()) ASSERT_EQ(value, glm::vec4(1.0f));
}

TEST_P(Tints, AreTheSameBitsInAnyOrderOfDrawing) {
    std::vector<glm::vec4> pictures[2];
    for (int order = 0; order < 2; ++order) {
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f});
        add_ground();
        look_down();
        add_lamp();
        // Three at the same depth, two apart, and more than there are layers.
        struct Pane {
            glm::vec3 colour;
            double x_m, y_m;
        };
        std::vector<Pane> panes{{kRed, -0.6, 2.0}, {kGreen, 0.0, 2.0}, {kAmber, 0.5, 2.0}, {kBlue, 0.2, 3.0},
                                {kRed, 0.3, 3.5},  {kGreen, 0.1, 4.0}, {kBlue, -0.2, 4.5}, {kAmber, 0.4, 5.0}};
        if (order == 1) std::reverse(panes.begin(), panes.end());
        for (const Pane& pane : panes) add_pane(glass(pane.colour), {pane.x_m, pane.y_m, 0.0}, 1.0);
        draw();
        pictures[order] = tint();
    }
    ASSERT_EQ(pictures[0].size(), pictures[1].size());
    EXPECT_EQ(0, std::memcmp(pictures[0].data(), pictures[1].data(), pictures[0].size() * sizeof(glm::vec4)));
    EXPECT_TRUE(std::any_of(pictures[0].begin(), pictures[0].end(), [](const glm::vec4& v) { return v.r < 0.1f; }));
}

TEST_P(Tints, MultiplyWhatLiesBehindTheFourthLayerIntoIt) {
    add_ground();
    look_down();
    add_lamp();
    for (int i = 0; i < 7; ++i) add_pane(glass(glm::vec3(0.9f, 0.8f, 0.85f)), {0.0, 1.0 + 0.5 * i, 0.0}, 1.0);
    draw();
    const Errors found = errors();
    EXPECT_LE(found.mean, kMostMean);
    EXPECT_LT(found.darkest.g, 0.25);
}

TEST_P(Tints, LeaveWhatStandsBetweenLampAndPaneWhite) {
    add_ground();
    look_down();
    add_lamp();
    add_pane(glass(kRed), {0.0, 1.5, 0.0}, 1.5);
    place(add_mesh(game::make_card({0.4, 3.0, 0.3}, {1.2, 0.0, 0.0}, {0.0, 0.0, -1.2}), 0));
    add_pane(glass(kBlue), {0.2, 4.5, 0.0}, 1.0);
    draw();
    const Errors found = errors();
    EXPECT_LE(found.mean, kMostMean);
    EXPECT_GT(found.tinted, found.pixels / 50);
}

TEST_P(Tints, DoNotTintThePaneThatCastsThem) {
    add_ground();
    look_down();
    add_lamp();
    turn = glm::angleAxis(0.5, glm::normalize(glm::dvec3(0.3, 0.1, 1.0)));
    add_pane(glass(kRed), {0.0, 2.0, 0.0}, 1.8, true);
    draw();
    // All of the pane is white, its border included, as it is in front of what it tints.
    const SceneSnapshot& scene = frame().snapshot();
    const oracle::ReferenceTracer tracer(scene, library, scene.consumers[0].position_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(scene.consumers[0]);
    const std::vector<glm::vec4> drawn = tint();
    std::size_t of_pane = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const oracle::PlacedTriangle seen = tracer.source_of(hits.triangle[i]);
        if (!seen.exists() || !scene.instances[seen.instance].casts) continue;
        ++of_pane;
        EXPECT_EQ(drawn[i], glm::vec4(1.0f)) << i;
    }
    EXPECT_GT(of_pane, 2000u);
    EXPECT_LE(errors().mean, kMostMean);
}

TEST_P(Tints, FollowTheAlphaOfBlendedSurfaces) {
    add_ground();
    look_down();
    add_lamp();
    assets::Texture stripes;
    stripes.name = "stripes";
    stripes.width = 4;
    stripes.height = 1;
    for (const unsigned char alpha : std::initializer_list<unsigned char>{0, 255, 128, 64})
        stripes.rgba.insert(stripes.rgba.end(), {std::uint8_t{255}, std::uint8_t{255}, std::uint8_t{255}, alpha});
    library.textures.push_back(stripes);
    assets::Material film_of_stripes = film(0.8f);
    film_of_stripes.base_colour_texture = 0;
    add_pane(film_of_stripes, {0.0, 2.0, 0.0}, 2.0, true);
    draw();
    const Errors found = errors();
    EXPECT_LE(found.mean, kMostMean);
    EXPECT_NEAR(found.darkest.r, 0.2, 0.01);
}

TEST_P(Tints, KeepShadowsOfOpaqueCastersAsTheyAre) {
    add_ground();
    look_down();
    add_lamp();
    place(add_analysed(game::make_box({-0.4, 0.0, -0.4}, {0.4, 1.2, 0.4}), 0));
    const ecs::Entity pane = add_pane(glass(kRed), {0.2, 2.0, 0.1}, 0.8);
    draw();
    const std::vector<float> with = visibility();
    EXPECT_GT(errors().tinted, 0u);
    world.patch<LightShadow>(frame().snapshot().lights[0].entity, [](LightShadow& s) { s.translucent_casters = false; });
    draw();
    EXPECT_EQ(with, visibility());
    for (const glm::vec4& value : tint()) ASSERT_EQ(value, glm::vec4(1.0f));
    world.patch<MeshRef>(pane, [](MeshRef& m) { m.visible = false; });
}

TEST_P(Tints, FollowMovedPanes) {
    add_ground();
    look_down();
    add_lamp();
    const ecs::Entity pane = add_pane(glass(kGreen), {0.0, 2.0, 0.0}, 1.0);
    for (int step = 0; step < 4; ++step) {
        world.patch<Transform>(pane, [&](Transform& t) { t.translation_m.x = 0.4 * step; });
        draw();
        EXPECT_LE(errors().mean, kMostMean) << step;
        draw();  // a still frame
        EXPECT_LE(errors().mean, kMostMean) << step;
    }
}

TEST_F(TintTest, CostsNothingWithoutTranslucentCasters) {
    LightCounts counts[3];
    std::uint64_t programs[3];
    for (int way = 0; way < 3; ++way) {
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f});
        add_ground();
        look_down();
        add_light_of(LightKind::spot, kLamp_m, LightShadow{.resolution_px = 512, .translucent_casters = way > 0});
        place(add_analysed(game::make_box({-0.4, 0.5, -0.4}, {0.4, 1.2, 0.4}), 0));
        if (way == 2) add_pane(glass(kRed), {0.0, 2.0, 0.0}, 1.0);
        const std::uint64_t before = device().compiled_programs();
        draw();
        programs[way] = device().compiled_programs() - before;
        counts[way] = frame().report().lights[0].counts;
    }
    EXPECT_EQ(counts[0].bytes, counts[1].bytes);
    EXPECT_EQ(counts[0].draws, counts[1].draws);
    EXPECT_EQ(programs[0], programs[1]);
    // With a pane all of these grow.
    EXPECT_GT(counts[2].bytes, counts[1].bytes);
    EXPECT_GT(counts[2].draws, counts[1].draws);
    EXPECT_GT(programs[2], programs[1]);
}

TEST_F(TintTest, CountsItsBytesAndDraws) {
    add_ground();
    look_down();
    add_light_of(LightKind::spot, kLamp_m, {.filter = ShadowFilter::hard, .resolution_px = 256});
    const ecs::Entity pane = add_pane(glass(kRed), {0.0, 2.0, 0.0}, 1.0);
    draw();
    const LightCounts with = frame().report().lights[0].counts;
    edit_light(world, frame().snapshot().lights[0].entity, [](LightShadow& s) { s.translucent_casters = false; });
    for (int i = 0; i < 70; ++i) {
        world.patch<Transform>(pane, [&](Transform& t) { t.translation_m.x = 0.01 * i; });
        draw();
    }
    const LightCounts without = frame().report().lights[0].counts;
    EXPECT_EQ(with.bytes - without.bytes, std::uint64_t{256} * 256 * 48);
    EXPECT_EQ(with.draws - without.draws, 5u);
}

TEST_F(TintTest, TakesNoNumbersThatAreNone) {
    add_ground();
    look_down();
    add_light_of(LightKind::spot, kLamp_m, {.resolution_px = 256});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    add_pane(glass({nan, 0.5f, 2.0f}), {0.0, 2.0, 0.0}, 1.0);
    draw();
    for (const glm::vec4& value : tint())
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(value[i] >= 0.0f && value[i] <= 1.0f);
}

/// Lights by rays, against rays in double.
class RayTints : public TintTest, public ::testing::WithParamInterface<LightKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, RayTints,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

/// Share of pixels that may be off by more than 1/255: their rays meet an edge to within a float.
constexpr double kOnEdges = 2.0e-4;

TEST_P(RayTints, AreThoseOfTheTracer) {
    add_ground();
    look_down();
    add_light_of(GetParam(), kLamp_m, {.filter = ShadowFilter::exact});
    assets::Texture spots;
    spots.name = "spots";
    spots.width = spots.height = 2;
    spots.rgba = {255, 40, 20, 255, 90, 200, 255, 128, 10, 250, 90, 0, 240, 240, 30, 200};
    library.textures.push_back(spots);
    assets::Material print = film(0.9f);
    print.base_colour_texture = 0;
    print.transmission = glm::vec3(0.5f);
    turn = glm::angleAxis(0.4, glm::normalize(glm::dvec3(0.2, 1.0, 0.3)));
    add_pane(print, {0.0, 1.2, 0.0}, 1.7);
    add_pane(glass(kRed), {-0.5, 2.0, 0.2}, 1.2);
    add_pane(glass(kGreen), {0.4, 2.6, -0.1}, 1.2);
    const std::uint32_t ball = add_mesh(game::make_box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}), add_material(glass(kBlue)));
    world.patch<MeshRef>(place(ball, {.translation_m = {0.9, 3.1, 0.5}, .rotation = turn}),
                         [](MeshRef& m) { m.visible = false; });
    place(add_mesh(game::make_card({0.4, 2.3, 0.9}, {0.8, 0.0, 0.0}, {0.0, 0.0, -0.8}), 0));
    for (int round = 0; round < 2; ++round) {  // the second one reads kept visibility
        draw();
        const Errors found = errors();
        std::cout << "rays: mean " << found.mean << "/255, most " << found.most << ", beyond 1/255 " << found.beyond
                  << " of " << found.pixels << ", tinted " << found.tinted << '\n';
        EXPECT_GT(found.tinted, found.pixels / 50);
        EXPECT_LE(static_cast<double>(found.beyond), kOnEdges * static_cast<double>(found.pixels));
    }
    // A control: without rays' tints the light is white.
    edit_light(world, frame().snapshot().lights[0].entity, [](LightShadow& s) { s.translucent_casters = false; });
    draw();
    EXPECT_GT(errors().mean, kMostMean);
}

TEST_P(RayTints, CountASharedEdgeOnce) {
    add_ground();
    look_down();
    add_light_of(GetParam(), {0.0, 8.0, 0.0}, {.filter = ShadowFilter::exact});
    // Its diagonal lies in a plane through the lamp and a row of pixels.
    add_pane(glass(kRed), {0.0, 2.0, 0.0}, 1.0);
    draw();
    const std::vector<glm::vec4> drawn = tint();
    for (const glm::vec4& value : drawn)
        EXPECT_TRUE(value.g == 1.0f || std::abs(value.g - kRed.g) < 1.0e-3f) << value.g;
}

TEST_P(RayTints, OfASourceAreTheMeanOverIt) {
    if (GetParam() == LightKind::directional) GTEST_SKIP() << "a sun's disk is a lamp's, turned";
    add_ground();
    look_down();
    const float radius_m = 0.6f;
    const ecs::Entity lamp = add_light_of(GetParam(), kLamp_m, {.filter = ShadowFilter::exact_soft});
    edit_light(world, lamp, [&](Light& light) { light.source_radius_m = radius_m; });
    add_pane(glass(kGreen), {0.0, 3.0, 0.0}, 1.2);
    draw();
    const std::vector<glm::vec4> drawn = tint();
    // Truth: the mean of many points of the disk that faces the middle of the ground.
    const SceneSnapshot& scene = frame().snapshot();
    const ConsumerItem& eye = scene.consumers.at(0);
    const oracle::ReferenceTracer tracer(scene, library, eye.position_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(eye);
    const glm::dvec3 facing = glm::normalize(kLamp_m);
    const std::array<glm::dvec3, 2> across = oracle::tangents(facing);
    constexpr int kPlaces = 96;
    std::vector<double> mean(drawn.size(), 0.0);
    for (int i = 0; i < kPlaces; ++i) {
        const double r = radius_m * std::sqrt((i + 0.5) / kPlaces), angle = 3.7 * i;
        LightItem moved = scene.lights[0];
        moved.position_ws_m += across[0] * (r * std::cos(angle)) + across[1] * (r * std::sin(angle));
        const auto truth = oracle::trace_tint(scene, library, eye.position_ws_m, hits, moved);
        for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += truth[p].r / kPlaces;
    }
    double off = 0.0;
    std::size_t between = 0, pixels = 0;
    for (std::size_t p = 0; p < mean.size(); ++p) {
        if (hits.triangle[p] == oracle::kNoTriangle) continue;
        ++pixels;
        off += std::abs(mean[p] - static_cast<double>(drawn[p].r));
        between += drawn[p].r > 0.4f && drawn[p].r < 0.9f ? 1 : 0;
    }
    EXPECT_GT(between, pixels / 100) << "a penumbra";
    EXPECT_LE(255.0 * off / static_cast<double>(pixels), 1.0);
}

TEST_P(RayTints, AreTheSameBitsInAnyOrder) {
    std::vector<glm::vec4> pictures[2];
    for (int order = 0; order < 2; ++order) {
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f});
        add_ground();
        look_down();
        add_light_of(GetParam(), kLamp_m, {.filter = ShadowFilter::exact});
        for (int i = 0; i < 6; ++i) {
            const double at = order == 0 ? i : 5 - i;
            add_pane(glass(glm::vec3(0.5f) + 0.08f * static_cast<float>(at)), {0.1 * at, 1.0 + 0.5 * at, 0.0}, 1.0);
        }
        draw();
        pictures[order] = tint();
    }
    ASSERT_EQ(pictures[0].size(), pictures[1].size());
    EXPECT_EQ(0, std::memcmp(pictures[0].data(), pictures[1].data(), pictures[0].size() * sizeof(glm::vec4)));
}

}  // namespace
}  // namespace gnomon
