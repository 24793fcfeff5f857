#include <algorithm>
#include <stdexcept>

#include "bench/accuracy/edge_error_bounds.h"
#include "tests/gl/hard_case_fixture.h"
#include "tests/oracle/edge_exceptions.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"

// The hard cases that show in a picture, drawn and compared with ray-traced truth.
namespace gnomon::hard {
namespace {

// Shares of the scored pixels. A picture of 320 x 180 has many edges for its area: one pixel in fifty may be wrong.
// Away from edges one in a thousand may be.
constexpr double kMostWrong = 0.02, kMostAcneAndLeak = 0.001;
// Maps that stay are coarser. A few more edges thus lie beyond the band of 2 px that separates them from acne and leak.
constexpr double kMostWhereMapsStay = 0.002;
constexpr std::size_t kLeastScored = 500;

/// A row under a fit of its suns; rows without a sun under one, since it changes nothing.
struct FittedCase {
    HardCase row;
    const char* fit;
};
void PrintTo(const FittedCase& c, std::ostream* out) { *out << c.row.name << " under " << c.fit; }

bool has_sun(const HardCase& row) {
    World world;
    row.build(world);
    const auto lights = world.registry.entities_with<Light>();
    return std::any_of(lights.begin(), lights.end(),
                       [&](ecs::Entity e) { return world.registry.get<Light>(e)->kind == LightKind::directional; });
}

std::vector<FittedCase> shown_cases() {
    std::vector<FittedCase> cases;
    for (const HardCase& row : hard_cases()) {
        if (row.on_gpu == OnGpu::no) continue;
        cases.push_back({row, "tight"});
        if (!has_sun(row)) continue;
        cases.push_back({row, "stable"});
        cases.push_back({row, "quantised"});
    }
    return cases;
}

/// Marks pixels within kEdgeBandPx of a place where the truth changes.
void mark_edges(const glm::uvec2& size_px, const oracle::LightTruth& truth, std::vector<std::uint8_t>& marks) {
    const auto width = static_cast<int>(size_px.x), height = static_cast<int>(size_px.y);
    const auto reach = static_cast<int>(oracle::kEdgeBandPx);
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    const auto differ = [&](std::size_t a, std::size_t b) {
        return truth.visibility[a] != truth.visibility[b] || truth.ambiguous[a] != 0;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!(x + 1 < width && differ(at(x, y), at(x + 1, y))) &&
                !(y + 1 < height && differ(at(x, y), at(x, y + 1))))
                continue;
            for (int v = std::max(y - reach, 0); v <= std::min(y + 1 + reach, height - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + 1 + reach, width - 1); ++u) marks[at(u, v)] = 1;
        }
}

/// What is traced of the picture that was drawn last.
struct Truth {
    oracle::ReferenceTracer tracer;
    oracle::PrimaryHits hits;
    Truth(const SceneSnapshot& scene, const assets::MeshLibrary& library)
        : tracer(scene, library, scene.consumers.front().position_ws_m),
          hits(tracer.trace_primary(scene.consumers.front())) {}
    oracle::LightTruth of(const LightItem& light) const { return tracer.trace_light(hits, light, true); }
};

class HardCasesGl : public HardCaseGl, public ::testing::WithParamInterface<FittedCase> {
protected:
    void expect_true_picture(World& world, OnGpu how, double most_acne_and_leak) {
        draw(world);
        if (HasFatalFailure()) return;
        ASSERT_FALSE(scene().consumers.empty());
        const Truth truth(scene(), world.library);
        std::size_t scored = 0;
        for (std::uint32_t l = 0; l < scene().lights.size(); ++l) {
            const LightReport& light = report().lights[l];
            SCOPED_TRACE(light.name + ", " + reason_code(light.reason));
            const oracle::LightTruth traced = truth.of(scene().lights[l]);
            const auto measured = visibility(l);
            const oracle::Metrics m =
                oracle::compare({world.viewport_px, measured, traced.visibility, traced.scored, traced.ambiguous});
            scored += m.scored;
            RecordProperty(light.name + "_wrong", std::to_string(m.fraction(m.wrong)));
            EXPECT_LE(m.fraction(m.acne), most_acne_and_leak) << m.acne << " of " << m.scored;
            if (how == OnGpu::too_thin) {  // what is lost is a leak from end to end
                expect_named(l, truth, traced, m);
                continue;
            }
            EXPECT_LE(m.fraction(m.leak), most_acne_and_leak) << m.leak << " of " << m.scored;
            EXPECT_LE(m.fraction(m.wrong), kMostWrong) << m.wrong << " of " << m.scored;
        }
        EXPECT_GE(scored, kLeastScored);
    }
    /// Checks that what is lost has its reason, and no other.
    void expect_named(std::uint32_t l, const Truth& truth, const oracle::LightTruth& traced, const oracle::Metrics& m) {
        const bench::EdgeBounds bounds(scene(), device().info(), frame().fit_history());
        const oracle::EdgeExceptions beyond = oracle::edge_exceptions(
            truth.tracer, truth.hits, scene().consumers.front(), scene().lights[l], traced, m.edge,
            [&](const glm::dvec3& point, const glm::dvec3& normal) { return bounds.at(l, point, normal); });
        EXPECT_GT(beyond.sub_texel_caster, 0u);
        EXPECT_EQ(beyond.unexplained, 0u);
    }
};

TEST_P(HardCasesGl, ThePictureIsTheTruth) {
    const auto& [row, fit] = GetParam();
    World world;
    world.settings = {std::string("fit=") + fit};
    row.build(world);
    const bool stays = std::string_view(fit) != "tight";
    expect_true_picture(world, row.on_gpu, stays ? kMostWhereMapsStay : kMostAcneAndLeak);
}

INSTANTIATE_TEST_SUITE_P(EachRow, HardCasesGl, ::testing::ValuesIn(shown_cases()),
                         [](const auto& param) { return std::string(param.param.row.name) + "_" + param.param.fit; });

class SlowSunGl : public HardCaseGl, public ::testing::WithParamInterface<const char*> {};

/// Moves a sun so slowly that edges creep. A point may change as often as in truth, and oftener only beside a true
/// edge.
TEST_P(SlowSunGl, FlipsNoPointOftenerThanTheTruthDoesButBesideAnEdge) {
    constexpr int kFrames = 16;
    constexpr double kStep = 1e-2;  // step of the tangent; all of them move an edge by some pixels
    World world;
    world.settings = {std::string("fit=") + GetParam()};
    world.ground(6.0);
    world.box({-0.6, 0.0, -0.5}, {0.5, 1.2, 0.6});
    world.box({1.4, 0.8, -1.6}, {2.0, 1.1, 1.2});
    const ecs::Entity sun = world.sun(kSlant);
    world.camera();
    draw(world);
    std::vector<float> last_drawn, last_true;
    std::size_t flips = 0, true_flips = 0, scored = 0, apart = 0;
    std::vector<int> oftener(std::size_t{world.viewport_px.x} * world.viewport_px.y, 0);
    std::vector<std::uint8_t> near_edge(oftener.size(), 0);
    for (int step = 0; step < kFrames; ++step) {
        world.registry.patch<Transform>(sun, [&](Transform& t) {
            t.rotation = looking_along(kSlant + glm::dvec3(kStep * step, 0.0, -kStep * step));
        });
        draw_again(world);
        const oracle::LightTruth truth = Truth(scene(), world.library).of(scene().lights[0]);
        const auto drawn = visibility(0);
        const oracle::Metrics m =
            oracle::compare({world.viewport_px, drawn, truth.visibility, truth.scored, truth.ambiguous});
        EXPECT_LE(m.fraction(m.acne + m.leak), kMostAcneAndLeak) << "step " << step;
        mark_edges(world.viewport_px, truth, near_edge);
        for (std::size_t i = 0; step > 0 && i < drawn.size(); ++i) {
            if (truth.scored[i] == 0) continue;
            ++scored;
            const bool flipped = drawn[i] != last_drawn[i], truly = truth.visibility[i] != last_true[i];
            flips += flipped;
            true_flips += truly;
            oftener[i] += static_cast<int>(flipped) - static_cast<int>(truly);
        }
        last_drawn = drawn;
        last_true = truth.visibility;
    }
    for (std::size_t i = 0; i < oftener.size(); ++i) apart += oftener[i] > 0 && near_edge[i] == 0;
    RecordProperty("flips", std::to_string(flips));
    RecordProperty("true_flips", std::to_string(true_flips));
    EXPECT_GT(true_flips, 100u) << "the sun stood still";
    EXPECT_LE(static_cast<double>(apart), kMostAcneAndLeak * static_cast<double>(scored) / kFrames)
        << apart << " points, none beside an edge";
    // All that changes is an edge that passes. A hard edge made of texels passes a point once, or back and forth as its
    // steps are drawn again. It does so no more than a few times as often as the true edge.
    constexpr double kMostPerTrueFlip = 4.0;
    EXPECT_LE(static_cast<double>(flips), kMostPerTrueFlip * static_cast<double>(true_flips));
    EXPECT_GE(2 * flips, true_flips) << "shadows lag behind";
}

INSTANTIATE_TEST_SUITE_P(EachFit, SlowSunGl, ::testing::Values("tight", "stable", "quantised"),
                         [](const auto& param) { return std::string(param.param); });

const HardCase& row_named(std::string_view name) {
    for (const HardCase& row : hard_cases())
        if (row.name == name) return row;
    throw std::invalid_argument(std::string(name));
}

TEST_F(HardCaseGl, WhatIsLeftAfterADeletionIsWhatANewWorldShows) {
    World world;
    row_named("deleted_entity").build(world);
    const ecs::Entity passing = world.box({-2.5, 0.0, 1.0}, {-1.5, 2.0, 2.0});
    World fresh;
    row_named("deleted_entity").build(fresh);
    draw(fresh);
    std::vector<std::vector<float>> wanted;
    for (std::uint32_t l = 0; l < 3; ++l) wanted.push_back(visibility(l));

    draw(world, 1);
    EXPECT_NE(visibility(0), wanted[0]) << "the box never showed";
    world.registry.destroy(passing);
    for (int i = 0; i < kSettlingFrames; ++i) draw_again(world);
    for (std::uint32_t l = 0; l < 3; ++l) EXPECT_EQ(visibility(l), wanted[l]);
}

TEST_F(HardCaseGl, TheOrderOfCoincidentCastersDecidesNothing) {
    std::vector<std::vector<float>> first;
    for (const bool swapped : {false, true}) {
        World w;
        w.ground(6.0);
        const std::uint32_t red = w.mesh(game::make_box({-0.6, 0.5, -0.5}, {0.5, 1.2, 0.6})),
                            blue = w.mesh(game::make_box({-0.6, 0.5, -0.5}, {0.5, 1.2, 0.6}));
        w.place(swapped ? blue : red);
        w.place(swapped ? red : blue);
        w.three_lights();
        w.camera();
        draw(w);
        for (std::uint32_t l = 0; l < 3; ++l) {
            if (!swapped)
                first.push_back(visibility(l));
            else
                EXPECT_EQ(visibility(l), first[l]);
        }
    }
}

}  // namespace
}  // namespace gnomon::hard
