#include "systems/truth/tint_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "systems/truth/picture_truth.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/tint_truth.h"
#include "tests/unit/visibility/loaded_scene.h"

/// The library's colours behind glass against the reference tracer's, which tries every triangle.
namespace gnomon::truth {
namespace {

/// Colours by two tracers, at places that both see.
struct Colours {
    std::size_t tinted = 0, off = 0;
};

Colours colours_of(const test::LoadedScene& scene, const PictureTruth& truth, const TracedLight& traced) {
    const ConsumerItem& camera = scene.snapshot.consumers.front();
    const glm::dvec3& origin_ws_m = camera.position_ws_m;
    const oracle::ReferenceTracer reference(scene.snapshot, scene.library, origin_ws_m, 2);
    const oracle::PrimaryHits hits = reference.trace_primary(camera);
    const std::vector<glm::dvec3> expected =
        oracle::trace_tint(scene.snapshot, scene.library, origin_ws_m, hits, scene.snapshot.lights[traced.light]);
    Colours colours;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        if (traced.tint->scored[i] == 0 || hits.triangle[i] == oracle::kNoTriangle) continue;
        const glm::dvec3 place = truth.seen.position_ws_m[i] - origin_ws_m;
        if (glm::length(place - hits.position_rel_m[i]) > kJitter * glm::length(place)) continue;
        const glm::dvec3 off = glm::abs(glm::dvec3(traced.tint->passed[i]) - expected[i]);
        colours.tinted += expected[i] != glm::dvec3(1.0);
        colours.off += std::max({off.x, off.y, off.z}) > 1e-6;
    }
    return colours;
}

TEST(TruthOfColours, AreTheReferencesBehindGlassAndWithoutGlassThereAreNone) {
    auto data = game::load_scene(game::kPanesScene);
    ASSERT_TRUE(data);
    test::LoadedScene scene(std::move(data).value());
    scene.move_to(3.0, {320, 180});
    TraceState state;
    const PictureTruth truth = trace_picture(scene.snapshot, scene.library, 2, state);
    ASSERT_EQ(truth.lights.size(), 2u);
    for (const TracedLight& light : truth.lights) {
        SCOPED_TRACE(scene.snapshot.lights[light.light].name);
        ASSERT_TRUE(light.tint);
        const Colours colours = colours_of(scene, truth, light);
        EXPECT_GT(colours.tinted, 1000u);
        EXPECT_EQ(colours.off, 0u);
        std::printf("%zu pixels behind glass, %zu off\n", colours.tinted, colours.off);
    }
    scene.snapshot.lights[1].shadow.translucent_casters = false;
    scene.snapshot.lights[0].shadow.layers = 1u;
    for (InstanceItem& item : scene.snapshot.instances) item.cast_layers = 2u;
    const PictureTruth other_layers = trace_picture(scene.snapshot, scene.library, 1, state);
    EXPECT_FALSE(other_layers.lights[1].tint) << "it leaves them out";
    for (const glm::vec3& passed : other_layers.lights[0].tint->passed) ASSERT_EQ(passed, glm::vec3(1.0f));
}

TEST(TruthOfColours, AreComparedWhereLightArrivesByTheChannelThatIsOffMost) {
    constexpr std::size_t kPixels = 5;
    LightTruth light;
    light.reset(kPixels);
    light.visibility = {1.0f, 1.0f, 1.0f, 0.0f, 1.0f};
    light.ambiguous[2] = 1;
    TintTruth truth;
    truth.reset(kPixels);
    truth.scored = {1, 1, 1, 1, 0};
    truth.passed[1] = {0.5f, 1.0f, 0.25f};
    std::vector<glm::vec4> measured(kPixels, glm::vec4(1.0f));
    measured[1] = {0.5f, 0.25f, 0.5f, 1.0f};
    std::vector<float> off;
    const TintMetrics m = compare_tint(measured, truth, light, off);
    EXPECT_EQ(m.scored, 2u) << "neither what is unsure, nor dark, nor not scored";
    EXPECT_EQ(m.tinted, 1u);
    EXPECT_EQ(m.beyond, 1u);
    EXPECT_DOUBLE_EQ(m.max_error, 0.75);
    EXPECT_DOUBLE_EQ(m.tinted_error, 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(m.mean_error, 1.0 / 6.0);
    EXPECT_EQ(off, (std::vector<float>{0.0f, -0.75f, 0.0f, 0.0f, 0.0f}));
}

}  // namespace
}  // namespace gnomon::truth
