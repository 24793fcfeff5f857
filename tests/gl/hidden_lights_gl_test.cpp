#include <random>

#include "tests/gl/frame_fixture.h"
#include "tests/unit/math/random_seed.h"

/// Lights with all receivers behind houses get no map and no pass, and every picture is the same to the bit.
namespace gnomon {
namespace {

using Bytes = std::vector<std::uint8_t>;

class HiddenLightsGl : public FrameTest {
protected:
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }

    std::uint32_t add_complete(const game::Shape& shape, std::optional<std::uint32_t> material = {}) {
        const std::uint32_t mesh = add_mesh(shape, material);
        assets::complete(library.meshes[mesh]);
        return mesh;
    }

    /// Builds a yard with houses, posts and lamps at random. `look_behind`: meshes have no inner boxes.
    void build(std::uint64_t seed, bool look_behind, bool glass_houses = false) {
        start_anew();
        random.seed(seed);
        settings.viewport_px = {160, 96};
        settings.exposure_ev = 4.0f;
        add_material({.name = "matt", .metallic = 0.0f});
        const std::uint32_t glass = add_material(
            {.name = "glass", .base_colour = {0.3f, 0.5f, 0.4f, 0.5f}, .alpha_mode = assets::AlphaMode::blend});
        const std::uint32_t slab = add_complete(game::make_card(glm::dvec3(0.0), {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0}));
        for (int x = -8; x <= 8; ++x)
            for (int z = -10; z <= 4; ++z) place(slab, {.translation_m = {4.0 * x, 0.0, 4.0 * z}});
        game::Shape house = game::make_box({-1.0, -0.1, -0.8}, {1.0, 2.0, 0.8});
        game::append(house, game::make_box({-1.1, 1.9, -0.9}, {1.1, 2.1, 0.9}));
        const std::uint32_t house_mesh = add_complete(house, glass_houses ? glass : 0);
        const std::uint32_t post = add_complete(game::make_box({-0.1, 0.0, -0.1}, {0.1, 1.2, 0.1}));
        const auto turn = [&] { return glm::angleAxis(number(0.0, 6.0), glm::dvec3(0.0, 1.0, 0.0)); };
        for (int i = 0; i < 8; ++i)
            place(house_mesh, {.translation_m = {number(-12.0, 12.0), 0.0, number(-20.0, 0.0)},
                               .rotation = turn(),
                               .scale = glm::dvec3(number(1.5, 4.0), number(1.0, 2.5), number(1.0, 3.0))});
        for (int i = 0; i < 12; ++i) {
            const glm::dvec3 at(number(-14.0, 14.0), 0.0, number(-26.0, 2.0));
            place(post, {.translation_m = at, .rotation = turn()});
            if (i >= 8) continue;
            const bool spot = i % 2 == 0;
            add_light({.kind = spot ? LightKind::spot : LightKind::point,
                       .intensity = 400.0f,
                       .range_m = spot ? 0.0f : static_cast<float>(number(2.0, 5.0)),
                       .inner_cone_rad = 0.3f,
                       .outer_cone_rad = static_cast<float>(number(0.4, 1.0))},
                      at + glm::dvec3(0.5, number(1.5, 3.0), 0.3), {number(-0.3, 0.3), -1.0, number(-0.3, 0.3)},
                      {.resolution_px = 128});
        }
        add_camera({.fov_y_rad = 0.9, .near_m = 0.05}, {number(-3.0, 3.0), number(0.5, 2.5), number(6.0, 12.0)},
                   {number(-0.3, 0.3), -0.1, -1.0});
        if (look_behind)
            for (assets::Mesh& mesh : library.meshes) mesh.inner_ms = {};
    }

    std::size_t unseen() {
        std::size_t lights = 0;
        for (const LightReport& light : frame().report().lights)
            lights += light.reason == Reason::no_visible_receiver ? 1 : 0;
        return lights;
    }

    LightCounts frame_counts(ecs::Entity light) {
        for (const LightReport& report : frame().report().lights)
            if (report.entity == light) return report.counts;
        return {};
    }

    std::mt19937_64 random;
};

TEST_F(HiddenLightsGl, ArePictureForPictureThoseThatAreLookedUp) {
    const std::uint64_t seed = print_seed();
    std::size_t hidden = 0, lights = 0;
    for (std::uint64_t round = 0; round < 24; ++round) {
        build(seed + round, true);
        draw();
        const Bytes looked_up = picture();
        const std::size_t before = unseen();
        build(seed + round, false);
        draw();
        EXPECT_EQ(picture(), looked_up) << "round " << round;
        hidden += unseen() - before;
        lights += frame().report().lights.size();
    }
    EXPECT_GT(hidden, lights / 20) << "of " << lights;
    EXPECT_LT(hidden, lights * 3 / 4);
}

TEST_F(HiddenLightsGl, LeaveATurningSunItsPictureToTheBit) {
    const std::uint64_t seed = print_seed();
    struct Turn {
        std::vector<Bytes> pictures;
        std::uint64_t triangles = 0;
    };
    const auto turned = [&](std::uint64_t round, bool look_behind, ShadowFilter filter) {
        build(seed + round, look_behind);
        const glm::dvec3 down(number(-1.0, 1.0), -number(0.3, 1.0), number(-1.0, 1.0));
        const ecs::Entity sun = add_light({.kind = LightKind::directional, .intensity = 300.0f}, {0.0, 9.0, 0.0}, down,
                                          {.filter = filter, .resolution_px = 256});
        Turn turn;
        for (int frame = 0; frame < 5; ++frame) {
            world.patch<Transform>(sun, [&](Transform& t) {
                t.rotation = looking_along(down + glm::dvec3(0.002 * std::min(frame, 3), 0.0, 0.0));
            });
            draw();
            turn.pictures.push_back(picture());
            if (frame == 3) turn.triangles = frame_counts(sun).triangles;
        }
        return turn;
    };
    std::uint64_t fewer = 0, all = 0;
    for (std::uint64_t round = 0; round < 12; ++round) {
        const ShadowFilter filter = round % 3 == 0   ? ShadowFilter::evsm2
                                    : round % 3 == 1 ? ShadowFilter::pcf_grid
                                                     : ShadowFilter::automatic;
        const Turn open = turned(round, true, filter), hidden = turned(round, false, filter);
        EXPECT_EQ(hidden.pictures, open.pictures) << "round " << round;
        EXPECT_NE(hidden.pictures[2], hidden.pictures[3]) << "the sun turns";
        fewer += hidden.triangles;
        all += open.triangles;
    }
    EXPECT_LT(fewer, all);
    EXPECT_GT(fewer, 0u);
}

TEST_F(HiddenLightsGl, AreNotHiddenByGlass) {
    const std::uint64_t seed = print_seed();
    for (std::uint64_t round = 0; round < 6; ++round) {
        build(seed + round, true, true);
        draw();
        const std::size_t before = unseen();
        build(seed + round, false, true);
        draw();
        EXPECT_EQ(unseen(), before);
    }
}

TEST_F(HiddenLightsGl, ComeBackInTheFrameInWhichTheyAreSeen) {
    start_anew();
    add_material({.name = "matt", .metallic = 0.0f});
    place(add_complete(game::make_card(glm::dvec3(0.0), {60.0, 0.0, 0.0}, {0.0, 0.0, -60.0})));
    const ecs::Entity house = place(add_complete(game::make_box({-4.0, -0.1, -1.0}, {4.0, 4.0, 1.0})), {});
    place(add_complete(game::make_box({-0.3, 0.0, -0.3}, {0.3, 1.0, 0.3})), {.translation_m = {0.0, 0.0, -6.0}});
    add_light({.kind = LightKind::spot, .intensity = 900.0f, .outer_cone_rad = 0.5f}, {0.5, 4.0, -6.0},
              {0.0, -1.0, 0.0}, {.resolution_px = 256});
    add_camera({.fov_y_rad = 0.9}, {0.0, 1.5, 8.0}, {0.0, 0.0, -1.0});
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(unseen(), 1u);
    const auto shown = [&] {
        const std::vector<float> seen = visibility();
        return std::count(seen.begin(), seen.end(), 0.0f);
    };
    world.patch<MeshRef>(house, [](MeshRef& ref) { ref.visible = false; });
    draw();
    EXPECT_EQ(unseen(), 0u) << "an invisible house hides nothing";
    EXPECT_GT(shown(), 20) << "the post's shadow is there at once";
    world.patch<MeshRef>(house, [](MeshRef& ref) { ref.visible = true; });
    draw();
    EXPECT_EQ(unseen(), 1u);
    world.patch<Transform>(house, [](Transform& t) { t.translation_m.x = 8.0; });
    draw();
    EXPECT_EQ(unseen(), 0u);
    EXPECT_GT(shown(), 20);
}

}  // namespace
}  // namespace gnomon
