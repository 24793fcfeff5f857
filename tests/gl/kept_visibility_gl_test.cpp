#include <algorithm>
#include <array>

#include "systems/shadow/request/filter_table.h"
#include "tests/gl/held_frame_fixture.h"
#include "tests/long_run.h"

/// A still picture that reads kept visibility is, to the bit, the picture with lookups. That holds for each row of the
/// filter table and each kind of light, with blended surfaces before the others.
namespace gnomon {
namespace {

using Bytes = std::vector<std::uint8_t>;
/// Returns whether a run tests a filter; a long run tests all. A short run has one for each way to store a map and to
/// read it, one with seeds from the pixel, and rays.
bool is_of_run(ShadowFilter filter) {
    constexpr std::array kShort = {ShadowFilter::hard, ShadowFilter::poisson_rotated, ShadowFilter::triangles,
                                   ShadowFilter::evsm2, ShadowFilter::pcss, ShadowFilter::exact};
    return is_long_run() || std::find(kShort.begin(), kShort.end(), filter) != kShort.end();
}

constexpr int kStaticFrames = 4;  // after the first: looked up, filled, read, read

class KeptVisibilityGl : public FrameTest {
protected:
    void make_world(ShadowFilter filter) {
        start_anew();
        settings.viewport_px = {160, 128};
        add_material({.name = "matt", .metallic = 0.0f});
        const std::uint32_t glass =
            add_material({.name = "glass", .base_colour = {0.2f, 0.5f, 0.9f, 0.4f}, .alpha_mode = assets::AlphaMode::blend});
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0})), {}, false);
        const std::uint32_t box = add_mesh(game::make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
        place(box, {.translation_m = {0.0, 1.0, 0.0}});
        place(add_mesh(game::make_box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}), glass), {.translation_m = {1.2, 0.8, 1.0}}, false);
        bystander = place(box, {.translation_m = {-1.5, 0.6, 0.5}}, false);
        const LightShadow shadow{.filter = filter, .resolution_px = 128};
        const ShadowTuning tuning{.kernel = {.seed = FilterSeed::screen}};
        add_light({.kind = LightKind::directional, .intensity = 500.0f}, {2.0, 6.0, 1.0}, {-2.0, -6.0, -1.0}, shadow,
                  tuning);
        add_light({.kind = LightKind::spot, .intensity = 3000.0f, .range_m = 9.0f, .outer_cone_rad = 0.5f},
                  {3.0, 5.0, 2.0}, {-3.0, -4.5, -2.0}, shadow, tuning);
        add_light({.kind = LightKind::point, .intensity = 900.0f, .range_m = 3.0f}, {0.2, 2.2, 0.4}, {0.0, -1.0, 0.0},
                  shadow, tuning);
        add_camera({.fov_y_rad = 0.8}, {0.5, 4.0, 6.0}, {-0.5, -4.0, -6.0});
    }
    void keep(bool on) {
        world.each<LightShadow>([&](ecs::Entity e, const LightShadow&) {
            edit_light(world, e, [&](ShadowTuning& t) { t.reuse.keep_visibility = on; });
        });
    }
    std::size_t reading() {
        std::size_t lights = 0;
        for (const LightReport& light : frame().report().lights)
            lights += light.kept.reason == Reason::visibility_kept ? 1 : 0;
        return lights;
    }
    struct Seen {
        Bytes picture;
        std::vector<std::vector<float>> visibilities;
        bool operator==(const Seen&) const = default;
    };
    Seen seen() {
        Seen all{picture(), {}};
        for (std::uint32_t i = 0; i < 3; ++i) all.visibilities.push_back(visibility(i));
        return all;
    }
    ecs::Entity bystander;
};

TEST_F(KeptVisibilityGl, ShowsTheSameBitsInEveryRow) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        if (!is_of_run(row.id)) continue;
        make_world(row.id);
        keep(false);
        draw();
        draw();
        const Seen looked_up = seen();
        EXPECT_EQ(reading(), 0u);
        keep(true);
        for (int i = 0; i <= kStaticFrames; ++i) {
            draw();
            EXPECT_TRUE(seen() == looked_up) << row.name << ", frame " << i;
        }
        EXPECT_EQ(reading(), 3u) << row.name;
        // Dark and lit are both there, so that the comparison means something.
        for (const std::vector<float>& values : looked_up.visibilities) {
            const auto is_dark = [](float v) { return v >= 0.0f && v < 0.5f; };
            EXPECT_GT(std::count_if(values.begin(), values.end(), is_dark), 20) << row.name;
            EXPECT_GT(std::count(values.begin(), values.end(), 1.0f), 100) << row.name;
        }
    }
}

/// Moves a surface that casts nothing, and so is in no map.
TEST_F(KeptVisibilityGl, FollowsASurfaceThatNoMapShows) {
    make_world(ShadowFilter::triangles);
    for (int i = 0; i <= kStaticFrames; ++i) draw();
    ASSERT_EQ(reading(), 3u);
    const Seen before = seen();
    world.patch<Transform>(bystander, [](Transform& t) { t.translation_m.y += 0.4; });
    draw();
    const Seen moved = seen();
    EXPECT_FALSE(moved == before);
    keep(false);
    draw();
    EXPECT_TRUE(seen() == moved);
}

/// The same with versions as if nothing had changed: the pixels of where the surface was are read for where it is.
class MisledKeptVisibilityGl : public HeldFrameTest {
protected:
    void step() {
        run();
        lighting->submitted(0, true);
    }
    std::vector<float> visibility() {
        gl::CommandList list;
        EXPECT_TRUE(lighting->record_visibility(inputs(), 0, *scene, list));
        GlTest::run(list);
        return read<float>(lighting->visibility_texture(), std::size_t{settings.viewport_px.x} * settings.viewport_px.y);
    }
};

TEST_F(MisledKeptVisibilityGl, ASurfaceThatASignatureMissesWouldBeSeen) {
    settings.viewport_px = {160, 128};
    place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0})), {}, false);
    const std::uint32_t box = add_mesh(game::make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
    const ecs::Entity bystander = place(box, {.translation_m = {-1.5, 0.6, 0.5}}, false);
    place(box, {.translation_m = {0.0, 1.0, 0.0}});
    // From behind: the faces that the camera sees get no light, the ground does.
    add_light({.kind = LightKind::directional, .intensity = 500.0f}, {2.0, 6.0, -3.0}, {-2.0, -6.0, 3.0});
    add_camera({.fov_y_rad = 0.8}, {0.5, 4.0, 6.0}, {-0.5, -4.0, -6.0});
    for (int i = 0; i <= kStaticFrames; ++i) step();
    ASSERT_EQ(report.lights.at(0).kept.reason, Reason::visibility_kept);
    // The box moves away from the camera: another order of the surfaces would change the signature.
    world.patch<Transform>(bystander, [](Transform& t) { t.translation_m.x -= 0.4; });
    const auto versions = [&] {
        std::vector<std::uint64_t> all;
        for (const InstanceItem& item : snapshot.instances) all.push_back(item.version);
        return all;
    };
    const std::vector<std::uint64_t> then = versions();
    // The device gets the new places; lighting alone gets the versions of before.
    gl::CommandList list;
    extractor.update(world, library, transforms.update(world), settings.viewport_px, snapshot);
    scene->update(snapshot, list);
    shadows->update(snapshot, *scene, {}, list, report);
    const SceneSnapshot told = snapshot;
    for (std::size_t i = 0; i < then.size(); ++i) snapshot.instances[i].version = then[i];
    outcome.clear();
    record_picture(inputs(), list);
    shadows->report(snapshot, outcome, report);
    GlTest::run(list);
    lighting->submitted(1, true);
    EXPECT_EQ(report.lights.at(0).kept.reason, Reason::visibility_kept) << "it was misled";
    const std::vector<float> misled = visibility();
    snapshot = told;
    list.clear();
    record_picture(inputs(), list);
    GlTest::run(list);
    EXPECT_NE(visibility(), misled);
    shadows->commit(snapshot, true);
}

}  // namespace
}  // namespace gnomon
