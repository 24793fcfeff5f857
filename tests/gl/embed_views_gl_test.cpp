#include "tests/gl/embed_fixture.h"
#include "tests/gl/jitter_phases.h"
#include "tests/unit/allocation_counter.h"

// Views of gnomon::Shadows: off-centre, flat, multisampled, several at once, and such as cannot be read.
namespace gnomon {
namespace {

class EmbedScene : public EmbedTest {
protected:
    /// Returns a view from the other side, with the depths that the other engine drew.
    View drawn_from_behind() {
        View from_behind = view;
        from_behind.world_from_view = glm::inverse(glm::lookAt(glm::dvec3(-3.0, 2.0, -2.0), glm::dvec3(0.0, 0.5, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
        from_behind.normal_texture = others.front()->normals;
        draw_depths(from_behind, *others.front());
        return from_behind;
    }
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
    }
    void add_lit_room() {
        add_room();
        add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
        look_from({0.5, 2.5, 4.0});
    }
};

TEST_F(EmbedScene, WithoutItsCasterThereIsNoShadow) {
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
    const CasterId box = add(game::make_box({-0.8, 0.7, -0.5}, {0.8, 0.8, 0.5}));
    add_shadowed(LightKind::point, {0.0, 3.0, 0.0});
    look_from({0.5, 4.5, 4.0});
    const std::vector<std::uint8_t> with = masked();
    shadows->remove(box);
    const std::vector<std::uint8_t> without = masked();
    EXPECT_GT(differing(with, without), 1000u);
    const std::size_t under_the_box = static_cast<std::size_t>(std::count(without.begin(), without.end(), 255));
    EXPECT_GT(under_the_box, static_cast<std::size_t>(std::count(with.begin(), with.end(), 255)) + 1000);
}

TEST_F(EmbedScene, FollowsWhatMovesAndKeepsWhatStays) {
    add_lit_room();
    masked();
    masked();
    EXPECT_EQ(shadows->status().maps_drawn, 0u) << "nothing moved";
    const auto mesh = shadows->add_mesh({.positions_m = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).positions,
                                         .indices = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).indices});
    const CasterId box = shadows->add_caster({.mesh = mesh.value(), .world_from_mesh = glm::translate(glm::dmat4(1.0), {0.6, 1.2, 0.3})});
    const std::vector<std::uint8_t> first = masked();
    EXPECT_GT(shadows->status().maps_drawn, 0u);
    shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.2, 1.4, 0.3}));
    const std::vector<std::uint8_t> second = masked();
    EXPECT_GT(shadows->status().maps_drawn, 0u);
    EXPECT_GT(differing(first, second), 200u);
    shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.6, 1.2, 0.3}));
    EXPECT_EQ(differing(masked(), first), 0u);
}

TEST_F(EmbedScene, LayersAreTheViewsLightsInItsOrder) {
    add_room();
    const LightId sun = add_shadowed(LightKind::directional, {1.5, 3.0, 1.0});
    const LightId lamp = add_shadowed(LightKind::point, {-1.0, 2.5, 1.0});
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> of_sun = masked(0), of_lamp = masked(1);
    EXPECT_GT(differing(of_sun, of_lamp), 1000u);
    const LightId order[] = {lamp, sun, lamp};
    view.lights = order;
    EXPECT_EQ(differing(masked(0), of_lamp), 0u);
    EXPECT_EQ(differing(masked(1), of_sun), 0u);
    EXPECT_EQ(differing(masked(2), of_lamp), 0u);
    shadows->remove(sun);
    const std::vector<std::uint8_t> of_none = masked(1);
    EXPECT_EQ(std::count(of_none.begin(), of_none.end(), 255), kWidth_px * kHeight_px) << "a light that is gone darkens nothing";
    EXPECT_EQ(differing(masked(0), of_lamp), 0u);
}

TEST_F(EmbedScene, AnOffCentrePictureIsAPartOfTheWhole) {
    add_lit_room();
    const double top = kNear_m * std::tan(0.5 * kFov_rad), right = top * kWidth_px / kHeight_px;
    const glm::dmat4 whole = glm::frustumRH_NO(-right, right, -top, top, kNear_m, 100.0);
    // Half as wide and high about a place off the axis, so that each pixel is a quarter of one of the whole's.
    const glm::dmat4 part = glm::frustumRH_NO(-0.25 * right, 0.75 * right, -0.75 * top, 0.25 * top, kNear_m, 100.0);
    engine->own_projection = part;
    const std::vector<std::uint8_t> seen = masked();
    engine->own_projection = whole;
    const std::vector<std::uint8_t> all = masked();
    std::size_t compared = 0, other = 0;
    for (int y = 0; y < kHeight_px; ++y)
        for (int x = 0; x < kWidth_px; ++x) {
            const int in_x = (x + 3 * kWidth_px / 4) / 2, in_y = (y + kHeight_px / 4) / 2;
            if (in_x < 1 || in_x + 1 >= kWidth_px || in_y < 1 || in_y + 1 >= kHeight_px) continue;
            const auto at = [&](int dx, int dy) { return all[static_cast<std::size_t>((in_y + dy) * kWidth_px + in_x + dx)]; };
            const bool even = at(0, 0) == at(1, 0) && at(0, 0) == at(-1, 0) && at(0, 0) == at(0, 1) && at(0, 0) == at(0, -1) &&
                              at(0, 0) == at(1, 1) && at(0, 0) == at(-1, -1) && at(0, 0) == at(1, -1) && at(0, 0) == at(-1, 1);
            if (!even) continue;
            ++compared;
            other += seen[static_cast<std::size_t>(y * kWidth_px + x)] != at(0, 0);
        }
    EXPECT_GT(compared, 60000u);
    EXPECT_LT(other, 60u) << "of " << compared << ": only thin features between the whole's pixels";
}

TEST_F(EmbedTest, EachSampleOfAMultisampledPictureHasALayer) {
    make_engine(Depths::usual_float, 4);
    others.push_back(std::make_unique<Engine>(Depths::usual_float));
    Engine& plain = *others.front();
    add_room();
    add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    ASSERT_EQ(mask.samples, 4u);
    ASSERT_EQ(mask.layers, 4u);
    std::vector<std::vector<std::uint8_t>> samples;
    for (std::uint32_t i = 0; i < 4; ++i) samples.push_back(layer_of(mask, i));
    EXPECT_GT(differing(samples[0], samples[3]), 100u) << "edges lie elsewhere";
    const auto places = gl::sample_positions(device(), engine->depth);
    ASSERT_EQ(places.size(), 4u);
    View single = view;
    single.normal_texture = plain.normals;
    for (std::size_t i = 0; i < 4; ++i) {
        glm::dmat4 jittered = engine->projection();
        jittered[2][0] += 2.0 * (places[i][0] - 0.5) / kWidth_px;
        jittered[2][1] += 2.0 * (places[i][1] - 0.5) / kHeight_px;
        plain.own_projection = jittered;
        draw_depths(single, plain);
        const Mask alone = shadows->render(single);
        EXPECT_EQ(alone.samples, 1u);
        EXPECT_LT(differing(layer_of(alone, 0), samples[i]), kFewPixels) << "sample " << i;
    }
}

/// Moves the camera's picture as an engine's temporal antialiasing does: fits leave jitter out, lookups follow it.
TEST_F(EmbedScene, AJitteredCameraDrawsNoMapAndShimmersNowhere) {
    add_room();
    add_shadowed(LightKind::directional, {1.5, 3.0, 1.0});
    add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    add_shadowed(LightKind::point, {-1.0, 2.5, 1.0});
    look_from({0.5, 2.5, 4.0});
    constexpr std::size_t kPhases = 8, kLights = 3;
    const glm::dmat4 straight = engine->projection();
    const double top = kNear_m * std::tan(0.5 * kFov_rad), right = top * kWidth_px / kHeight_px;
    const glm::dmat4 aside = glm::frustumRH_NO(-0.6 * right, 1.4 * right, -1.2 * top, 0.8 * top, kNear_m, 100.0);
    // Halton's sequence in bases 2 and 3. Its first place lies in the middle along x.
    const auto radical = [](std::size_t i, std::size_t base) {
        double sum = 0.0, share = 1.0;
        for (; i > 0; i /= base) sum += static_cast<double>(i % base) * (share /= static_cast<double>(base));
        return sum - 0.5;
    };
    for (const glm::dmat4& projection : {straight, aside}) {
        const auto rendered = [&](std::size_t phase) {
            glm::dmat4 jittered = projection;
            jittered[2][0] += 2.0 * radical(phase % kPhases + 1, 2) / kWidth_px;
            jittered[2][1] += 2.0 * radical(phase % kPhases + 1, 3) / kHeight_px;
            engine->own_projection = jittered;
            draw_depths(view, *engine);
            return shadows->render(view);
        };
        // Fits come to rest as they do without jitter.
        std::size_t still = 0;
        for (std::size_t i = 0; i < 200 && still < kPhases; ++i) {
            rendered(i);
            still = shadows->status().still ? still + 1 : 0;
        }
        EXPECT_EQ(still, kPhases);
        std::vector<std::vector<std::uint8_t>> seen[kLights];
        std::size_t maps = 0;
        for (std::size_t i = 0; i < kPhases; ++i) {
            const Mask mask = rendered(i);
            maps += shadows->status().maps_drawn;
            for (std::uint32_t light = 0; light < kLights; ++light) seen[light].push_back(layer_of(mask, light));
        }
        EXPECT_EQ(maps, 0u);
        for (const auto& phases : seen) {
            const JitteredPixels pixels = jittered_pixels(phases, kWidth_px);
            EXPECT_GT(pixels.inner, 50000u);
            EXPECT_EQ(pixels.shimmers, 0u);
            EXPECT_GT(pixels.edges, 100u) << "the picture does not jitter";
            EXPECT_LT(pixels.slivers, pixels.edges / 4) << "few things are thinner than a pixel";
        }
    }
}

TEST_F(EmbedScene, ViewsAtOnceShowWhatEachShowsAlone) {
    others.push_back(std::make_unique<Engine>(Depths::reversed));
    add_lit_room();
    draw_depths(view, *engine);
    const View from_behind = drawn_from_behind();
    const View both[] = {view, from_behind};
    const auto masks = shadows->render(both);
    ASSERT_EQ(masks.size(), 2u);
    const std::vector<std::uint8_t> first = layer_of(masks[0], 0), second = layer_of(masks[1], 0);
    EXPECT_GT(differing(first, second), 1000u);
    EXPECT_LT(differing(layer_of(shadows->render(view), 0), first), kFewPixels);
    EXPECT_LT(differing(layer_of(shadows->render(from_behind), 0), second), kFewPixels);
}

TEST_F(EmbedScene, FromThe32ndOnViewsShowWhatEachShowsAlone) {
    others.push_back(std::make_unique<Engine>(Depths::usual_float));
    add_lit_room();
    draw_depths(view, *engine);
    const View from_behind = drawn_from_behind();
    std::vector<View> many(34, view);
    many[31] = many[33] = from_behind;
    std::vector<std::vector<std::uint8_t>> seen;
    for (const Mask& mask : shadows->render(many)) seen.push_back(layer_of(mask, 0));
    ASSERT_EQ(seen.size(), many.size());
    const std::vector<std::uint8_t> first = layer_of(shadows->render(view), 0), behind = layer_of(shadows->render(from_behind), 0);
    EXPECT_GT(differing(first, behind), 1000u);
    for (const std::size_t i : {0u, 30u, 31u, 32u, 33u}) EXPECT_LT(differing(seen[i], i % 2 == 1 ? behind : first), kFewPixels) << i;
}

TEST_F(EmbedScene, AMaskHasAsManyLayersAsTheDeviceHasAndMoreAreRefusedAlone) {
    add_lit_room();
    const std::vector<std::uint8_t> good = masked();
    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    ASSERT_GE(most, 2048);
    std::vector<LightId> lights(static_cast<std::size_t>(most));
    View full = view;
    full.size_px = {8, 8};
    full.lights = lights;
    const View both[] = {full, view};
    if (device().info().is_software) {
        EXPECT_EQ(shadows->render(both)[0].failure, "");
        EXPECT_EQ(shadows->render(both)[0].layers, lights.size());
    }
    lights.emplace_back();
    View over = full, without = full;
    over.lights = without.lights = lights;
    without.wants_mask = false;
    const View three[] = {over, view, without};
    const auto masks = shadows->render(three);
    EXPECT_EQ(masks[0].failure, "view.lights");
    EXPECT_EQ(masks[0].texture, 0u);
    EXPECT_LT(differing(layer_of(masks[1], 0), good), kFewPixels) << "another view is unharmed";
    EXPECT_EQ(masks[2].failure, "") << "without a mask any number is looked up";
    EXPECT_LT(differing(masked(), good), kFewPixels);
}

TEST_F(EmbedScene, AFlatViewIsThatOfTheFrame) {
    add_room();
    add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    const glm::dvec3 at_m(2.0, 3.0, 4.0), to_m(0.0, 0.5, 0.0);
    constexpr double kHalf_m = 1.5;
    add_camera({.projection = CameraProjection::orthographic, .half_height_m = kHalf_m, .near_m = 0.1, .far_m = 30.0}, at_m, to_m - at_m);
    view.world_from_view = glm::inverse(glm::lookAt(at_m, to_m, glm::dvec3(0.0, 1.0, 0.0)));
    const double half_x = kHalf_m * kWidth_px / kHeight_px;
    engine->own_projection = glm::orthoRH_NO(-half_x, half_x, -kHalf_m, kHalf_m, 0.1, 30.0);
    const Difference d = compared(masked());
    EXPECT_GT(d.dark, 2000u);
    EXPECT_LT(d.share(), 0.0005) << d.other;
}

TEST_F(EmbedScene, WhatCannotBeReadHasAReasonAndHarmsNoOther) {
    add_lit_room();
    const std::vector<std::uint8_t> good = masked();
    const auto failure = [&](auto change) {
        View bad = view;
        change(bad);
        const View both[] = {bad, view};
        const auto masks = shadows->render(both);
        EXPECT_EQ(masks[0].texture, 0u);
        EXPECT_LT(differing(layer_of(masks[1], 0), good), kFewPixels);
        return std::string(masks[0].failure);
    };
    EXPECT_EQ(failure([](View& v) { v.depth_texture = 0; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.depth_texture = 4711; }), "view.depth");
    EXPECT_EQ(failure([&](View& v) { v.depth_texture = engine->normals; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.normal_texture = 4711; }), "view.normals");
    EXPECT_EQ(failure([](View& v) { v.size_px = {0, 10}; }), "view.size");
    EXPECT_EQ(failure([](View& v) { v.size_px = {kWidth_px + 1, kHeight_px}; }), "view.depth");
    EXPECT_EQ(failure([](View& v) { v.clip_from_view = glm::dmat4(std::numeric_limits<double>::quiet_NaN()); }), "view.projection");
    EXPECT_EQ(failure([](View& v) { v.world_from_view[0][0] = std::numeric_limits<double>::infinity(); }), "view.projection");
    EXPECT_EQ(failure([](View& v) { v.world_from_view *= 2.0; }), "view.projection");
}

TEST_F(EmbedScene, NothingAtAllIsNoFault) {
    EXPECT_TRUE(shadows->render(std::span<const View>{}).empty());
    look_from({0.5, 2.5, 4.0});
    draw_depths(view, *engine);
    const Mask mask = shadows->render(view);
    EXPECT_EQ(mask.failure, "");
    EXPECT_EQ(mask.layers, 0u);
    EXPECT_FALSE(shadows->status(LightId{}).gpu_us);
    EXPECT_EQ(shadows->visibility(LightId{}, {0.0, 0.0, 0.0}), 0.0f);
}

TEST_F(EmbedScene, WhatNothingDeclaresIsLit) {
    const game::Shape ground = game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0});
    engine->add(ground.positions, ground.indices);  // and no caster
    const LightId lamp = shadows->add_light({.light = {.kind = LightKind::point, .range_m = 20.0f}, .position_m = {0.0, 3.0, 0.0}});
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> mask = masked();
    EXPECT_GT(std::count(mask.begin(), mask.end(), 255), 20000) << reason_code(shadows->status(lamp).reason);
    shadows->remove(lamp);
    draw_depths(view, *engine);
    const Mask none = shadows->render(view);
    EXPECT_EQ(none.layers, 0u) << "the last light is gone";
    EXPECT_EQ(none.texture, 0u);
}

TEST_F(EmbedScene, ALightOfRaysGetsAFilteredMapAndSaysSo) {
    add_room();
    const LightId lamp = add_shadowed(LightKind::spot, {1.5, 3.0, 1.0}, {.filter = ShadowFilter::exact});
    look_from({0.5, 2.5, 4.0});
    const Difference d = compared(masked());
    EXPECT_LT(d.share(), 0.0005) << d.other;
    EXPECT_EQ(shadows->status(lamp).reason, Reason::rays_off);
    EXPECT_EQ(shadows->status(lamp).state, LightState::degraded);
    EXPECT_NE(shadows->status(lamp).filter, ShadowFilter::exact);
}

TEST_F(EmbedScene, ABudgetIsKeptAndSaid) {
    add_lit_room();
    masked();
    const std::uint64_t bytes = shadows->status().bytes;
    shadows->set_budget({.bytes = bytes / 5});
    for (int frame = 0; frame < 3; ++frame) masked();
    EXPECT_LE(shadows->status().bytes, bytes / 5);
    EXPECT_GT(shadows->status().bytes, 0u);
}

TEST_F(EmbedScene, MeshesThatComeAndGoLeaveNothingBehind) {
    add_lit_room();
    struct Piece {
        MeshId mesh;
        CasterId caster;
    };
    const auto add_piece = [](Shadows& to, int i) {
        const game::Shape shape = i % 2 == 0 ? game::make_box({-0.2, 0.0, -0.2}, {0.2, 0.1 + 0.05 * (i % 5), 0.2})
                                             : game::make_sphere(0.1 + 0.02 * (i % 7), 12, 8);
        const auto mesh = to.add_mesh({.positions_m = shape.positions, .indices = shape.indices});
        EXPECT_TRUE(mesh);
        const glm::dvec3 at_m(0.4 * (i % 6) - 1.0, 1.0, 0.5 * (i % 4) - 0.8);
        return Piece{mesh.value(), to.add_caster({.mesh = mesh.value(), .world_from_mesh = glm::translate(glm::dmat4(1.0), at_m)})};
    };
    constexpr int kFrames = 60, kAlive = 5;
    std::vector<Piece> pieces;
    for (int i = 0; i < kFrames; ++i) {
        pieces.push_back(add_piece(*shadows, i));
        if (i >= kAlive) {
            shadows->remove(pieces[static_cast<std::size_t>(i - kAlive)].caster);
            shadows->remove(pieces[static_cast<std::size_t>(i - kAlive)].mesh);
        }
        draw_depths(view, *engine);
        EXPECT_EQ(shadows->render(view).failure, "");
        EXPECT_GT(shadows->status().maps_drawn, 0u) << i;
        EXPECT_TRUE(shadows->dropped().empty());
    }
    const std::vector<std::uint8_t> streamed = masked();
    // A caster without its mesh is named, and the others stay.
    shadows->remove(pieces.back().mesh);
    masked();
    ASSERT_EQ(shadows->dropped().size(), 1u);
    EXPECT_EQ(shadows->dropped().front().caster, pieces.back().caster);
    EXPECT_EQ(shadows->dropped().front().reason, "unknown_mesh");
    // The same pieces in a scene that never had any other.
    auto fresh = Shadows::create();
    ASSERT_TRUE(fresh);
    std::swap(shadows, fresh.value());
    for (const Room& piece : room) shadows->add_caster({.mesh = shadows->add_mesh({.positions_m = piece.positions, .indices = piece.indices}).value()});
    shadows->add_light({.light = {.kind = LightKind::spot, .outer_cone_rad = 0.9f}, .position_m = {1.5, 3.0, 1.0}, .direction = {-1.5, -3.0, -1.0}});
    for (int i = kFrames - kAlive; i < kFrames; ++i) add_piece(*shadows, i);
    EXPECT_EQ(differing(masked(), streamed), 0u);
}

TEST_F(EmbedScene, AllocatesNothingOnceWarm) {
    add_lit_room();
    const auto mesh = shadows->add_mesh({.positions_m = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).positions,
                                         .indices = game::make_box({0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}).indices});
    const CasterId box = shadows->add_caster({.mesh = mesh.value()});
    draw_depths(view, *engine);
    const auto frame = [&](int i) {
        shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.1 * (i % 3), 1.2, 0.3}));
        shadows->render(view);
    };
    for (int i = 0; i < 40; ++i) frame(i);
    // OpenGL's implementation allocates in its own library and in its threads; what Gnomon calls it counts alone.
    const std::size_t before = allocation_count();
    for (int i = 0; i < 6; ++i) frame(i);
    EXPECT_EQ(allocation_count() - before, 0u);
    EXPECT_GT(shadows->status().maps_drawn, 0u) << "control: these frames drew";
}

TEST_F(EmbedScene, QueriesAgreeWithTheMask) {
    add_room();
    const LightId lamp = add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    masked();
    EXPECT_EQ(shadows->visibility(lamp, {0.0, 2.0, 0.0}), 1.0f);
    EXPECT_EQ(shadows->visibility(lamp, {0.0, 0.6, 0.0}), 0.0f) << "under the table";
}

}  // namespace
}  // namespace gnomon
