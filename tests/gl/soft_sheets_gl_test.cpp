#include <cmath>
#include <iostream>

#include "tests/gl/sheet_views.h"
#include "tests/gl/sheets_fixture.h"
#include "tests/long_run.h"
#include "tests/unit/math/random_seed.h"

/// What sheets are certain of for a source with a size is so. In random worlds, views and sources, rays in double to
/// all of the source judge every certain place.
namespace gnomon {
namespace {

using test::between;
using test::chance;
using test::QueryScene;
using test::Random;
using test::View;

constexpr std::uint32_t kRays = 64;

struct SoftTally {
    std::size_t places = 0, lit = 0, dark = 0, wrong = 0, partly = 0;
    /// Returns whether the sheets are certain of enough: certainty about nothing proves nothing.
    bool is_of_use() const { return lit > places / 500 && dark > places / 500; }
};

class SoftSheets : public SheetsTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Plays one random world under one random light. A place's verdict is right only if no ray contradicts it.
    void play(Random& random, std::size_t count, bool margins, Ask ask, SoftTally& tally) {
        glm::dvec3 offset_m(0.0);
        if (chance(random, 0.2)) offset_m = {1.0e8, -3.0e7, 5.0e7};
        QueryScene scene = test::sheet_world(random, offset_m);
        const bool receivers_cast = !chance(random, 0.2);
        if (!receivers_cast) scene.snapshot.instances[0].casts = false;
        constexpr double kAllCasters_m = 25.0;   // before the near plane they would be as near as that
        View view = test::view_of(GetParam(), scene, random, kAllCasters_m);
        view.light.shadow.filter = ShadowFilter::exact_soft;
        view.light.sun_radius_rad = static_cast<float>(std::pow(10.0, between(random, -3.5, -0.8)));
        view.light.source_radius_m = static_cast<float>(std::pow(10.0, between(random, -4.0, -0.7)));
        if (chance(random, 0.5)) surround(scene, view.light, random);
        scene.snapshot.lights = {view.light};
        ConsumerItem camera;
        camera.position_ws_m = scene.offset_m + test::point_in(random, 10.0);
        scene.snapshot.consumers = {camera};
        const auto places = test::places_on(scene, view.views, view.size_px, random, count);
        std::vector<glm::vec4> places_ca;
        for (const visibility::Place& place : places) {
            const glm::dvec3 at = place.at_ws_m - camera.position_ws_m;
            const double off_m = kUnitRoundoff * glm::length(at) + 1e-15 * glm::length(place.at_ws_m);
            places_ca.emplace_back(glm::vec3(at), static_cast<float>(off_m));
        }
        const Drawn drawn = draw(scene.snapshot, scene.library, view.views, view.size_px, margins, ask);
        const auto found = verdicts(drawn, GetParam(), places_ca, receivers_cast, margins, ask);
        discard(drawn);
        judge(scene, view, places, found, margins && ask == Ask::source, tally);
    }

    static int worlds() { return is_long_run() ? 40 : 8; }
    static std::size_t places() { return is_long_run() ? 40000 : 12000; }

private:
    /// Adds small things around a lamp, like a cage or a housing, some of them in one face of its cube alone.
    static void surround(QueryScene& scene, const LightItem& light, Random& random) {
        if (light.kind == LightKind::directional) return;
        const double radius_m = static_cast<double>(light.source_radius_m);
        const std::uint32_t cube = scene.add_cube();
        const auto count = static_cast<int>(between(random, 1.0, 12.0));
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 aside = between(random, 1.5, 25.0) * radius_m * test::direction(random);
            scene.place(cube, light.position_ws_m - scene.offset_m + aside,
                        test::random_basis(random, between(random, 0.1, 2.0) * radius_m));
        }
        for (std::uint32_t i = 0; i < scene.snapshot.instances.size(); ++i) scene.snapshot.instances[i].gpu_slot = i;
        scene.snapshot.gpu_slot_count = static_cast<std::uint32_t>(scene.snapshot.instances.size());
        scene.finish();
    }

    static void judge(const QueryScene& scene, const View& view, const std::vector<visibility::Place>& places,
                      const std::vector<Verdict>& found, bool complain, SoftTally& tally) {
        std::vector<visibility::Place> certain;
        std::vector<bool> lit;
        for (std::size_t i = 0; i < places.size(); ++i) {
            tally.places += test::is_shown(view.views, places[i].at_ws_m) ? 1 : 0;
            if (found[i] == Verdict::uncertain) continue;
            certain.push_back(places[i]);
            lit.push_back(found[i] == Verdict::lit);
            (lit.back() ? tally.lit : tally.dark)++;
        }
        const double nearest_m = std::max(1e-9, 1e-14 * glm::length(scene.offset_m));
        const auto truth = scene.ask(view.light, certain, {.samples = kRays, .nearest_m = nearest_m, .threads = 2});
        for (std::size_t i = 0; i < certain.size(); ++i) {
            if (truth[i] == (lit[i] ? 1.0f : 0.0f)) continue;
            tally.partly += truth[i] > 0.0f && truth[i] < 1.0f ? 1 : 0;
            if (++tally.wrong > 5 || !complain) continue;
            const glm::dvec3 at = certain[i].at_ws_m - scene.offset_m;
            ADD_FAILURE() << "certainly " << (lit[i] ? "lit" : "dark") << " but " << truth[i] << " is seen, map of "
                          << view.size_px << ", at " << at.x << ' ' << at.y << ' ' << at.z;
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, SoftSheets,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(SoftSheets, AreRightWhereTheyAreCertain) {
    const std::uint64_t seed = print_seed();
    SoftTally tally;
    const auto goes_on = [&](int world) {
        return world < worlds() || (!tally.is_of_use() && world < kMostPerPlanned * worlds());
    };
    for (int world = 0; goes_on(world) && !HasFailure(); ++world) {
        SCOPED_TRACE("world " + std::to_string(world) + " of seed " + std::to_string(seed));
        Random random(seed + static_cast<std::uint64_t>(world));
        play(random, places(), true, Ask::source, tally);
    }
    std::cout << tally.places << " places, " << tally.lit << " certainly lit, " << tally.dark << " certainly dark, "
              << tally.wrong << " wrong\n";
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_TRUE(tally.is_of_use());
}

TEST_P(SoftSheets, WithoutLookingBesideTheMiddleWouldBeWrong) {
    SoftTally tally;
    for (int world = 0; world < 10 && tally.partly < 20; ++world) {
        Random random(static_cast<std::uint64_t>(world) + 1);
        play(random, places(), true, Ask::source_without_reach, tally);
    }
    EXPECT_GE(tally.partly, 20u);
}

TEST_P(SoftSheets, WithoutMarginsWouldBeWrong) {
    SoftTally tally;
    for (int world = 0; world < 40 && tally.wrong == 0; ++world) {
        Random random(static_cast<std::uint64_t>(world) + 1);
        play(random, 20000, false, Ask::source, tally);
    }
    EXPECT_GT(tally.wrong, 0u);
}

}  // namespace
}  // namespace gnomon
