#include "tests/gl/catcher_fixture.h"

// Shadow catchers against rays, pixel by pixel. Their alpha is the share of their light that casters take. The picture
// around them has an alpha, too.
namespace gnomon {
namespace {

class ShadowCatcherOfKind : public ShadowCatcher, public ::testing::WithParamInterface<LightKind> {};

TEST_P(ShadowCatcherOfKind, HasTheShareThatCastersTakeAsAlphaAndNoColour) {
    make_stage();
    add_light({.kind = GetParam(), .intensity = 800.0f, .outer_cone_rad = 0.9f}, {-2.0, 5.0, 1.0}, {2.0, -5.0, -1.0}, kHardMap);
    draw();
    expect_rays(150);
    const Compared c = compared();
    EXPECT_EQ(c.coloured, 0u) << "premultiplied black";
    Expected lit = expected();
    for (std::size_t i = 0; i < lit.alpha.size(); ++i)
        if (lit.catches[i]) lit.alpha[i] = 0.0;
    EXPECT_GT(compared(lit).wrong, 150u) << "control: a catcher without shadow is told apart";
    take_caster_away();
    for (const int alpha : alphas()) ASSERT_EQ(alpha, 0) << "no caster, no alpha";
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShadowCatcherOfKind, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_F(ShadowCatcher, LaysNothingOverAPhotographWhereNothingCasts) {
    make_stage();
    add_coloured_lights();
    draw();
    const std::vector<std::uint8_t> photograph = like_a_photograph(kCatcher_px), over = composed(picture(), photograph);
    const Expected truth = expected();
    std::size_t lit = 0, darker = 0, wrong = 0;
    for (std::size_t i = 0; i < truth.alpha.size(); ++i) {
        const std::size_t at = ((kCatcher_px.y - 1 - i / kCatcher_px.x) * kCatcher_px.x + i % kCatcher_px.x) * 4;
        if (truth.opaque[i] || !truth.scored[i]) continue;
        for (std::size_t c = at; c < at + 3; ++c) {
            const double shown = 255.0 * encoded_of(as_light(photograph[c] / 255.0) * (1.0 - truth.alpha[i]));
            wrong += std::abs(over[c] - shown) > 1.5;
            lit += truth.alpha[i] == 0.0;
            darker += over[c] + 10 < photograph[c];
        }
    }
    EXPECT_GT(lit, 30000u);
    EXPECT_GT(darker, 2000u);
    EXPECT_LT(static_cast<double>(wrong), kMostWrongShares * 3.0 * kCatcher_px.x * kCatcher_px.y);
    take_caster_away();
    EXPECT_EQ(composed(picture(), photograph), photograph) << "to the bit";
}

/// Takes a photograph of the very ground: the composite is the lit scene itself.
TEST_F(ShadowCatcher, CompositeEqualsTheLitSceneToTheLastStep) {
    assets::Texture grain{.name = "grain", .width = kCatcher_px.x, .height = kCatcher_px.y, .rgba = like_a_photograph(kCatcher_px)};
    library.textures.push_back(grain);
    const std::uint32_t real = add_material({.name = "real", .base_colour = glm::vec4(0.6f, 0.6f, 0.6f, 1.0f), .base_colour_texture = 0, .metallic = 0.0f, .roughness = 1.0f});
    const std::uint32_t mesh = ground_mesh(real);
    ground = place(mesh, {}, false);
    box = place(box_mesh(), {.translation_m = {0.3, 1.0, 0.2}});
    look();
    for (const double side : {-1.0, 1.0})
        add_light({.kind = LightKind::directional, .intensity = 300.0f}, {}, {side, -1.5, -0.3 * side}, kHardMap);
    settings.transparent = false;
    settings.exposure_ev = 10.0f;  // dark, where the tone curve is nearly straight
    draw();
    const std::vector<std::uint8_t> whole = picture();
    world.patch<ShadowCaster>(box, [](ShadowCaster& c) { c.enabled = false; });
    world.patch<MeshRef>(box, [](MeshRef& m) { m.visible = false; });
    draw();
    const std::vector<std::uint8_t> photograph = picture();
    world.patch<ShadowCaster>(box, [](ShadowCaster& c) { c.enabled = true; });
    world.patch<MeshRef>(box, [](MeshRef& m) { m.visible = true; });
    world.patch<MeshRef>(ground, [](MeshRef& m) { m.shadow_catcher = true; });
    settings.transparent = true;
    draw();
    const std::vector<std::uint8_t> over = picture(), composite = composed(over, photograph);
    std::size_t lit = 0, dark = 0;
    int most_lit = 0, most_dark = 0;
    for (std::size_t i = 0; i < whole.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c) {
            const int apart = std::abs(int{whole[c]} - int{composite[c]});
            const bool casts_here = over[i + 3] > 0 && over[i + 3] < 255;
            (casts_here ? dark : lit) += 1;
            int& most = casts_here ? most_dark : most_lit;
            most = std::max(most, apart);
        }
    EXPECT_GT(lit, 30000u);
    EXPECT_GT(dark, 1500u);
    EXPECT_LE(most_lit, 1);
    EXPECT_LE(most_dark, 3) << "the tone curve's bend, and gloss";
    EXPECT_NE(whole, photograph) << "control";
}

TEST_F(ShadowCatcher, WeighsColouredLightsByTheirLuminance) {
    make_stage();
    add_coloured_lights();
    draw();
    expect_rays(600);
    const Compared even = compared(expected(glm::dvec3(1.0 / 3.0)));
    EXPECT_GT(even.wrong, 600u) << "control: channels of one weight are told apart: " << even.text();
}

TEST_F(ShadowCatcher, LiesUnderABlendedSurface) {
    make_stage();
    const std::uint32_t glass = add_material({.name = "glass", .base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 0.5f), .metallic = 1.0f, .roughness = 1.0f, .alpha_mode = assets::AlphaMode::blend});
    const std::uint32_t pane = add_mesh(game::make_card({0.0, 0.3, 0.0}, {0.0, 0.0, 30.0}, {30.0, 0.0, 0.0}), glass);
    add_coloured_lights();
    place(pane, {}, false);
    draw();
    const std::vector<int> covered = alphas();
    Expected truth = expected();  // rays pass blended surfaces
    std::size_t darkened = 0, wrong = 0, scored = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (!truth.catches[i] || !truth.scored[i]) continue;
        ++scored;
        darkened += truth.alpha[i] > 0.02;
        wrong += std::abs(covered[i] - 255.0 * (0.5 + 0.5 * truth.alpha[i])) > 2.0;
    }
    EXPECT_GT(darkened, 500u);
    EXPECT_LT(static_cast<double>(wrong), kMostWrongShares * static_cast<double>(scored));
    EXPECT_GT(compared(truth).wrong, scored / 2) << "control: the pane covers";
}

TEST_F(ShadowCatcher, ShowsOnlyTheFacesThatItsMaterialHas) {
    add_material({.name = "matt", .metallic = 0.0f});
    const std::uint32_t both = add_material({.name = "both", .metallic = 0.0f, .double_sided = true});
    const std::uint32_t mesh = ground_mesh(), two_sided = ground_mesh(both);
    ground = catcher(mesh);
    box = place(box_mesh(), {.translation_m = {0.3, -1.0, 0.2}});
    add_light({.kind = LightKind::point, .intensity = 900.0f}, {-1.0, -4.0, 1.0}, {0.0, 1.0, 0.0}, kHardMap);
    look({0.0, -6.0, 5.0});
    draw();
    for (const int alpha : alphas()) ASSERT_TRUE(alpha == 0 || alpha == 255) << "from behind there is no catcher";
    world.patch<MeshRef>(ground, [&](MeshRef& m) { m.mesh = two_sided; });
    draw();
    expect_rays(300, "from below, by a lamp below");
}

TEST_F(ShadowCatcher, HasHolesWhereItsMaterialIsCutOut) {
    assets::Texture half{.name = "half", .width = 64, .height = 64, .rgba = {}, .linear_filter = false};
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        const std::uint8_t alpha = i % 64 < 32 ? 0 : 255;
        half.rgba.insert(half.rgba.end(), {255, 255, 255, alpha});
    }
    library.textures.push_back(half);
    const std::uint32_t cut = add_material({.name = "cut", .base_colour_texture = 0, .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask});
    ground = catcher(ground_mesh(cut));
    box = place(box_mesh(), {.translation_m = {0.0, 1.0, 1.0}});
    add_light({.kind = LightKind::directional, .intensity = 500.0f}, {}, {0.2, -1.0, -0.2}, kHardMap);
    look();
    draw();
    const Compared c = compared();
    EXPECT_GT(c.dark, 100u) << c.text();
    EXPECT_LT(static_cast<double>(c.wrong), kMostWrongShares * static_cast<double>(c.catches)) << c.text();
    EXPECT_LT(c.wrong_elsewhere, 60u) << c.text();
    EXPECT_LT(c.catches, kCatcher_px.x * kCatcher_px.y / 2u) << "control: the other half is a hole";
}

TEST_F(ShadowCatcher, CastsIfItIsACasterAsWell) {
    ground = catcher(ground_mesh());
    box = catcher(box_mesh(), {.translation_m = {0.3, 0.9, 0.2}}, true);
    add_light({.kind = LightKind::directional, .intensity = 500.0f}, {}, {0.6, -1.0, -0.5}, kHardMap);
    look();
    draw();
    expect_rays(150);
    const std::vector<int> all = alphas();
    EXPECT_EQ(std::count(all.begin(), all.end(), 255), 0) << "ambient light stays, so that nothing is opaque";
    world.patch<ShadowCaster>(box, [](ShadowCaster& c) { c.enabled = false; });
    draw();
    for (const int alpha : alphas()) ASSERT_EQ(alpha, 0);
}

TEST_F(ShadowCatcher, TakesNothingWithoutLight) {
    make_stage();
    draw();
    const Expected truth = expected();
    const std::vector<int> drawn = alphas();
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if (truth.catches[i]) {
            ASSERT_EQ(drawn[i], 0) << "no light at all";
        }
    const ecs::Entity lamp = add_light({.kind = LightKind::point, .intensity = 0.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, kHardMap);
    draw();
    EXPECT_EQ(alphas(), drawn) << "a lamp that is off";
    world.patch<Light>(lamp, [](Light& l) { l.intensity = 800.0f; });
    draw();
    EXPECT_NE(alphas(), drawn) << "control";
}

TEST_F(ShadowCatcher, OfOtherLayersOrNoReceiverCatchesNothing) {
    make_stage();
    const ecs::Entity lamp = add_light({.kind = LightKind::point, .intensity = 800.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, kHardMap);
    const auto caught = [&] {
        draw();
        const std::vector<int> all = alphas();
        return std::count_if(all.begin(), all.end(), [](int alpha) { return alpha > 0 && alpha < 255; });
    };
    EXPECT_GT(caught(), 300);
    world.patch<MeshRef>(ground, [](MeshRef& m) { m.receives_shadow = false; });
    EXPECT_EQ(caught(), 0);
    world.patch<MeshRef>(ground, [](MeshRef& m) { m.receives_shadow = true; m.shadow_layers = 2; });
    world.patch<LightShadow>(lamp, [](LightShadow& s) { s.layers = 1; });
    EXPECT_EQ(caught(), 0);
    world.patch<LightShadow>(lamp, [](LightShadow& s) { s.layers = 2; });
    EXPECT_GT(caught(), 300);
}

TEST_F(ShadowCatcher, TwiceAtOnePlaceIsOne) {
    make_stage();
    catcher(world.get<MeshRef>(ground)->mesh);
    add_coloured_lights();
    draw();
    expect_rays(600);
}

TEST_F(ShadowCatcher, IsExactWithRays) {
    make_stage();
    settings.rays = true;
    add_light({.kind = LightKind::point, .intensity = 800.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, {.filter = ShadowFilter::exact});
    draw();
    const Compared c = compared();
    EXPECT_GT(c.dark, 300u) << c.text();
    EXPECT_EQ(c.wrong, 0u) << c.text();
}

TEST_F(ShadowCatcher, IsTheSameWithoutEconomy) {
    std::vector<std::vector<std::uint8_t>> drawn[2];
    for (const bool economy : {true, false}) {
        start_anew();
        make_stage();
        add_light({.kind = LightKind::point, .intensity = 800.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, kHardMap,
                  {.reuse = {.economy = economy}});
        for (int i = 0; i < 4; ++i) {
            if (i > 1) world.patch<Transform>(box, [&](Transform& t) { t.translation_m.x = 0.5 * i; });
            draw();
            drawn[economy].push_back(picture());
        }
    }
    EXPECT_EQ(drawn[0], drawn[1]) << "to the bit";
    EXPECT_EQ(drawn[0][0], drawn[0][1]);
    EXPECT_NE(drawn[0][1], drawn[0][3]) << "control";
}

TEST_F(ShadowCatcher, DarkensWhatIsBehindItInAnOpaquePicture) {
    make_stage();
    const ecs::Entity lamp = add_light({.kind = LightKind::point, .intensity = 800.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, kHardMap);
    settings.transparent = false;
    draw();
    const std::vector<std::uint8_t> caught = picture();
    world.patch<LightShadow>(lamp, [](LightShadow& s) { s.enabled = false; });
    draw();
    const std::vector<std::uint8_t> unshadowed = picture();
    // Turned over it is seen from behind: the scene is as large, and its ambient light the same.
    world.patch<Transform>(ground, [](Transform& t) { t.rotation = glm::dquat(0.0, 1.0, 0.0, 0.0); });
    draw();
    const std::vector<std::uint8_t> without = picture();
    std::size_t darker = 0, brighter = 0;
    for (std::size_t i = 0; i < caught.size(); ++i) {
        darker += caught[i] + 3 < unshadowed[i];
        brighter += caught[i] > unshadowed[i];
    }
    EXPECT_GT(darker, 600u);
    EXPECT_EQ(brighter, 0u);
    for (std::size_t i = 3; i < caught.size(); i += 4) ASSERT_EQ(caught[i], 255);
    EXPECT_EQ(without, unshadowed) << "a catcher without shadow is invisible";
}

TEST_F(ShadowCatcher, AlphaHasTheSamplesOfAStillPicture) {
    make_stage();
    add_light({.kind = LightKind::directional, .intensity = 500.0f}, {}, {0.6, -1.0, -0.5}, kHardMap);
    draw();
    std::vector<int> one = alphas();
    std::sort(one.begin(), one.end());
    const auto values_of_one = std::unique(one.begin(), one.end()) - one.begin();
    settings.still_samples = 16;
    for (int i = 0; i < 40 && frame().report().samples < 16; ++i) draw();
    ASSERT_EQ(frame().report().samples, 16u);
    const std::vector<int> many = alphas();
    std::vector<int> sorted = many;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_GT(std::unique(sorted.begin(), sorted.end()) - sorted.begin(), values_of_one + 10) << "edges have values between";
    const Expected truth = expected();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < many.size(); ++i) wrong += std::abs(many[i] - 255.0 * truth.alpha[i]) > 20.0;
    EXPECT_LT(static_cast<double>(wrong), 0.06 * static_cast<double>(many.size())) << "apart from edges";
    // Colours stay multiplied by alpha: none is brighter than full white of that coverage.
    const std::vector<std::uint8_t> rgba = picture();
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c) ASSERT_LE(as_light((rgba[c] - 1.0) / 255.0), (rgba[i + 3] + 1.0) / 255.0);
}

TEST_F(ShadowCatcher, SmoothedEdgesKeepAlpha) {
    make_stage();
    add_light({.kind = LightKind::directional, .intensity = 500.0f}, {}, {0.6, -1.0, -0.5}, kHardMap);
    draw();
    const std::vector<int> plain = alphas();
    settings.smooth_edges = true;
    draw();
    const std::vector<int> smooth = alphas();
    std::size_t changed = 0, by_much = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        changed += plain[i] != smooth[i];
        by_much += std::abs(plain[i] - smooth[i]) > 250;
    }
    EXPECT_GT(changed, 100u) << "its steps are smoothed";
    EXPECT_LT(changed, plain.size() / 8);
    EXPECT_EQ(by_much, 0u);
}

TEST_F(ShadowCatcher, IsNoSurfaceOfAPictureOfVisibility) {
    make_stage();
    add_light({.kind = LightKind::point, .intensity = 800.0f}, {-2.0, 4.0, 1.0}, {0.0, -1.0, 0.0}, kHardMap);
    draw();
    const std::vector<float> seen = visibility();
    const Expected truth = expected();
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (truth.catches[i]) {
            ASSERT_EQ(seen[i], -1.0f);
        }
    EXPECT_EQ(judge().metrics.acne + judge().metrics.leak, 0u) << "the judge agrees";
}

}  // namespace
}  // namespace gnomon
