#include <algorithm>

#include "tests/gl/embed_fixture.h"
#include "tests/gl/failing_gl.h"

// gnomon::Shadows beside an engine of its own: the mask is what Gnomon's own frame shows of the same world.
namespace gnomon {
namespace {

class EmbedMask : public EmbedTest, public ::testing::WithParamInterface<std::tuple<LightKind, Depths>> {};

TEST_P(EmbedMask, IsWhatTheFrameShows) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const Difference d = compared(masked());
    std::printf("%s %s: %zu surfaces, %zu dark, %zu other, %.4f %%\n", kind_name(kind), name_of(depths), d.surfaces, d.dark,
                d.other, 100.0 * d.share());
    EXPECT_GT(d.dark, 2000u);
    EXPECT_GT(d.lit, 20000u);
    EXPECT_EQ(d.other, 0u);
}

TEST_P(EmbedMask, HasTheShareOfEachPixelThatTheFrameShows) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {1.5, 3.0, 1.0}, {.antialias = true});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const std::vector<std::uint8_t> mask = masked();
    const Difference d = compared(mask);
    const auto shares = std::count_if(mask.begin(), mask.end(), [](std::uint8_t share) { return share > 0 && share < 255; });
    std::printf("%s %s: %td shares, %zu other of %zu\n", kind_name(kind), name_of(depths), shares, d.other, d.surfaces);
    EXPECT_GT(shares, 200);
    // A place that lies on an edge falls to either side by rounding: one of the area's 32.
    EXPECT_LT(d.share(), 0.0001);
    EXPECT_LE(d.largest, 255.0f / 32.0f + 1.5f);
}

/// Turns a spot, and its map with it. A turned map has other texels at edges, where either map may miss.
TEST_F(EmbedTest, SpotsTurnedAboutTheirDirectionAreAsRight) {
    make_engine(Depths::usual_float);
    add_room();
    add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const std::vector<std::uint8_t> mask = masked();
    std::vector<float> measured;
    for (const std::uint8_t texel : mask) measured.push_back(static_cast<float>(texel) / 255.0f);
    const ecs::Entity spot = world.entities_with<Light>().front();
    const glm::dquat rest = world.get<Transform>(spot)->rotation;
    for (const double turn_rad : {0.0, 0.4, 0.9, 1.3}) {
        world.patch<Transform>(spot, [&](Transform& transform) {
            transform.rotation = rest * glm::angleAxis(turn_rad, glm::dvec3(0.0, 0.0, 1.0));
        });
        const Difference d = compared(mask);
        const Judged of_mask = judge(0, frame().snapshot(), measured), of_frame = judge();
        std::printf("turned by %.1f: %zu other, %zu and %zu wrong of %zu\n", turn_rad, d.other, of_mask.metrics.wrong,
                    of_frame.metrics.wrong, of_mask.metrics.scored);
        EXPECT_LE(d.other, turn_rad == 0.0 ? 0u : of_mask.metrics.wrong + of_frame.metrics.wrong);
        EXPECT_LT(of_mask.metrics.fraction(of_mask.metrics.wrong), 0.0005);
        EXPECT_LT(of_frame.metrics.fraction(of_frame.metrics.wrong), 0.0005);
    }
}

/// Draws a wall that the engine never declared, behind all that it did. Nothing stands between it and the lamp.
TEST_F(EmbedTest, SurfacesBehindWhatIsDeclaredAreLit) {
    make_engine(Depths::usual_float);
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0}));
    add(game::make_box({-0.8, 0.2, -0.5}, {0.8, 0.3, 0.5}));
    const game::Shape wall = game::make_card({0.0, 0.0, -8.0}, {30.0, 0.0, 0.0}, {0.0, 30.0, 0.0});
    engine->add(wall.positions, wall.indices);
    add_shadowed(LightKind::point, {1.5, 3.0, 1.0});  // without a range
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const std::vector<std::uint8_t> mask = masked();
    constexpr std::size_t kTop = std::size_t{kWidth_px} * 20;
    EXPECT_EQ(std::count(mask.end() - kTop, mask.end(), 255), static_cast<std::ptrdiff_t>(kTop));
    EXPECT_GT(std::count(mask.begin(), mask.end(), 0), 100) << "control: the box throws a shadow";
    // Without such walls, as the engine then states, it gets no light, and all else what it had.
    view.shows_only_added = true;
    const std::vector<std::uint8_t> of_added = masked();
    EXPECT_EQ(std::count(of_added.end() - kTop, of_added.end(), 0), static_cast<std::ptrdiff_t>(kTop));
    std::size_t lit = 0, other = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        lit += of_added[i] > 0 ? 1 : 0;
        other += of_added[i] > 0 && of_added[i] != mask[i] ? 1 : 0;
    }
    EXPECT_GT(lit, 1000u) << "of the card and the box";
    EXPECT_EQ(other, 0u);
}

TEST_P(EmbedMask, IsTheSameWhereAllThatIsSeenWasAdded) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    view.normal_texture = engine->normals;
    for (const glm::dvec3& from : {glm::dvec3(0.5, 2.5, 4.0), glm::dvec3(-3.0, 0.4, 1.0), glm::dvec3(0.1, 6.0, 0.2)})
        for (const bool antialias : {false, true}) {
            look_from(from);
            const LightId light = add_shadowed(kind, {1.5, 3.0, 1.0}, {.antialias = antialias});
            view.shows_only_added = false;
            const std::vector<std::uint8_t> all = masked();
            view.shows_only_added = true;
            EXPECT_EQ(masked(), all) << from.x << (antialias ? " antialiased" : "");
            shadows->remove(light);
        }
}

TEST_P(EmbedMask, NeedsNoNormals) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    const Difference d = compared(masked());
    std::printf("%s %s, derived normals: %zu other, %.4f %%\n", kind_name(kind), name_of(depths), d.other, 100.0 * d.share());
    EXPECT_LT(d.share(), 0.001);
}

TEST_P(EmbedMask, DerivesNormalsUpToThePicturesEdges) {
    const auto [kind, depths] = GetParam();
    make_engine(depths);
    add_room();
    add_shadowed(kind, {0.5, 1.5, -5.0});  // opposite: a surface that faces the camera is dark
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const std::vector<std::uint8_t> given = masked();
    view.normal_texture = 0;
    const std::vector<std::uint8_t> derived = masked();
    std::size_t lit = 0, other = 0;
    for (int y = 0; y < kHeight_px; ++y)
        for (int x = 0; x < kWidth_px; ++x) {
            if (x > 0 && x + 1 < kWidth_px && y > 0 && y + 1 < kHeight_px) continue;
            const auto i = static_cast<std::size_t>(y * kWidth_px + x);
            lit += given[i] > 127;
            other += std::abs(given[i] - derived[i]) > 2;
        }
    std::printf("%s %s: %zu of the edge's pixels are lit, %zu are other\n", kind_name(kind), name_of(depths), lit, other);
    EXPECT_GT(lit, 200u);
    EXPECT_LE(other, 1u);
}

/// Draws a light with triangles twice: what the first draw decides, and the rest. Without a target for that
/// it is one draw.
TEST_F(EmbedTest, TwoDrawsOfALightShowTheBitsOfOne) {
    make_engine(Depths::usual_float);
    add_room();
    const glm::dvec3 at_m(1.5, 3.0, 1.0);
    const LightId spot = add_shadowed(LightKind::spot, at_m);
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    const auto with = [&](ShadowFilter filter) {
        shadows->set_light(spot, {.light = {.kind = LightKind::spot, .outer_cone_rad = 0.9f}, .position_m = at_m, .direction = -at_m, .shadow = {.filter = filter}});
        draw_depths(view, *engine);
        return layer_of(shadows->render(view), 0);
    };
    const std::vector<std::uint8_t> hard = with(ShadowFilter::hard), two = with(ShadowFilter::triangles);
    EXPECT_NE(two, hard) << "control";

    FailingGl gl;
    const auto counted = [&](std::uint64_t failing_target) {
        with(ShadowFilter::hard);
        gl.begin(GlFault::incomplete_target, failing_target, false);
        std::vector<std::uint8_t> mask = with(ShadowFilter::triangles);
        gl.end();
        return mask;
    };
    constexpr std::uint64_t kNone = 1000;
    EXPECT_EQ(counted(kNone), two);
    const std::uint64_t targets = gl.calls(GlFault::incomplete_target), calls = gl.calls(GlFault::out_of_memory);
    std::uint64_t in_one = 0;
    for (std::uint64_t target = targets; target-- > 0;) {  // a map's comes first, and is not tried again at once
        const std::vector<std::uint8_t> mask = counted(target);
        if (shadows->status(spot).reason != Reason::none) continue;
        EXPECT_EQ(mask, two) << "target " << target;
        EXPECT_LT(gl.calls(GlFault::out_of_memory), calls) << "no second draw, no copy of depths";
        ++in_one;
    }
    EXPECT_EQ(in_one, 1u);
}

TEST_F(EmbedTest, ANumberOfTheFrameIsAPatternOfRandomTapsAlone) {
    const auto pattern = [&](std::uint32_t noise_frame) {
        view.noise_frame = noise_frame;
        return masked();
    };
    make_engine(Depths::usual_float);
    view.normal_texture = engine->normals;
    add_room();
    const glm::dvec3 at_m(1.5, 3.0, 1.0);
    const LightId spot = add_shadowed(LightKind::spot, at_m);
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> edges = pattern(0);
    EXPECT_EQ(pattern(5), edges) << "triangles have no random taps";
    shadows->set_light(spot, {.light = {.kind = LightKind::spot, .outer_cone_rad = 0.9f, .source_radius_m = 0.1f},
                              .position_m = at_m, .direction = -at_m, .shadow = {.filter = ShadowFilter::pcss}});
    const std::vector<std::uint8_t> first = pattern(0);
    EXPECT_EQ(pattern(0), first);
    EXPECT_GT(differing(pattern(5), first), 300u);
    EXPECT_EQ(shadows->status().maps_drawn, 0u);
    EXPECT_EQ(pattern(1024), first) << "numbers begin again";
    EXPECT_EQ(pattern(5 + 3 * 1024), pattern(5));
}

TEST_F(EmbedTest, EightLightsAtOnceAreWhatRaysSay) {
    make_engine(Depths::usual_float);
    add_room();
    constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};
    for (int i = 0; i < 8; ++i) {
        const double turn = 0.8 * i;
        add_shadowed(kKinds[i % 3], {2.0 * std::cos(turn), 2.2 + 0.2 * i, 2.0 * std::sin(turn)});
    }
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    ASSERT_EQ(mask.layers, 8u);
    draw();
    Tally tally;
    for (std::uint32_t light = 0; light < 8; ++light) {
        const std::vector<std::uint8_t> layer = layer_of(mask, light);
        std::vector<float> measured;
        for (const std::uint8_t texel : layer) measured.push_back(static_cast<float>(texel) / 255.0f);
        tally.add(judge(light, frame().snapshot(), measured));
    }
    std::printf("%s\n", tally.text().c_str());
    EXPECT_GT(tally.dark, 10000.0);
    EXPECT_LT((tally.false_light + tally.false_shadow) / tally.scored, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(All, EmbedMask,
                         ::testing::Combine(::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                                            ::testing::Values(Depths::usual_d24, Depths::usual_float, Depths::reversed)),
                         [](const auto& row) {
                             return std::string(kind_name(std::get<0>(row.param))) + name_of(std::get<1>(row.param));
                         });

}  // namespace
}  // namespace gnomon
