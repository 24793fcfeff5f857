#include "systems/truth/tint_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "engine/rays/transmittance.h"
#include "systems/truth/picture_truth.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/tint_truth.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/visibility/loaded_scene.h"
#include "tests/unit/visibility/query_scene.h"

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

/// A square pane of two triangles, level at a height of 1 m, and places below it on a grid. One place of each row
/// lies exactly below the common edge.
struct Pane : test::QueryScene {
    static constexpr int kSide = 8;
    LightItem sun;
    SeenSurfaces seen;

    explicit Pane(const glm::vec3& through) {
        library.materials[0].transmission = through;
        library.materials[0].metallic = 0.0f;
        place(add_square(), {0.0, 1.0, 0.0}, glm::dmat3({4, 0, 0}, {0, 0, -4}, {0, 4, 0})).receives = true;
        finish();
        sun.kind = LightKind::directional;
        sun.rotation_ws = glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
        seen.reset({kSide, kSide}, {0.0, 5.0, 0.0});
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto pixel = static_cast<std::size_t>(y * kSide + x);
                seen.instance[pixel] = 0;
                seen.position_ws_m[pixel] = {0.25 * x - 1.0, 0.0, 1.0 - 0.25 * y};
                seen.normal_ws[pixel] = {0.0, 1.0, 0.0};
            }
    }
    TintTruth traced() const {
        visibility::CasterTrees trees(library, visibility::TreesOf::translucent);
        trees.update(snapshot);
        TintTruth truth;
        truth.reset(seen.count());
        trace_tint_rows(snapshot, sun, seen, {0, kSide}, trees, truth);
        return truth;
    }
};

TEST(TruthOfColours, HaveACommonEdgeOfTwoTrianglesOnce) {
    Pane pane({0.5f, 0.25f, 1.0f});
    for (const bool turned : {false, true}) {  // the edge has one owner whichever way each triangle turns
        if (turned) std::swap(pane.library.meshes[0].indices[1], pane.library.meshes[0].indices[2]);
        const TintTruth truth = pane.traced();
        for (std::size_t i = 0; i < truth.passed.size(); ++i) {
            EXPECT_EQ(truth.scored[i], 1) << i;
            EXPECT_EQ(truth.passed[i], glm::vec3(0.5f, 0.25f, 1.0f)) << i;
        }
    }
}

TEST(TruthOfColours, OfAnyMaterialAreThoseOfTheReference) {
    std::mt19937_64 random(print_seed());
    const auto number = [&](float high) { return std::uniform_real_distribution<float>(0.0f, high)(random); };
    const auto below = [&](std::uint32_t end) {
        return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random);
    };
    const auto colour = [&] { return glm::vec4(number(1.0f), number(1.0f), number(1.0f), number(1.0f)); };
    std::size_t partly = 0;
    for (int round = 0; round < 2000; ++round) {
        test::QueryScene world;
        assets::Mesh& mesh = world.library.meshes[world.add_square()];
        for (assets::Vertex& vertex : mesh.vertices) vertex.uv = {number(6.0f) - 3.0f, number(6.0f) - 3.0f};
        if (below(2) == 0)
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i) mesh.colours.push_back(colour());
        assets::Texture texture;
        texture.width = 1 + below(4);
        texture.height = 1 + below(4);
        for (std::uint32_t i = 0; i < 4 * texture.width * texture.height; ++i)
            texture.rgba.push_back(static_cast<std::uint8_t>(below(256)));
        texture.wrap_u = static_cast<assets::TextureWrap>(below(3));
        texture.wrap_v = static_cast<assets::TextureWrap>(below(3));
        texture.linear_filter = below(2) == 0;
        world.library.textures.push_back(texture);
        assets::Material& material = world.library.materials[0];
        material.base_colour = colour();
        material.base_colour_texture = below(3) == 0 ? assets::kNone : 0;
        material.alpha_mode = static_cast<assets::AlphaMode>(below(3));
        material.alpha_cutoff = number(0.5f);
        material.metallic = below(2) == 0 ? 0.0f : number(1.0f);
        material.transmission = {number(1.0f), number(1.0f), number(1.0f)};
        const double first = number(1.0f), second = (1.0 - first) * static_cast<double>(number(1.0f));
        const glm::dvec3 weights(first, second, 1.0 - first - second);
        glm::dvec2 uv(0.0);
        glm::dvec4 between(mesh.colours.empty() ? 1.0 : 0.0);
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t corner = mesh.indices[3 + static_cast<std::uint32_t>(i)];
            uv += weights[i] * glm::dvec2(mesh.vertices[corner].uv);
            if (!mesh.colours.empty()) between += weights[i] * glm::dvec4(mesh.colours[corner]);
        }
        const glm::dvec3 passed = rays::transmittance(world.library, mesh, 1, 0, weights),
                         expected = oracle::surface_transmittance(world.library, material, uv, between);
        const glm::dvec3 off = glm::abs(passed - expected);
        ASSERT_LT(std::max({off.x, off.y, off.z}), 1e-12) << "round " << round;
        partly += passed.x > 0.01 && passed.x < 0.99;
    }
    EXPECT_GT(partly, 500u);
}

TEST(TruthOfColours, TakeNumbersOutOfRangeAsTheDeviceDoes) {
    test::QueryScene world;
    const assets::Mesh& mesh = world.library.meshes[world.add_square()];
    assets::Material& material = world.library.materials[0];
    const auto passed = [&] { return rays::transmittance(world.library, mesh, 0, 0, {0.25, 0.25, 0.5}); };
    material.metallic = 0.0f;
    material.base_colour = {0.5f, 0.5f, 0.5f, 1.0f};
    material.transmission = {std::numeric_limits<float>::quiet_NaN(), 4.0f, -1.0f};
    EXPECT_EQ(passed(), glm::dvec3(0.0, 0.5, 0.0));
    material.metallic = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(passed(), glm::dvec3(0.0, 0.5, 0.0));
}

}  // namespace
}  // namespace gnomon::truth
