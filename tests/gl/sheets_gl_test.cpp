#include <iostream>

#include "tests/gl/sheets_fixture.h"
#include "tests/unit/math/random_seed.h"

/// What sheets are certain of is so: random worlds and views, every certain place asked of rays in double.
namespace gnomon {
namespace {

using test::between;
using test::chance;
using test::QueryScene;
using test::Random;

constexpr double kUnitRoundoff = 5.9604644775390625e-8;

/// A light and what its maps hold, all of the world or a part of it.
struct View {
    LightItem light;
    std::vector<shadow::ShadowView> views;
    std::uint32_t size_px = 0;
};

glm::dvec3 sun_direction(Random& random) {
    if (chance(random, 0.15)) return {0.0, 1.0, 0.0};
    const double turn = between(random, 0.0, 6.3);
    const double up = chance(random, 0.4) ? between(random, 0.005, 0.05) : between(random, 0.05, 3.0);
    return glm::normalize(glm::dvec3(std::cos(turn), up, std::sin(turn)));
}

View sun_view(const QueryScene& scene, Random& random) {
    View view;
    view.size_px = 64u << random() % 5;
    view.light = scene.sun(sun_direction(random));
    shadow::OrthographicBox box;
    box.axes = view.light.rotation_ws;
    // Where its texels' corners lie on round numbers, so that the edges of boxes run through them.
    box.anchor_ws_m = scene.offset_m + (chance(random, 0.3) ? glm::dvec3(0.0) : test::point_in(random, 3.0));
    box.half_extent_m = glm::dvec2(chance(random, 0.3) ? 8.0 : between(random, 1.0, 12.0));
    const double depth_m = between(random, 12.0, 60.0);
    box.near_m = -depth_m;
    box.far_m = depth_m;
    view.views = {shadow::orthographic_view(box, view.size_px)};
    return view;
}

glm::dvec3 lamp_place(Random& random) {
    glm::dvec3 at = test::point_in(random, 1.2 * test::kWorld_m);
    at.y = chance(random, 0.2) ? between(random, 0.01, 0.2) : std::abs(at.y);
    return at;
}

shadow::PerspectiveRange lamp_range(Random& random) {
    return shadow::perspective_range(std::pow(10.0, between(random, -5.0, -0.5)), between(random, 20.0, 60.0));
}

View spot_view(const QueryScene& scene, Random& random) {
    View view;
    view.size_px = 64u << random() % 5;
    const glm::dvec3 at = lamp_place(random);
    const glm::dvec3 toward = 0.5 * test::point_in(random, test::kWorld_m) - at;
    view.light = scene.spot(at, -toward, 1.5);
    const double tangent = between(random, 0.2, 1.2);
    const glm::dvec2 middle(between(random, -0.2, 0.2), between(random, -0.2, 0.2));
    view.views = {shadow::perspective_view(view.light.position_ws_m, view.light.rotation_ws,
                                           {middle - tangent, middle + tangent}, lamp_range(random), view.size_px)};
    return view;
}

View point_view(const QueryScene& scene, Random& random) {
    View view;
    view.size_px = 64u << random() % 4;
    view.light = scene.lamp(lamp_place(random));
    view.views = cube_views(view.light, lamp_range(random), view.size_px);
    return view;
}

View view_of(LightKind kind, const QueryScene& scene, Random& random) {
    if (kind == LightKind::directional) return sun_view(scene, random);
    return kind == LightKind::spot ? spot_view(scene, random) : point_view(scene, random);
}

/// Whether any of the maps holds it.
bool is_shown(const std::vector<shadow::ShadowView>& views, const glm::dvec3& at_ws_m) {
    return std::any_of(views.begin(), views.end(), [&](const shadow::ShadowView& view) {
        const glm::dvec4 p = glm::dmat4(view.clip_from_anchor) * glm::dvec4(at_ws_m - view.anchor_ws_m, 1.0);
        return p.w > 0.0 && std::max(std::abs(p.x), std::abs(p.y)) <= p.w && p.z >= 0.0 && p.z <= p.w;
    });
}

/// Of places that maps hold.
struct Tally {
    std::size_t places = 0, lit = 0, dark = 0, wrong = 0;
    double uncertain_percent() const {
        return 100.0 * static_cast<double>(places - lit - dark) / static_cast<double>(places);
    }
};

class Sheets : public SheetsTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// One random world under one random light.
    void play(Random& random, std::size_t count, bool margins, Tally& tally) {
        glm::dvec3 offset_m(0.0);
        if (chance(random, 0.2)) offset_m = {1.0e8, -3.0e7, 5.0e7};
        QueryScene scene = test::sheet_world(random, offset_m);
        judge(scene, random, count, margins, tally);
    }
    void judge(QueryScene& scene, Random& random, std::size_t count, bool margins, Tally& tally) {
        // Casts nothing: its own surface is not in the map.
        const bool receivers_cast = !chance(random, 0.2);
        if (!receivers_cast) scene.snapshot.instances[0].casts = false;
        View view = view_of(GetParam(), scene, random);
        scene.snapshot.lights = {view.light};
        ConsumerItem camera;
        camera.position_ws_m = scene.offset_m + test::point_in(random, 10.0);
        scene.snapshot.consumers = {camera};
        const auto places = test::places_on(scene, view.views, view.size_px, random, count);
        std::vector<glm::vec4> places_ca;
        for (const visibility::Place& place : places) {
            const glm::dvec3 at = place.at_ws_m - camera.position_ws_m;
            // Rounded to float here, and in double where the world is far away.
            const double off_m = kUnitRoundoff * glm::length(at) + 1e-15 * glm::length(place.at_ws_m);
            places_ca.emplace_back(glm::vec3(at), static_cast<float>(off_m));
        }
        const Drawn drawn = draw(scene.snapshot, scene.library, view.views, view.size_px, margins);
        const auto found = verdicts(drawn, GetParam(), places_ca, receivers_cast, margins);
        // What the place itself lies on is as near as double rounds there.
        const double nearest_m = std::max(1e-9, 1e-14 * glm::length(scene.offset_m));
        const auto truth = scene.ask(view.light, places, {.samples = 1, .nearest_m = nearest_m, .threads = 2});
        for (std::size_t i = 0; i < places.size(); ++i) {
            tally.places += is_shown(view.views, places[i].at_ws_m) ? 1 : 0;
            if (found[i] == Verdict::uncertain) continue;
            (found[i] == Verdict::lit ? tally.lit : tally.dark)++;
            if ((found[i] == Verdict::lit) == (truth[i] > 0.5f)) continue;
            if (++tally.wrong <= 5 && margins)
                ADD_FAILURE() << "place " << i << " is certainly " << (found[i] == Verdict::lit ? "lit" : "dark")
                              << ", map of " << view.size_px << ", at " << places_ca[i].x << ' ' << places_ca[i].y
                              << ' ' << places_ca[i].z;
        }
        discard(drawn);
    }
    static int worlds() { return std::getenv("GNOMON_LONG") ? 250 : 6; }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Sheets, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) {
                             return test.param == LightKind::directional ? "sun"
                                    : test.param == LightKind::spot      ? "spot"
                                                                         : "point";
                         });

TEST_P(Sheets, AreRightWhereTheyAreCertain) {
    const std::uint64_t seed = print_seed();
    Tally tally;
    for (int world = 0; world < worlds() && !HasFailure(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        play(random, std::getenv("GNOMON_LONG") ? 200000 : 50000, true, tally);
    }
    std::cout << tally.places << " places, " << tally.lit << " certainly lit, " << tally.dark << " certainly dark, "
              << tally.uncertain_percent() << " % uncertain, " << tally.wrong << " wrong\n";
    EXPECT_EQ(tally.wrong, 0u);
    // It is no use to be certain of nothing.
    EXPECT_GT(tally.lit, tally.places / 50);
    EXPECT_GT(tally.dark, tally.places / 20);
}

TEST_P(Sheets, AreRightBelowNeedles) {
    const std::uint64_t seed = print_seed();
    Tally tally;
    for (int world = 0; world < 4 && !HasFailure(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        QueryScene scene = test::needle_world(random);
        judge(scene, random, 30000, true, tally);
    }
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_GT(tally.lit + tally.dark, tally.places / 20);
}

/// Boxes, balls and a cloth on a ground, seen whole: how much is left for rays.
TEST_P(Sheets, LeaveLittleUncertainInATidyWorld) {
    QueryScene scene;
    scene.place_floor(12.0);
    const std::uint32_t cube = scene.add_cube(), ball = test::add_shape(scene, game::make_sphere(0.5, 48, 24), 0),
                        cloth = test::add_shape(scene, game::make_cloth(2.0, 2.0, 0.1, 3.0, 24, 24), 0);
    for (int i = 0; i < 6; ++i) scene.place(cube, {i - 2.5, 0.5, 1.5 * std::sin(i)}, glm::dmat3(i % 2 ? 1.0 : 0.5));
    for (int i = 0; i < 3; ++i) scene.place(ball, {2.0 * i - 2.0, 0.6, -3.0}, glm::dmat3(1.0));
    scene.place(cloth, {-1.0, 2.5, 3.5});
    for (std::uint32_t i = 0; i < scene.snapshot.instances.size(); ++i) scene.snapshot.instances[i].gpu_slot = i;
    scene.snapshot.gpu_slot_count = static_cast<std::uint32_t>(scene.snapshot.instances.size());
    scene.finish();
    const glm::dvec3 above{2.0, 6.0, 1.0};
    View view;
    view.light = GetParam() == LightKind::directional ? scene.sun(above)
                 : GetParam() == LightKind::spot      ? scene.spot(above, above, 1.2)
                                                      : scene.lamp(above);
    scene.snapshot.lights = {view.light};
    ConsumerItem camera;
    camera.position_ws_m = {5.0, 5.0, 5.0};
    scene.snapshot.consumers = {camera};
    // Evenly over the ground, and on what stands there.
    Random random(7);
    std::vector<visibility::Place> places;
    for (int i = 0; i < 40000; ++i)
        places.push_back({{between(random, -4.0, 4.0), 0.0, between(random, -4.0, 4.0)}, 0.0});
    std::vector<glm::vec4> places_ca;
    for (const visibility::Place& place : places)
        places_ca.emplace_back(glm::vec3(place.at_ws_m - camera.position_ws_m), 1e-6f);
    const auto truth = scene.ask(view.light, places, {.samples = 1, .nearest_m = 1e-9, .threads = 2});
    double before = 100.0;
    for (const std::uint32_t size_px : {512u, 1024u, 2048u}) {
        if (GetParam() == LightKind::directional) {
            shadow::OrthographicBox box;
            box.axes = view.light.rotation_ws;
            box.half_extent_m = glm::dvec2(7.0);
            box.near_m = -9.0;
            box.far_m = 9.0;
            view.views = {shadow::orthographic_view(box, size_px)};
        } else if (GetParam() == LightKind::spot) {
            view.views = {shadow::perspective_view(view.light.position_ws_m, view.light.rotation_ws,
                                                   shadow::TangentRectangle{}, {1.0, 16.0}, size_px)};
        } else {
            view.views = cube_views(view.light, {1.0, 16.0}, size_px);
        }
        const Drawn drawn = draw(scene.snapshot, scene.library, view.views, size_px, true);
        const auto found = verdicts(drawn, GetParam(), places_ca, true, true);
        discard(drawn);
        Tally tally;
        for (std::size_t i = 0; i < places.size(); ++i) {
            ++tally.places;
            if (found[i] == Verdict::uncertain) continue;
            (found[i] == Verdict::lit ? tally.lit : tally.dark)++;
            tally.wrong += (found[i] == Verdict::lit) != (truth[i] > 0.5f) ? 1 : 0;
        }
        std::cout << size_px << ": " << tally.uncertain_percent() << " % uncertain, " << tally.lit << " lit, "
                  << tally.dark << " dark\n";
        EXPECT_EQ(tally.wrong, 0u);
        EXPECT_LT(tally.uncertain_percent(), 0.75 * before);
        before = tally.uncertain_percent();
    }
    EXPECT_LT(before, 3.0);
}

TEST_P(Sheets, WithoutMarginsWouldBeWrong) {
    Tally tally;
    for (int world = 0; world < 40 && tally.wrong == 0; ++world) {
        Random random(static_cast<std::uint64_t>(world) + 1);
        play(random, 50000, false, tally);
    }
    EXPECT_GT(tally.wrong, 0u);
}

}  // namespace
}  // namespace gnomon
