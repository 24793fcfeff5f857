#include <iostream>

#include "tests/gl/sheet_views.h"
#include "tests/gl/sheets_fixture.h"
#include "tests/long_run.h"
#include "tests/unit/math/random_seed.h"

/// What sheets are certain of is so: in random worlds and views, rays in double judge every certain place.
namespace gnomon {
namespace {

using test::between;
using test::chance;
using test::is_shown;
using test::QueryScene;
using test::Random;
using test::View;
using test::view_of;


/// All the way to the light: in shaders/shadow/filters/exact/classify.glsl.
constexpr float kNoReach = 3.0e38f;

/// Returns where a place's reach ends. `reach`: metres toward a sun, share of the way to a lamp.
glm::dvec3 end_of_reach(const LightItem& light, const glm::dvec3& at_ws_m, double reach) {
    const bool sun = light.kind == LightKind::directional;
    return at_ws_m + reach * (sun ? light.rotation_ws[2] : light.position_ws_m - at_ws_m);
}

/// Counts of places. `places`: only what the maps show.
struct Tally {
    std::size_t places = 0, lit = 0, dark = 0, wrong = 0;
    std::size_t bounded = 0, beyond = 0;  // places with a known reach; reaches that end short of a caster
    /// Returns whether the sheets are certain of enough: certainty about nothing proves nothing.
    bool is_of_use() const { return bounded > places / 5 && lit > places / 50 && dark > places / 20; }
    double uncertain_percent() const {
        return 100.0 * static_cast<double>(places - lit - dark) / static_cast<double>(places);
    }
};

class Sheets : public SheetsTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Plays one random world under one random light.
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
            const std::size_t shown = is_shown(view.views, places[i].at_ws_m) ? 1 : 0;
            tally.places += shown;
            if (found[i] == Verdict::uncertain) continue;
            (found[i] == Verdict::lit ? tally.lit : tally.dark) += shown;
            if ((found[i] == Verdict::lit) == (truth[i] > 0.5f)) continue;
            if (++tally.wrong <= 5 && margins)
                ADD_FAILURE() << "place " << i << " is certainly " << (found[i] == Verdict::lit ? "lit" : "dark")
                              << ", map of " << view.size_px << ", at " << places_ca[i].x << ' ' << places_ca[i].y
                              << ' ' << places_ca[i].z;
        }
        const auto reach = reaches(drawn, GetParam(), places_ca, margins);
        std::vector<visibility::Place> ends;
        for (std::size_t i = 0; i < places.size(); ++i)
            if (reach[i] < kNoReach)
                ends.push_back({end_of_reach(view.light, places[i].at_ws_m, static_cast<double>(reach[i]))});
        const auto behind = scene.ask(view.light, ends, {.samples = 1, .nearest_m = nearest_m, .threads = 2});
        tally.bounded += ends.size();
        tally.beyond += static_cast<std::size_t>(std::count(behind.begin(), behind.end(), 0.0f));
        discard(drawn);
    }
    static int worlds() { return is_long_run() ? 40 : 6; }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Sheets, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(Sheets, AreRightWhereTheyAreCertain) {
    const std::uint64_t seed = print_seed();
    Tally tally;
    const auto goes_on = [&](int world) {
        return world < worlds() || (!tally.is_of_use() && world < kMostPerPlanned * worlds());
    };
    for (int world = 0; goes_on(world) && !HasFailure(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        play(random, is_long_run() ? 200000 : 50000, true, tally);
    }
    std::cout << tally.places << " places, " << tally.lit << " certainly lit, " << tally.dark << " certainly dark, "
              << tally.uncertain_percent() << " % uncertain, " << tally.wrong << " wrong\n";
    std::cout << tally.bounded << " bounded, " << tally.beyond << " of them too short\n";
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_EQ(tally.beyond, 0u);
    EXPECT_TRUE(tally.is_of_use());
}

/// Checks that points give no bound lower than quads do, and few higher. A quad along a sliver is narrower than a
/// point. It may miss a texel where rounding leaves it open whether the sliver meets it.
TEST_P(Sheets, SayNoLessWherePointsCoverThemThanWhereQuadsDo) {
    const std::uint64_t seed = print_seed();
    std::size_t drawn_as_points = 0, drawn_as_quads = 0, texels = 0, less = 0, more = 0;
    for (int world = 0; world < worlds(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        QueryScene scene = test::sheet_world(random, glm::dvec3(chance(random, 0.2) ? 1.0e8 : 0.0));
        const View view = view_of(GetParam(), scene, random);
        scene.snapshot.lights = {view.light};
        scene.snapshot.consumers = {ConsumerItem{}};
        std::vector<glm::vec2> bounds[2];
        for (const bool points : {false, true}) {
            const Drawn drawn =
                draw(scene.snapshot, scene.library, view.views, view.size_px, true, Ask::middle, points);
            for (std::uint32_t layer = 0; layer < view.views.size(); ++layer) {
                const auto one = read<glm::vec2>(drawn.maps.bounds, std::size_t{view.size_px} * view.size_px, layer);
                bounds[points ? 1 : 0].insert(bounds[points ? 1 : 0].end(), one.begin(), one.end());
            }
            (points ? drawn_as_points : drawn_as_quads) += drawn.points;
            discard(drawn);
        }
        ASSERT_EQ(bounds[0].size(), bounds[1].size());
        for (std::size_t i = 0; i < bounds[0].size(); ++i) {
            const glm::vec2 &quads = bounds[0][i], &points = bounds[1][i];
            less += points.x < quads.x || points.y < quads.y ? 1 : 0;
            more += points.x > quads.x || points.y > quads.y ? 1 : 0;
        }
        texels += bounds[0].size();
    }
    EXPECT_GT(drawn_as_points, 0u);
    EXPECT_EQ(drawn_as_quads, 0u);
    EXPECT_EQ(less, 0u);
    EXPECT_LE(more, texels / 1000);
}

TEST_P(Sheets, AreRightBelowNeedles) {
    const std::uint64_t seed = print_seed();
    Tally tally;
    const auto is_of_use = [&] { return tally.lit + tally.dark > tally.places / 20; };
    for (int world = 0; (world < 4 || (!is_of_use() && world < 4 * kMostPerPlanned)) && !HasFailure(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        QueryScene scene = test::needle_world(random);
        judge(scene, random, 30000, true, tally);
    }
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_EQ(tally.beyond, 0u);
    EXPECT_TRUE(is_of_use()) << tally.lit + tally.dark << " of " << tally.places;
}

/// Measures how much is left for rays of boxes, balls and a cloth on a ground, seen whole.
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
            view.views = test::cube_views(view.light, {1.0, 16.0}, size_px);
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

TEST_P(Sheets, WithoutMarginsWouldReachTooShort) {
    Tally tally;
    for (int world = 0; world < 40 && tally.beyond == 0; ++world) {
        Random random(static_cast<std::uint64_t>(world) + 1);
        play(random, 50000, false, tally);
    }
    EXPECT_GT(tally.beyond, 0u);
}

}  // namespace
}  // namespace gnomon
