#include "tests/gl/embed_fixture.h"
#include "tests/unit/allocation_counter.h"

// Views of gnomon::Shadows with casters and receivers of their own.
namespace gnomon {
namespace {

constexpr ShadowLayers kCommon = 1, kFirstAlone = 2;

class EmbedLayers : public EmbedTest {
protected:
    /// Adds a ground and a table for all views, and a box that has a layer of its own.
    void build(LightKind kind) {
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
        ground = add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
        table = add(game::make_box({-0.8, 0.7, -0.5}, {0.8, 0.8, 0.5}));
        box = add(game::make_box({-1.7, 0.3, 0.2}, {-1.1, 0.9, 0.8}));
        for (const auto& [caster, layers] : {std::pair(ground, kCommon), std::pair(table, kCommon), std::pair(box, kFirstAlone)})
            shadows->set_caster(caster, {.mesh = mesh_of(caster), .cast_layers = layers});
        lamp = add_shadowed(kind, {1.5, 3.0, 1.0});
        look_from({0.5, 2.5, 4.0});
        draw_depths(view, *engine);
        without = view;
        without.cast_layers = kCommon;
    }
    /// Returns the mesh of a caster that the fixture added: it adds both in the same order.
    static MeshId mesh_of(CasterId caster) { return {caster.index, caster.version}; }
    static std::vector<std::uint8_t> layer(const Mask& mask) { return layer_of(mask, 0); }
    /// Renders a world of these shapes alone, in which the box receives, and casts or not.
    std::vector<std::uint8_t> rendered_alone(LightKind kind, bool with_box) {
        auto other = std::move(Shadows::create(options()).value());
        for (std::size_t i = 0; i < room.size(); ++i) {
            const auto mesh = other->add_mesh({.positions_m = room[i].positions, .indices = room[i].indices});
            other->add_caster({.mesh = mesh.value(), .casts = with_box || i != 2});
        }
        const glm::dvec3 at_m(1.5, 3.0, 1.0);
        const LightId light = other->add_light({.light = {.kind = kind, .outer_cone_rad = 0.9f}, .position_m = at_m, .direction = -at_m});
        View plain = view;
        plain.cast_layers = plain.receive_layers = kAllShadowLayers;
        const std::vector<std::uint8_t> mask = layer(other->render(plain));
        status_alone = other->status(light);
        return mask;
    }

    CasterId ground, table, box;
    LightId lamp;
    LightStatus status_alone;
    View without;
};

class EmbedLayersOfKind : public EmbedLayers, public ::testing::WithParamInterface<LightKind> {};

TEST_P(EmbedLayersOfKind, EachViewShowsAWorldOfItsOwnCasters) {
    build(GetParam());
    const std::vector<std::uint8_t> of_all = rendered_alone(GetParam(), true);
    const LightStatus all = status_alone;
    const std::vector<std::uint8_t> of_less = rendered_alone(GetParam(), false);
    ASSERT_GT(differing(of_all, of_less), 400u) << "control: the box throws a shadow";
    const View both[] = {view, without};
    for (int frame = 0; frame < 3; ++frame) {
        const auto masks = shadows->render(both);
        ASSERT_EQ(masks.size(), 2u);
        EXPECT_EQ(layer(masks[0]), of_all);
        EXPECT_EQ(layer(masks[1]), of_less);
    }
    EXPECT_EQ(shadows->status(lamp).maps, all.maps + status_alone.maps);
    EXPECT_EQ(shadows->status(lamp).bytes, all.bytes + status_alone.bytes);
    EXPECT_EQ(shadows->status().bytes, shadows->status(lamp).bytes);
    const View turned[] = {without, view};
    const auto masks = shadows->render(turned);
    EXPECT_EQ(layer(masks[0]), of_less) << "the order of views does not matter";
    EXPECT_EQ(layer(masks[1]), of_all);
    EXPECT_EQ(layer(shadows->render(without)), of_less) << "nor how many there are";
    EXPECT_EQ(layer(shadows->render(view)), of_all);
    EXPECT_EQ(shadows->status(lamp).maps, all.maps);
}

INSTANTIATE_TEST_SUITE_P(All, EmbedLayersOfKind, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(kind_name(row.param)); });

/// Shows four viewports of one scene, each with its own light, casters, receivers and surfaces.
TEST_F(EmbedLayers, FourViewportsShowFourWorldsEachAsIfAlone) {
    constexpr std::size_t kWorlds = 4;
    const game::Shape floor = game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 6.0}, {6.0, 0.0, 0.0});
    const LightKind kinds[kWorlds] = {LightKind::directional, LightKind::spot, LightKind::point, LightKind::point};
    const auto box_of = [](std::size_t i) {
        const double x = -0.9 + 0.6 * static_cast<double>(i);
        return game::make_box({x, 0.3, -0.4}, {x + 0.5, 0.9 + 0.1 * static_cast<double>(i), 0.3});
    };
    const auto light_of = [&](std::size_t i, ShadowLayers layers) {
        const glm::dvec3 at_m(1.5 - static_cast<double>(i), 3.0, 1.0 - 0.5 * static_cast<double>(i));
        return LightDesc{.light = {.kind = kinds[i], .outer_cone_rad = 0.9f}, .position_m = at_m, .direction = -at_m, .shadow = {.layers = layers}};
    };
    const auto add_to = [](Shadows& to, const game::Shape& shape, ShadowLayers layers) {
        const auto mesh = to.add_mesh({.positions_m = shape.positions, .indices = shape.indices});
        return to.add_caster({.mesh = mesh.value(), .cast_layers = layers, .receive_layers = layers});
    };
    LightId lamps[kWorlds];
    CasterId boxes[kWorlds];
    View views[kWorlds];
    std::vector<std::unique_ptr<Engine>> engines;
    for (std::size_t i = 0; i < kWorlds; ++i) {
        const auto own = static_cast<ShadowLayers>(1 << i);
        add_to(*shadows, floor, own);
        boxes[i] = add_to(*shadows, box_of(i), own);
        lamps[i] = shadows->add_light(light_of(i, own));
        engines.push_back(std::make_unique<Engine>(Depths::usual_float));
        engines[i]->add(floor.positions, floor.indices);
        engines[i]->add(box_of(i).positions, box_of(i).indices);
        const glm::dvec3 from_m(0.5 - static_cast<double>(i), 2.5, 4.0);
        views[i].world_from_view = glm::inverse(glm::lookAt(from_m, glm::dvec3(0.0, 0.5, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
        views[i].normal_texture = engines[i]->normals;
        views[i].lights = {&lamps[i], 1};
        views[i].cast_layers = views[i].receive_layers = own;
        draw_depths(views[i], *engines[i]);
    }
    std::vector<std::uint8_t> alone[kWorlds], without[kWorlds];
    for (std::size_t i = 0; i < kWorlds; ++i)
        for (const bool casts : {true, false}) {
            auto single = std::move(Shadows::create(options()).value());
            add_to(*single, floor, kAllShadowLayers);
            if (casts) add_to(*single, box_of(i), kAllShadowLayers);
            single->add_light(light_of(i, kAllShadowLayers));
            View plain = views[i];
            plain.lights = {};
            plain.cast_layers = plain.receive_layers = kAllShadowLayers;
            (casts ? alone : without)[i] = layer(single->render(plain));
        }
    for (int frame = 0; frame < 3; ++frame) {
        const auto masks = shadows->render(views);
        for (std::size_t i = 0; i < kWorlds; ++i) {
            SCOPED_TRACE(i);
            EXPECT_EQ(masks[i].layers, 1u);
            EXPECT_EQ(layer(masks[i]), alone[i]) << "to the bit";
            EXPECT_GT(differing(alone[i], without[i]), 400u) << "control: its box throws a shadow";
        }
    }
    // Control: a box of the first world in the second one's layer leaves the first and comes to the second.
    const MeshId mesh{boxes[0].index, boxes[0].version};
    shadows->set_caster(boxes[0], {.mesh = mesh, .cast_layers = 2, .receive_layers = 2});
    const auto masks = shadows->render(views);
    EXPECT_GT(differing(layer(masks[0]), alone[0]), 400u);
    EXPECT_GT(differing(layer(masks[1]), alone[1]), 100u);
    for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) EXPECT_EQ(layer(masks[i]), alone[i]);
}

TEST_F(EmbedLayers, ViewsThatSeeTheSameShareTheirMaps) {
    build(LightKind::point);
    const View plain[] = {view, view};
    shadows->render(plain);
    const LightStatus of_plain = shadows->status(lamp);
    ASSERT_GT(of_plain.draws, 0u);
    // Other layers, but every caster has one of them.
    View second = view;
    second.cast_layers = kCommon | kFirstAlone;
    second.receive_layers = 0x80;
    const View alike[] = {view, second};
    shadows->render(alike);
    shadows->render(alike);
    EXPECT_EQ(shadows->status(lamp).maps, of_plain.maps);
    EXPECT_EQ(shadows->status(lamp).bytes, of_plain.bytes);
    EXPECT_TRUE(shadows->status().still) << "not even a change";
    shadows->render(view);
    shadows->render(view);
    shadows->render(second);
    EXPECT_EQ(shadows->status().maps_drawn, 0u) << "nor where only one of them is asked for";
    shadows->set_caster(table, {.mesh = mesh_of(table), .cast_layers = 0x80});
    shadows->render(alike);
    EXPECT_GT(shadows->status(lamp).bytes, of_plain.bytes) << "control: now they differ";
}

TEST_F(EmbedLayers, WhatAViewDoesNotSeeCostsItNothing) {
    build(LightKind::spot);
    shadows->render(without);
    const auto move_box = [&](double by_m) { shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {by_m, 0.0, 0.0})); };
    move_box(0.1);
    shadows->render(without);
    EXPECT_EQ(shadows->status().maps_drawn, 0u);
    EXPECT_EQ(shadows->status(lamp).reason, Reason::content_unchanged);
    const View both[] = {view, without};
    shadows->render(both);
    move_box(0.2);
    shadows->render(both);
    EXPECT_EQ(shadows->status().maps_drawn, 1u) << "the map of the view that sees it";
    shadows->render(without);
    shadows->render(both);
    EXPECT_EQ(shadows->status().maps_drawn, 0u) << "a view that is not asked for keeps its maps for a while";
    for (int frame = 0; frame < 130; ++frame) shadows->render(without);
    shadows->render(both);
    EXPECT_EQ(shadows->status().maps_drawn, 1u) << "not for ever";
    shadows->set_budget({.bytes = std::uint64_t{1} << 30});
    shadows->render(both);
    shadows->render(without);
    shadows->render(both);
    EXPECT_EQ(shadows->status().maps_drawn, 1u) << "nor beyond a budget, which knows of what is in use";
}

TEST_F(EmbedLayers, ReceiversOfOtherLayersHaveNoPartInTheMaps) {
    build(LightKind::point);
    for (const CasterId caster : {ground, table, box})
        shadows->set_caster(caster, {.mesh = mesh_of(caster), .receive_layers = kCommon});
    shadows->render(view);
    EXPECT_EQ(shadows->status(lamp).state, LightState::rendered);
    view.receive_layers = kFirstAlone;
    const std::vector<std::uint8_t> mask = layer(shadows->render(view));
    EXPECT_EQ(shadows->status(lamp).state, LightState::skipped);
    EXPECT_EQ(shadows->status(lamp).reason, Reason::no_visible_receiver);
    EXPECT_EQ(shadows->status().bytes, 0u);
    EXPECT_GT(std::count(mask.begin(), mask.end(), 255), 20000) << "its surfaces are lit";
}

TEST_F(EmbedLayers, HoldForDrawablesAndNotForQueries) {
    build(LightKind::point);
    int calls = 0;
    shadows->add_drawable({.draw = [&](const DrawableView&) { ++calls; }, .bounds = {{0.5, 0.2, 0.5}, {0.9, 0.6, 0.9}}, .cast_layers = kFirstAlone});
    shadows->render(without);
    EXPECT_EQ(calls, 0);
    EXPECT_EQ(shadows->status(lamp).by_depth, 0u);
    const glm::dvec3 below_the_box(-1.7, 0.1, 0.35);
    EXPECT_EQ(shadows->visibility(lamp, below_the_box), 0.0f) << "queries know no views";
    shadows->render(view);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(shadows->status(lamp).by_depth, 1u);
    shadows->remove(box);
    shadows->render(without);
    EXPECT_EQ(shadows->visibility(lamp, below_the_box), 1.0f) << "control";
}

TEST_F(EmbedLayers, AByteBudgetHoldsOverAllViews) {
    build(LightKind::point);
    const View both[] = {view, without};
    shadows->render(both);
    const std::uint64_t all = shadows->status().bytes;
    shadows->set_budget({.bytes = all / 3});
    for (int frame = 0; frame < 4; ++frame) shadows->render(both);
    EXPECT_LE(shadows->status().bytes, all / 3);
    EXPECT_GT(shadows->status().bytes, 0u);
    EXPECT_EQ(shadows->status(lamp).state, LightState::degraded);
    EXPECT_EQ(shadows->status(lamp).reason, Reason::budget_shrunk);
}

TEST_F(EmbedLayers, NothingIsAllocatedOnceWarm) {
    build(LightKind::spot);
    const View both[] = {view, without};
    int frames = 0;
    const auto frame = [&] {
        shadows->set_transform(box, glm::translate(glm::dmat4(1.0), {0.01 * (++frames % 8), 0.0, 0.0}));
        shadows->set_transform(table, glm::translate(glm::dmat4(1.0), {0.0, 0.01 * (frames % 8), 0.0}));
        shadows->render(both);
    };
    for (int i = 0; i < 40; ++i) frame();
    const std::size_t before = allocation_count();
    for (int i = 0; i < 6; ++i) frame();
    EXPECT_EQ(allocation_count() - before, 0u);
    EXPECT_EQ(shadows->status().maps_drawn, 2u) << "control: both views' maps were drawn";
}

}  // namespace
}  // namespace gnomon
