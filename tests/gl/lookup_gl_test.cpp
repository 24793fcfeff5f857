#include <algorithm>
#include <array>
#include <functional>
#include <set>

#include "systems/shadow/request/filter_table.h"
#include "systems/visibility/light_queries.h"
#include "tests/gl/lights_fixture.h"

/// All lights of a view in one draw, by one program (systems/lookup), against the lighting's own pass per light.
namespace gnomon {
namespace {

using lookup::LookupStatus;

TEST_F(AllLights, OfEveryKindInOneDrawAreSeenAsByTheirOwnPass) {
    add_eight();
    start();
    run();
    const gl::ProgramHandle program = surface_program();
    expect_alike(program);

    // Controls: another light's shadow differs, and so does a shadow without its caster.
    const auto found = looked_up(program);
    for (std::uint32_t i = 0; i < found.size(); ++i) EXPECT_GT(difference(found[i], recorded((i + 1) % 8)).pixels, 100u) << name(i);
    world.remove<ShadowCaster>(boxes.front());
    run();
    const auto without = looked_up(program);
    for (std::uint32_t i = 0; i < found.size(); ++i) EXPECT_GT(difference(found[i], without[i]).pixels, 50u) << name(i);
    expect_alike(program);
}

TEST_F(AllLights, WherePixelsLookUpDifferentLightsAtOnceAreSeenTheSame) {
    add_eight();
    start({.filters = kFew});
    run();
    const auto uniform = looked_up(surface_program());
    // Neighbours go through the lights in different orders, so that none is the same for all.
    const std::string turned = "int(light + pixel.x + 3 * pixel.y) % 8";
    const auto found = looked_up(surface_program(
        "gnomon_visibility(" + turned + ", surface.position_ca, surface.geometric_normal, surface.error_m)"));
    std::size_t dark = 0, apart = 0;
    for (std::size_t light = 0; light < found.size(); ++light)
        for (std::size_t i = 0; i < found[light].size(); ++i) {
            const std::size_t x = i % settings.viewport_px.x, y = i / settings.viewport_px.x;
            apart += found[light][i] != uniform[(light + x + 3 * y) % 8][i] ? 1 : 0;
            dark += found[light][i] == 0.0f ? 1 : 0;
        }
    EXPECT_EQ(apart, 0u);
    EXPECT_GT(dark, 800u);
}

TEST_F(AllLights, OfEveryUsualFilterAreSeenAsByTheirOwnPass) {
    using enum ShadowFilter;
    for (const ShadowFilter filter : {hard, hardware_2x2, pcf_grid, pcf_bilinear, sharp_4x4, triangles, pcss})
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
            add(kind, {.filter = filter, .resolution_px = 256}, lights.size());
    start();
    run();
    expect_alike(surface_program());
}

TEST_F(AllLights, WithAntialiasedEdgesAreSeenAsByTheirOwnPass) {
    const std::vector kTriangles{ShadowFilter::triangles};
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        add(kind, {.filter = ShadowFilter::triangles, .antialias = true, .resolution_px = 256}, lights.size());
    const auto shares = [](const std::vector<float>& seen) {
        return std::count_if(seen.begin(), seen.end(), [](float share) { return share > 0.0f && share < 1.0f; });
    };
    start({.filters = kTriangles, .antialias = true});
    run();
    const gl::ProgramHandle program = surface_program();
    // Lookups take the areas of all pixels. Passes leave out what no middle and no texel beside it shows.
    constexpr std::size_t kMostLeftOut = 5;
    constexpr double kOnePlace = 1.01 / 32.0;
    expect_alike(program, 100, kMostLeftOut, kOnePlace);
    for (const std::vector<float>& seen : looked_up(program)) EXPECT_GT(shares(seen), 50);
    // Control: a text without it decides by each pixel's middle.
    start({.filters = kTriangles});
    run();
    for (const std::vector<float>& seen : looked_up(surface_program())) EXPECT_EQ(shares(seen), 0);
}

TEST_F(AllLights, OfSourcesWithAntialiasedEdgesAreSeenAsByTheirOwnPass) {
    const std::vector kSoft{ShadowFilter::pcss};
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        add(kind, {.filter = ShadowFilter::pcss, .antialias = true, .resolution_px = 256}, lights.size());
    start({.filters = kSoft, .antialias = true});
    run();
    const auto spread = looked_up(surface_program());
    expect_alike(surface_program());
    // Control: a text without it has all taps begin at each pixel's middle.
    start({.filters = kSoft});
    run();
    EXPECT_NE(looked_up(surface_program()), spread);
}

TEST_F(AllLights, OfEveryOtherFilterThatReadsDepthsAreSeenAsByTheirOwnPass) {
    using enum ShadowFilter;
    const std::vector<ShadowFilter> filters = {poisson, poisson_rotated, poisson_stratified, cube_grid, cube_directions};
    for (const ShadowFilter filter : filters)
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
            add(kind, {.filter = filter, .resolution_px = 256}, lights.size());
    start({.filters = filters});
    run();
    expect_alike(surface_program());
}

TEST_F(AllLights, WithEveryBiasWarpsAndFadesAreSeenAsByTheirOwnPass) {
    for (const BiasMode mode : {BiasMode::constant, BiasMode::slope, BiasMode::receiver_plane})
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
            ShadowTuning tuning;
            tuning.bias.mode = mode;
            add(kind, {.filter = ShadowFilter::pcf_grid, .resolution_px = 256}, lights.size(), 0.6f, tuning);
        }
    ShadowTuning fades;
    fades.cascades.blend = 0.3f;
    add(LightKind::directional, {.resolution_px = 256, .cascades = 3}, lights.size(), 0.6f, fades);
    ShadowTuning warped;
    warped.cascades.fit = ShadowFit::tight;
    warped.cascades.warp = 1.0f;
    add(LightKind::directional, {.resolution_px = 256, .cascades = 1}, lights.size(), 0.6f, warped);
    start();
    run();
    EXPECT_TRUE(inputs().lights[lights.size() - 2].row.fades);
    EXPECT_EQ(lookup::lookup_kind(inputs().lights.back().row), lookup::LookupKind::warped_cascades);
    EXPECT_TRUE(inputs().lights.front().row.manual_bias);
    expect_alike(surface_program());
}

TEST_F(AllLights, OfMaskedCastersAreSeenAsByTheirOwnPassWithTheirMasks) {
    assets::Texture holes;
    holes.width = holes.height = 8;
    for (std::uint32_t i = 0; i < 64; ++i) holes.rgba.insert(holes.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>((i + i / 8) % 3 == 0 ? 0 : 255)});
    library.textures.push_back(holes);
    const std::uint32_t masked = add_material({.name = "masked", .base_colour_texture = 0, .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
    place(add_mesh(game::make_card({0, 0, 0}, {0, 0, 2}, {2, 0, 0}), masked), {.translation_m = {0.0, 1.9, 0.0}});
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) add(kind, {.resolution_px = 512}, lights.size());
    start({.filters = kFew});
    run();
    ASSERT_TRUE(inputs().lights.front().row.ray_masks);
    expect_alike(surface_program());
    const auto with = looked_up(surface_program());

    // A text without masks takes another filter, which sees the holes in the map's depths.
    const lookup::LookupRows rows{.filters = lookup::usual_filters(), .masks = false};
    text = lookup::lookup_glsl(kBindings, rows).value();
    table = std::make_unique<lookup::LookupTable>(device(), kBindings, rows);
    const auto without = looked_up(surface_program());
    std::size_t apart = 0;
    for (std::uint32_t i = 0; i < with.size(); ++i) {
        EXPECT_EQ(table->outcomes()[i], (lookup::LookupOutcome{LookupStatus::nearest_filter, ShadowFilter::pcss})) << name(i);
        const Difference d = difference(with[i], without[i]);
        EXPECT_LT(d.pixels, with[i].size() / 100) << name(i);
        apart += d.pixels;
    }
    EXPECT_GT(apart, 0u) << "it is no other filter";
}

TEST_F(AllLights, ShareMapsOfAFewSizesUnlessTheyMoveInWholeTexels) {
    ShadowTuning stable;
    stable.cascades.fit = ShadowFit::stable;
    add(LightKind::directional, {.resolution_px = 700}, 0);
    add(LightKind::directional, {.resolution_px = 700}, 1, 0.6f, stable);
    add(LightKind::spot, {.resolution_px = 40}, 2);
    start({.filters = kFew});
    run();
    expect_alike(surface_program());
    std::vector<std::uint32_t> widths;
    for (const shadow::LightingLight& light : inputs().lights) widths.push_back(device().shared_layers(light.map).width);
    EXPECT_EQ(widths, (std::vector<std::uint32_t>{1024, 700, 256}));
    // Without shared layers nothing can be looked up, and all of it is lit.
    shadows = std::make_unique<shadow::ShadowSystem>(device());
    run();
    const auto lit = looked_up(surface_program());
    for (std::uint32_t i = 0; i < lit.size(); ++i) {
        EXPECT_EQ(table->outcomes()[i].status, LookupStatus::not_shared);
        EXPECT_GT(difference(lit[i], recorded(i)).pixels, 100u);
    }
}

TEST_F(AllLights, AHundredAreLookedUpInOneDraw) {
    settings.viewport_px = {96, 72};
    for (std::size_t i = 0; i < 100; ++i)
        add(i % 3 == 0 ? LightKind::point : LightKind::spot, {.resolution_px = 64}, i);
    start({.filters = std::span(kFew).first(1), .suns = false, .warped_suns = false, .masks = false});
    run();
    expect_alike(surface_program(), 20);
    // All of them share an array or two.
    std::set<std::uint32_t> arrays;
    for (const shadow::LightingLight& light : inputs().lights) arrays.insert(device().shared_layers(light.map).array.id);
    EXPECT_LE(arrays.size(), 2u);
    EXPECT_FALSE(arrays.contains(0));
}

TEST_F(AllLights, ComeGoAndChangeWithoutAnotherProgram) {
    add_eight();
    const lookup::LookupRows rows{.filters = kFew};
    start(rows);
    run();
    const auto hash = [&] { return std::hash<std::string>{}(lookup::lookup_glsl(kBindings, rows).value()); };
    const std::size_t before = hash();
    const gl::ProgramHandle program = surface_program();
    expect_alike(program);
    const auto at_first = looked_up(program);
    // One goes, two come, one gets another size, another filter, another kind.
    world.remove<Light>(lights[1]);
    world.remove<LightShadow>(lights[1]);
    add(LightKind::point, {.resolution_px = 300}, 9);
    add(LightKind::spot, {.filter = ShadowFilter::hardware_2x2, .resolution_px = 512}, 10);
    world.patch<LightShadow>(lights[0], [](LightShadow& shadow) { shadow.resolution_px = 1500; });
    world.patch<LightShadow>(lights[2], [](LightShadow& shadow) { shadow.filter = ShadowFilter::pcf_bilinear; });
    world.patch<Light>(lights[3], [](Light& light) { light.kind = LightKind::point; });
    run();
    EXPECT_EQ(inputs().lights.size(), 9u);
    expect_alike(program);
    EXPECT_EQ(hash(), before);
    EXPECT_EQ(lookup::lookup_glsl(kBindings, rows).value(), text);
    EXPECT_GT(difference(at_first[2], looked_up(program)[2]).pixels, 100u) << "nothing changed: the test sees nothing";
    // All but two go.
    for (std::size_t i = 2; i < lights.size(); ++i) {
        world.remove<Light>(lights[i]);
        world.remove<LightShadow>(lights[i]);
    }
    for (int frame = 0; frame < 3; ++frame) run();
    ASSERT_LT(inputs().lights.size(), 3u);
    expect_alike(program);
}

TEST_F(AllLights, OfFiltersThatATextHasNotAreLookedUpByTheNearest) {
    using enum ShadowFilter;
    const std::vector<ShadowFilter> filters = {vsm, evsm4, exact, exact_soft, pcss_moments, poisson, triangles};
    for (const ShadowFilter filter : filters) add(LightKind::spot, {.filter = filter, .resolution_px = 256}, lights.size());
    start();
    run();
    const auto found = looked_up(surface_program());
    const std::vector<ShadowFilter> nearest = {pcf_bilinear, pcf_bilinear, pcss, pcss, pcss, pcf_grid, triangles};
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        const lookup::LookupOutcome& seen = table->outcomes()[i];
        EXPECT_EQ(seen.status, i + 1 < found.size() ? LookupStatus::nearest_filter : LookupStatus::own_filter) << name(i);
        EXPECT_EQ(seen.filter, nearest[i]) << name(i);
        // Near its own: most pixels lie off any edge.
        const std::vector<float> own = recorded(i);
        std::size_t far = 0, dark = 0;
        for (std::size_t k = 0; k < own.size(); ++k) {
            far += std::abs(own[k] - found[i][k]) > 0.5f ? 1 : 0;
            dark += own[k] >= 0.0f && own[k] < 0.5f ? 1 : 0;
        }
        EXPECT_LT(far, own.size() / 100) << name(i);
        EXPECT_GT(dark, 100u) << name(i);
    }
}

TEST_F(AllLights, WithoutAUnitOrARowAreLitAndSaySo) {
    for (const std::uint32_t size_px : {256u, 512u, 1024u}) add(LightKind::spot, {.resolution_px = size_px}, lights.size());
    add(LightKind::point, {.resolution_px = 256}, lights.size());
    start();
    run();
    lookup::LookupBindings few = kBindings;
    few.texture_unit_count = lookup::kTexelUnits + 4;
    const lookup::LookupRows rows{.cubes = false};
    text = lookup::lookup_glsl(few, rows).value();
    table = std::make_unique<lookup::LookupTable>(device(), few, rows);
    const auto found = looked_up(surface_program());
    const std::vector<LookupStatus> expected = {LookupStatus::own_filter, LookupStatus::own_filter, LookupStatus::no_unit, LookupStatus::no_row};
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(table->outcomes()[i].status, expected[i]) << i;
        const Difference d = difference(found[i], recorded(i));
        EXPECT_TRUE(i < 2 ? d.pixels == 0 : d.pixels > 100) << i << ": " << d.pixels << " pixels lack its shadow";
    }
    // When a map goes, its unit serves another.
    world.remove<Light>(lights[0]);
    world.remove<LightShadow>(lights[0]);
    world.remove<Light>(lights[3]);
    world.remove<LightShadow>(lights[3]);
    run();
    const auto later = looked_up(surface_program());
    for (std::uint32_t i = 0; i < later.size(); ++i) {
        EXPECT_EQ(table->outcomes()[i].status, LookupStatus::own_filter) << i;
        EXPECT_EQ(difference(later[i], recorded(i)).pixels, 0u) << i;
    }
}

// An engine's text may name anything as the shaders of one light do, in a compute shader as well, from version 4.30 on.
TEST_F(AllLights, StandBesideAnyNamesOfAnEngine) {
    const std::string names =
        "struct ShadowPoint { float light; };\nfloat light = 1.0, camera = 2.0, shadow_map = 3.0, map_edge_px = 4.0;\n"
        "const int kMostSteps = 5, kDisk = 6;\nfloat largest(float v) { return v; }\nfloat shadow_visibility(float v) { return v; }\n";
    const std::string body =
        "layout(local_size_x = 4, local_size_y = 4) in;\nlayout(std430, binding = 6) buffer Results { float results[]; };\n"
        "void main() { results[gl_GlobalInvocationID.x] = light + camera + largest(gnomon_visibility(0, vec3(1.0))); }\n";
    const std::string mine = lookup::lookup_glsl(kBindings, {.filters = kFew}).value();
    const std::string hardware = lookup::lookup_glsl(kBindings, {.filters = kFew, .for_hardware = true}).value();
    EXPECT_NE(hardware, mine);
    for (const std::string& engine : {names + mine, mine + names, names + hardware}) {
        const auto made = device().create_program({.label = "fog", .compute = "#version 430 core\n" + engine + body});
        EXPECT_TRUE(made) << made.log;
        device().destroy(made.handle);
    }
    EXPECT_FALSE(device().create_program({.label = "fog", .compute = "#version 430 core\n" + mine + "float gnomon_light;\n" + body}))
        << "what is taken is noticed";
    take_messages();
}

TEST_F(AllLights, BindingsAndRowsThatNoTextCanHaveAreRefused) {
    const auto rule = [](const auto& made) { return made ? std::string("none") : made.error().rule; };
    const std::vector<ShadowFilter> none, rays = {ShadowFilter::exact};
    EXPECT_EQ(rule(lookup::lookup_glsl({.texture_unit_count = 4})), "lookup.bindings");
    EXPECT_EQ(rule(lookup::lookup_glsl({.texture_unit_count = 5})), "none");
    EXPECT_EQ(rule(lookup::lookup_glsl({}, {.filters = none})), "lookup.rows");
    EXPECT_EQ(rule(lookup::lookup_glsl({}, {.filters = rays})), "lookup.rows");
    EXPECT_EQ(rule(lookup::lookup_glsl({}, {.suns = false, .warped_suns = false, .cones = false, .cubes = false})), "lookup.rows");
}

TEST_F(AllLights, ASteadyTableUploadsNothing) {
    add_eight();
    start({.filters = kFew});
    run();
    gl::CommandList first, second;
    ASSERT_TRUE(table->update(inputs(), *scene, first));
    EXPECT_FALSE(first.commands.empty());
    ASSERT_TRUE(table->update(inputs(), *scene, second));
    EXPECT_TRUE(second.commands.empty());
    table->forget_upload();
    ASSERT_TRUE(table->update(inputs(), *scene, second));
    EXPECT_EQ(first, second);
}

// A receiver without a surface, as fog: points in the air above the ground, where rays are the truth.
TEST_F(AllLights, InTheAirAreSeenAsByRays) {
    add_eight();
    start({.filters = std::span(kFew).first(1)});
    run();
    // Slices of a volume between the camera and the ground, a texel per pixel.
    const auto found = looked_up(surface_program(
        "gnomon_uniform_visibility(light, vec3((gl_FragCoord.x / float(size.x) - 0.5) * 5.0, 0.05 + gl_FragCoord.y / "
        "float(size.y) * 2.0, -1.2 + 0.6 * float(pixel.x % 5)) - vec3(0.0, 5.0, 7.0))"));
    visibility::CasterTrees trees(library);
    visibility::LightQueries queries(trees);
    std::vector<visibility::Place> places;
    for (std::uint32_t y = 0; y < settings.viewport_px.y; ++y)
        for (std::uint32_t x = 0; x < settings.viewport_px.x; ++x)
            places.push_back({{((x + 0.5) / settings.viewport_px.x - 0.5) * 5.0, 0.05 + (y + 0.5) / settings.viewport_px.y * 2.0, -1.2 + 0.6 * (x % 5)}});
    std::vector<float> truth(places.size());
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        LightItem light = snapshot.lights[inputs().lights[i].light];
        light.source_radius_m = light.sun_radius_rad = 0.0f;  // `triangles` shadows as a point does
        queries.ask(snapshot, light, places, {}, truth);
        std::size_t wrong = 0, dark = 0, lit = 0, judged = 0;
        for (std::size_t k = 0; k < places.size(); ++k) {
            if (found[i][k] < 0.0f) continue;
            ++judged;
            wrong += std::abs(truth[k] - found[i][k]) > 0.5f ? 1 : 0;
            (truth[k] > 0.5f ? lit : dark) += 1;
        }
        RecordProperty("wrong_" + std::to_string(i), std::to_string(wrong) + " of " + std::to_string(judged));
        EXPECT_GT(dark, 300u) << name(i);
        EXPECT_GT(lit, 300u) << name(i);
        EXPECT_LE(static_cast<double>(wrong), 0.0005 * static_cast<double>(judged)) << name(i);
    }
}

}  // namespace
}  // namespace gnomon
