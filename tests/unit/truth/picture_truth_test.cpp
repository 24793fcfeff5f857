#include "systems/truth/picture_truth.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <span>
#include <thread>

#include "tests/long_run.h"
#include "tests/oracle/area_truth.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/soft_truth.h"
#include "tests/source_paths.h"
#include "tests/unit/visibility/loaded_scene.h"

/// The library's truth about a picture against the reference tracer's, which finds its triangles by another tree and
/// another test.
namespace gnomon::truth {
namespace {

constexpr glm::uvec2 kSize_px{320, 180};
constexpr unsigned kThreads = 2;
static_assert(kMinCosine == oracle::kMinCosine && kJitter == oracle::kJitter, "else they count other pixels");
const std::filesystem::path kSponza = "sponza-crytek/Sponza.gltf", kFox = "fox-draco-testdata/Fox/glTF/Fox.gltf";

std::unique_ptr<test::LoadedScene> load(const std::optional<std::filesystem::path>& name, double time_s,
                                        const glm::dvec3& offset_m = glm::dvec3(0.0)) {
    std::optional<std::filesystem::path> file;
    if (name) file = test::data_folder() / *name;
    if (file && !std::filesystem::exists(*file)) return nullptr;
    auto scene = game::load_scene(file);
    EXPECT_TRUE(scene) << to_line(scene.error());
    auto loaded = std::make_unique<test::LoadedScene>(std::move(scene).value(), offset_m);
    loaded->move_to(time_s, kSize_px);
    return loaded;
}

PictureTruth traced(const test::LoadedScene& scene) {
    TraceState state;
    PictureTruth truth = trace_picture(scene.snapshot, scene.library, kThreads, state);
    EXPECT_EQ(state.share(), 1.0);
    return truth;
}

/// Counts of pixels that differ. Where two surfaces lie in one plane, either may be seen. At a pixel centre that lies
/// on an edge, to the last bits, so may what is before it or behind. So places are compared, to what the truth itself
/// resolves. Lights are compared where places are the same, and visibility where the reference is sure.
struct Differing {
    std::size_t surfaces = 0, visibility = 0, scored = 0, ambiguous = 0;
    std::size_t lit = 0, dark = 0;  // by the reference
};

Differing compared(const test::LoadedScene& scene, const PictureTruth& truth) {
    const ConsumerItem& camera = scene.snapshot.consumers.front();
    const oracle::ReferenceTracer reference(scene.snapshot, scene.library, camera.position_ws_m, kThreads);
    const oracle::PrimaryHits hits = reference.trace_primary(camera);
    Differing differing;
    const auto same = [&](std::size_t i) {
        const bool none = hits.triangle[i] == oracle::kNoTriangle, no_surface = truth.seen.instance[i] == kNoSurface;
        if (none || no_surface) return none && no_surface;
        const glm::dvec3 place = truth.seen.position_ws_m[i] - camera.position_ws_m;
        return glm::length(place - hits.position_rel_m[i]) <= kJitter * glm::length(place);
    };
    for (std::size_t i = 0; i < hits.count(); ++i) differing.surfaces += !same(i);
    for (const TracedLight& light : truth.lights) {
        const oracle::LightTruth expected =
            reference.trace_light(hits, as_point(scene.snapshot.lights[light.light]), true);
        for (std::size_t i = 0; i < hits.count(); ++i) {
            if (!same(i)) continue;
            differing.scored += light.truth.scored[i] != expected.scored[i];
            differing.ambiguous += light.truth.ambiguous[i] != expected.ambiguous[i];
            if (expected.ambiguous[i] != 0) continue;
            differing.visibility += light.truth.visibility[i] != expected.visibility[i];
            if (expected.scored[i] != 0) (expected.visibility[i] > 0.5f ? differing.lit : differing.dark)++;
        }
    }
    return differing;
}

void expect_agreement(const Differing& differing) {
    const std::size_t pixels = std::size_t{kSize_px.x} * kSize_px.y;
    EXPECT_EQ(differing.surfaces, 0u);
    EXPECT_EQ(differing.visibility, 0u);
    EXPECT_EQ(differing.scored, 0u);
    EXPECT_EQ(differing.ambiguous, 0u);
    EXPECT_GT(differing.lit, pixels / 50);
    EXPECT_GT(differing.dark, pixels / 50);
    std::printf("differ: surfaces %zu, visibility %zu, scored %zu, ambiguous %zu\n", differing.surfaces,
                differing.visibility, differing.scored, differing.ambiguous);
}

TEST(TruthOfAPicture, OfTheCourtyardIsTheReferencesHereAndFarAway) {
    for (const double offset_m : {0.0, 1e6}) {
        const auto scene = load(std::nullopt, 3.0, {offset_m, 0.0, -offset_m});
        const PictureTruth truth = traced(*scene);
        ASSERT_EQ(truth.lights.size(), 3u);
        expect_agreement(compared(*scene, truth));
    }
}

/// Shares of the source by two tracers with other places on it, on surfaces that both count.
struct SourceShares {
    std::size_t counted = 0, penumbra = 0;
    double off = 0.0, off_in_penumbra = 0.0, hard_off_in_penumbra = 0.0;
};

SourceShares shares_of(const test::LoadedScene& scene, const TracedLight& traced) {
    const ConsumerItem& camera = scene.snapshot.consumers.front();
    const oracle::ReferenceTracer reference(scene.snapshot, scene.library, camera.position_ws_m, kThreads);
    const oracle::SoftTruth expected =
        reference.trace_source(reference.trace_primary(camera), scene.snapshot.lights[traced.light], {});
    SourceShares shares;
    for (std::size_t i = 0; i < expected.visibility.size(); ++i) {
        if (expected.scored[i] == 0 || traced.source->scored[i] == 0) continue;
        const float share = expected.visibility[i];
        const auto off = [&](float other) { return static_cast<double>(std::abs(other - share)); };
        ++shares.counted;
        shares.off += off(traced.source->visibility[i]);
        if (share <= 0.0f || share >= 1.0f) continue;
        ++shares.penumbra;
        shares.off_in_penumbra += off(traced.source->visibility[i]);
        shares.hard_off_in_penumbra += off(traced.truth.visibility[i]);
    }
    return shares;
}

constexpr LightKind kAreaKinds[] = {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube};

/// Seconds each, under sanitizers a minute; all run the same code.
std::size_t traced_kinds() { return kSanitized || !is_long_run() ? 1 : std::size(kAreaKinds); }

TEST(TruthOfAPicture, OfASourceIsTheReferencesForEachKind) {
    const auto scene = load(std::nullopt, 3.0);
    scene->move_to(3.0, kSize_px / 2u);
    const auto expect_same = [&](const char* name) {
        SCOPED_TRACE(name);
        const PictureTruth truth = traced(*scene);
        for (const TracedLight& light : truth.lights) {
            if (!light.source) continue;
            SCOPED_TRACE(scene->snapshot.lights[light.light].name);
            const SourceShares shares = shares_of(*scene, light);
            const auto counted = static_cast<double>(shares.counted), penumbra = static_cast<double>(shares.penumbra);
            EXPECT_GT(shares.counted, 1000u);
            EXPECT_GT(shares.penumbra, 100u);
            EXPECT_LT(shares.off - shares.off_in_penumbra, 0.001 * counted) << "where all is seen, or nothing";
            EXPECT_LT(shares.off_in_penumbra, 0.02 * penumbra) << "two times 256 rays";
            EXPECT_GT(shares.hard_off_in_penumbra, 2.0 * shares.off_in_penumbra) << "the control: the middle alone";
            std::printf("off: %.5f beside penumbrae, %.4f in them, %.3f by the middle\n",
                        (shares.off - shares.off_in_penumbra) / counted, shares.off_in_penumbra / penumbra,
                        shares.hard_off_in_penumbra / penumbra);
        }
    };
    const PictureTruth points = traced(*scene);
    for (const TracedLight& light : points.lights) EXPECT_FALSE(light.source) << "a point has none";
    for (LightItem& light : scene->snapshot.lights) {
        light.source_radius_m = 0.1f;
        light.sun_radius_rad = 0.02f;
    }
    expect_same("disks");
    for (const LightKind kind : std::span(kAreaKinds).first(traced_kinds())) {
        for (LightItem& light : scene->snapshot.lights) {
            light.sun_radius_rad = 0.0f;
            if (light.kind == LightKind::directional) continue;
            light.kind = kind;
            light.width_m = 0.4f;
            light.height_m = 0.2f;
        }
        expect_same(to_text(kind));
    }
}

/// Lit shares of pixels' areas by two tracers, on surfaces that both count and that no other shares the pixel with.
struct AreaShares {
    std::size_t whole = 0, crossed = 0;
    double off = 0.0, off_in_crossed = 0.0, middle_off_in_crossed = 0.0;
};

AreaShares area_shares_of(const test::LoadedScene& scene, const TracedLight& traced, const LightTruth& mine,
                          bool of_source) {
    const ConsumerItem& camera = scene.snapshot.consumers.front();
    const LightItem& light = scene.snapshot.lights[traced.light];
    const oracle::ReferenceTracer reference(scene.snapshot, scene.library, camera.position_ws_m, kThreads);
    const oracle::PrimaryHits hits = reference.trace_primary(camera);
    const oracle::AreaTruth expected = reference.trace_area(
        camera, hits, reference.trace_light(hits, as_point(light), true), light, {.of_source = of_source});
    AreaShares shares;
    for (std::size_t i = 0; i < expected.lit.size(); ++i) {
        if (expected.area[i] != oracle::PixelArea::whole || mine.scored[i] == 0) continue;
        const float share = expected.lit[i];
        const double off = std::abs(mine.visibility[i] - share);
        ++shares.whole;
        shares.off += off;
        if (share <= 0.0f || share >= 1.0f) continue;
        ++shares.crossed;
        shares.off_in_crossed += off;
        shares.middle_off_in_crossed += std::abs(traced.truth.visibility[i] - share);
    }
    return shares;
}

void expect_agreement(const AreaShares& shares, double most_in_crossed) {
    const auto whole = static_cast<double>(shares.whole), crossed = static_cast<double>(shares.crossed);
    EXPECT_GT(shares.whole, 1000u);
    EXPECT_GT(shares.crossed, 100u);
    EXPECT_LT(shares.off - shares.off_in_crossed, 0.0001 * whole) << "where no edge crosses";
    EXPECT_LT(shares.off_in_crossed, most_in_crossed * crossed);
    EXPECT_GT(shares.middle_off_in_crossed, 5.0 * shares.off_in_crossed) << "the control: pixels' middles alone";
    std::printf("off: %.6f where no edge crosses, %.4f where one does, %.3f by the middle\n",
                (shares.off - shares.off_in_crossed) / whole, shares.off_in_crossed / crossed,
                shares.middle_off_in_crossed / crossed);
}

TEST(TruthOfAPicture, OfPixelsAreasIsTheReferencesWhateverTheNumberOfThreads) {
    const auto scene = load(std::nullopt, 3.0);
    scene->move_to(3.0, kSize_px / 4u);
    LightItem& lantern = scene->snapshot.lights[1];
    lantern.shadow.antialias = true;
    const PictureTruth points = traced(*scene);
    EXPECT_FALSE(points.lights[0].area) << "no antialiased edges";
    ASSERT_TRUE(points.lights[1].area);
    EXPECT_FALSE(points.lights[1].source_and_area) << "a point has none";
    expect_agreement(area_shares_of(*scene, points.lights[1], *points.lights[1].area, false), 0.002);
    lantern.source_radius_m = 0.1f;
    TraceState state;
    const PictureTruth sized = traced(*scene), one = trace_picture(scene->snapshot, scene->library, 1, state);
    EXPECT_EQ(sized.lights[1].area->visibility, points.lights[1].area->visibility) << "the middle's";
    ASSERT_TRUE(sized.lights[1].source_and_area);
    // Two tracers with 256 rays a pixel, each off by about 0.02.
    expect_agreement(area_shares_of(*scene, sized.lights[1], *sized.lights[1].source_and_area, true), 0.03);
    EXPECT_EQ(one.lights[1].source_and_area->visibility, sized.lights[1].source_and_area->visibility);
    EXPECT_EQ(one.lights[1].source_and_area->scored, sized.lights[1].source_and_area->scored);
}

TEST(TruthOfAPicture, OfSponzaIsTheReferences) {
    const auto scene = load(kSponza, 0.0);
    if (!scene) GTEST_SKIP() << kSponza << " is not there";
    expect_agreement(compared(*scene, traced(*scene)));
}

TEST(TruthOfAPicture, OfWhatIsBentIsTheReferencesAndOfItsRestIsNot) {
    const auto scene = load(kFox, 0.35);
    if (!scene) GTEST_SKIP() << kFox << " is not there";
    const PictureTruth truth = traced(*scene);
    const Differing now = compared(*scene, truth);
    EXPECT_LE(now.surfaces, 3u);
    EXPECT_EQ(now.visibility, 0u);
    EXPECT_GT(now.lit, 500u);
    EXPECT_GT(now.dark, 50u);
    scene->move_to(0.0, kSize_px);
    EXPECT_GT(compared(*scene, truth).surfaces, 100u);
}

TEST(TruthOfAPicture, WithoutACasterEverythingInReachIsLit) {
    const auto scene = load(std::nullopt, 3.0);
    for (InstanceItem& item : scene->snapshot.instances) item.casts = false;
    for (LightItem& light : scene->snapshot.lights) light.shadow.antialias = true;
    const PictureTruth truth = traced(*scene);
    std::size_t scored = 0;
    for (const TracedLight& light : truth.lights)
        for (std::size_t i = 0; i < truth.seen.count(); ++i)
            ASSERT_TRUE(light.area->scored[i] == 0 || light.area->visibility[i] == 1.0f);
    for (const TracedLight& light : truth.lights)
        for (std::size_t i = 0; i < truth.seen.count(); ++i) {
            if (light.truth.scored[i] == 0) continue;
            ++scored;
            ASSERT_EQ(light.truth.visibility[i], 1.0f);
            ASSERT_EQ(light.truth.ambiguous[i], 0);
        }
    EXPECT_GT(scored, 20000u);
}

TEST(TruthOfAPicture, ASourcesSizeAndTheNumberOfThreadsChangeNothing) {
    const auto scene = load(std::nullopt, 3.0);
    scene->move_to(3.0, kSize_px / 4u);
    const PictureTruth plain = traced(*scene);
    for (LightItem& light : scene->snapshot.lights) {
        light.source_radius_m = 0.3f;
        light.sun_radius_rad = 0.02f;
    }
    TraceState state;
    const PictureTruth sized = trace_picture(scene->snapshot, scene->library, 1, state);
    for (std::size_t i = 0; i < plain.lights.size(); ++i) {
        EXPECT_EQ(plain.lights[i].truth.visibility, sized.lights[i].truth.visibility);
        EXPECT_EQ(plain.lights[i].truth.ambiguous, sized.lights[i].truth.ambiguous);
    }
}

TEST(TruthOfAPicture, WithoutACameraNothingIsSeen) {
    const auto scene = load(std::nullopt, 0.0);
    scene->snapshot.consumers.clear();
    TraceState state;
    EXPECT_TRUE(trace_picture(scene->snapshot, scene->library, 1, state).lights.empty());
}

TEST(TruthInTheBackground, IsThatOfTheSceneAsItWasWhenItBegan) {
    const auto scene = load(std::nullopt, 3.0);
    const PictureTruth expected = traced(*scene);
    BackgroundTrace trace(scene->snapshot, scene->library, kThreads);
    scene->move_to(7.0, kSize_px);
    const PictureTruth& truth = trace.truth();
    EXPECT_TRUE(trace.finished());
    EXPECT_EQ(trace.share(), 1.0);
    ASSERT_EQ(truth.lights.size(), expected.lights.size());
    for (std::size_t i = 0; i < truth.lights.size(); ++i)
        EXPECT_EQ(truth.lights[i].truth.visibility, expected.lights[i].truth.visibility);
    EXPECT_NE(traced(*scene).lights[2].truth.visibility, expected.lights[2].truth.visibility) << "the lamp has turned";
}

TEST(TruthOfAPicture, OnceCancelledDoesNothingMore) {
    const auto scene = load(std::nullopt, 3.0);
    TraceState state;
    state.cancelled = true;
    trace_picture(scene->snapshot, scene->library, kThreads, state);
    EXPECT_EQ(state.done, 0u);
}

/// Measures the CPU time of a trace in this process, seconds: whole, or given up when the first rows are done. Others
/// may have the processor, so the clock on the wall would mislead.
double time_of_trace_s(const test::LoadedScene& scene, bool whole) {
    const std::clock_t start = std::clock();
    {
        BackgroundTrace trace(scene.snapshot, scene.library, 1);
        while (!whole && trace.share() <= 0.0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (whole) trace.truth();
        EXPECT_EQ(trace.finished(), whole);
    }
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(TruthInTheBackground, EndsSoonWhenNobodyWantsItAnyMore) {
    const auto scene = load(std::nullopt, 3.0);
    scene->move_to(3.0, {512, 512});
    EXPECT_LT(2.0 * time_of_trace_s(*scene, false), time_of_trace_s(*scene, true));
}

}  // namespace
}  // namespace gnomon::truth
