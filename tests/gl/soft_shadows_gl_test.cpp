#include <algorithm>
#include <cmath>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/oracle/soft_metrics.h"

// Penumbrae of a source with a size, against rays to all of it.
namespace gnomon {
namespace {

constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

class SoftShadows : public TracedFrameTest {
protected:
    /// Builds a ground, and at `height_m` a sheet over the half of it where x is negative.
    void build(LightKind kind, double height_m, ShadowFilter filter, const ShadowTuning& tuning = {},
               bool sheet = true) {
        start_anew();
        place(add_mesh(game::make_box({-4.0, -0.1, -4.0}, {4.0, 0.0, 4.0})));
        if (sheet)
            place(add_mesh(game::make_box({-4.0, height_m, -3.0}, {0.0, height_m + 0.01, 3.0})));
        light_ = add_light_of(kind, {0.4, kLamp_m, 0.3}, {.filter = filter, .resolution_px = 1024}, tuning);
        add_camera({.fov_y_rad = 0.35}, {0.4, 1.2, 3.0}, glm::dvec3(-0.35, -1.2, -3.0));
    }
    /// Builds the same under a light with a size.
    void build_soft(LightKind kind, double height_m, ShadowFilter filter = ShadowFilter::pcss, bool sheet = true) {
        build(kind, height_m, filter, {.kernel = {.taps = 32}}, sheet);
        world.patch<Light>(light_, [](Light& light) { light.source_radius_m = 0.3f, light.sun_radius_rad = 0.08f; });
    }
    struct Soft {
        oracle::SoftMetrics metrics;
        std::vector<float> measured;
        oracle::SoftTruth truth;
    };
    Soft judge_soft() {
        const SceneSnapshot& scene = frame().snapshot();
        const ConsumerItem& camera = scene.consumers.at(0);
        const oracle::ReferenceTracer tracer(scene, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        Soft soft;
        soft.truth = tracer.trace_source(hits, scene.lights.at(0), {});
        soft.measured = visibility();
        soft.metrics = oracle::compare_soft(hits, soft.truth, soft.measured);
        return soft;
    }

    /// Most that shadows of one edge may be off, as shares. `width`: share of the true penumbra's width.
    struct MostOff {
        double width = 0.0, lost = 0.0, error = 0.0;
        double penumbra_error = 1.0, umbra_leak = 1.0, lit_loss = 1.0;
    };
    void judge_edges(ShadowFilter filter, const MostOff& most);
    void plane_alone_is_lit(ShadowFilter filter);

    static constexpr double kLamp_m = 4.0;
    ecs::Entity light_;
};

void SoftShadows::judge_edges(ShadowFilter filter, const MostOff& most) {
    for (const LightKind kind : kKinds)
        for (const double height_m : {0.2, 0.4, 0.8, 1.2, 1.6}) {
            SCOPED_TRACE(std::string(kind_name(kind)) + " " + std::to_string(height_m));
            build_soft(kind, height_m, filter);
            draw();
            const oracle::SoftMetrics m = judge_soft().metrics;
            EXPECT_GT(m.widths.places, 100u);
            EXPECT_LE(static_cast<double>(m.widths.lost), most.lost * static_cast<double>(m.widths.places));
            EXPECT_NEAR(m.widths.median_ratio, 1.0, most.width);
            EXPECT_LT(m.mean_error, most.error);
            EXPECT_LT(m.penumbra_error, most.penumbra_error);
            EXPECT_LT(m.umbra_leak, most.umbra_leak);
            EXPECT_LT(m.lit_loss, most.lit_loss);
        }
}

TEST_F(SoftShadows, OfOneEdgeAreAsWideAsTheSourceMakesThemFromEveryHeight) {
    judge_edges(ShadowFilter::pcss, {.width = 0.15, .lost = 0.02, .error = 0.02});
}

// docs/explanation/prefiltered_maps.md states these.
TEST_F(SoftShadows, PrefilteredOfOneEdgeAreAboutAsWideAsTheSourceMakesThem) {
    judge_edges(ShadowFilter::pcss_moments, {.width = 0.15, .lost = 0.06, .error = 0.035});
}

TEST_F(SoftShadows, ByTrianglesOfOneEdgeAreThoseOfTheSourceFromEveryHeight) {
    judge_edges(
        ShadowFilter::soft_triangles,
        {.width = 0.1, .lost = 0.01, .error = 0.006, .penumbra_error = 0.028, .umbra_leak = 1e-3, .lit_loss = 1e-3});
}

TEST_F(SoftShadows, ByTrianglesLeakNothingWhereAPenumbraCrossesAnUmbra) {
    // Where both sheets hide some of the source, a map shows the high one alone.
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(kind_name(kind));
        const auto judge = [&](bool low) {
            build_soft(kind, 0.3, ShadowFilter::soft_triangles, low);
            place(add_mesh(game::make_box({-3.0, 1.5, -3.0}, {3.0, 1.51, 0.2})));
            draw();
            return judge_soft();
        };
        const Soft both = judge(true), high = judge(false);
        EXPECT_GT(both.metrics.umbra, 1000u);
        EXPECT_LT(both.metrics.umbra_leak, 2e-3);
        EXPECT_LT(both.metrics.penumbra_error, 0.03);
        ASSERT_EQ(both.truth.visibility.size(), high.measured.size());
        std::size_t lit = 0;
        for (std::size_t i = 0; i < high.measured.size(); ++i)
            lit += both.truth.visibility[i] == 0.0f && high.measured[i] > 0.2f ? 1 : 0;
        EXPECT_GT(lit, 500u) << "the control: the low sheet alone keeps this dark";
    }
}

TEST_F(SoftShadows, ByTrianglesDependOnNoTexelsSize) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(kind_name(kind));
        double error[2];
        for (const bool by_triangles : {false, true}) {
            build_soft(kind, 0.4, by_triangles ? ShadowFilter::soft_triangles : ShadowFilter::pcss);
            edit_light(world, light_, [](LightShadow& s) { s.resolution_px = 64; });
            draw();
            error[by_triangles] = judge_soft().metrics.penumbra_error;
        }
        EXPECT_LT(error[true], 0.03);
        EXPECT_GT(error[false], 2.0 * error[true]) << "the control: depths alone";
    }
}

TEST_F(SoftShadows, WithoutASizeAreThoseOfTheFilterBeneathToTheBit) {
    const std::pair<ShadowFilter, ShadowFilter> rows[] = {{ShadowFilter::pcss_moments, ShadowFilter::moments}};
    for (const auto& [filter, beneath] : rows)
        for (const LightKind kind : kKinds)
            for (const std::uint32_t levels : {1u, 3u}) {
                SCOPED_TRACE(std::string(kind_name(kind)) + " " + std::to_string(levels));
                std::vector<float> shown[2];
                for (const bool plain : {false, true}) {
                    build(kind, 0.8, plain ? beneath : filter, {.moments = {.levels = levels}});
                    draw();
                    shown[plain] = visibility();
                }
                EXPECT_EQ(shown[0], shown[1]);
                EXPECT_GT(std::count(shown[0].begin(), shown[0].end(), 0.0f), 1000);
            }
}

TEST_F(SoftShadows, WithoutASizeAreThoseOfTheSharpFilterToTheBit) {
    for (const LightKind kind : kKinds) {
        SCOPED_TRACE(kind_name(kind));
        std::vector<float> shown[2];
        for (const ShadowFilter filter : {ShadowFilter::pcss, ShadowFilter::sharp_4x4}) {
            build(kind, 0.8, filter, {.cascades = {.blend = 0.0f}});
            draw();
            shown[filter == ShadowFilter::pcss] = visibility();
        }
        EXPECT_EQ(shown[0], shown[1]);
        EXPECT_EQ(std::count_if(shown[0].begin(), shown[0].end(), [](float v) { return v > 0.0f && v < 1.0f; }), 0);
        EXPECT_GT(std::count(shown[0].begin(), shown[0].end(), 0.0f), 1000);
    }
}

TEST_F(SoftShadows, AreNoWiderBesideAHighCasterThatHidesNothingOfTheSource) {
    // Straight below the sun, which shows it beside the edge on the map, a little beyond the widest cone; or over it.
    for (const bool aside : {true, false}) {
        std::vector<float> shown[2];
        for (const bool high : {false, true}) {
            build_soft(LightKind::directional, 0.3);
            const double x = aside ? 0.5 : -0.1;
            if (high) place(add_mesh(game::make_box({x, 3.0, -3.0}, {x + 1.0, 3.1, 3.0})));
            world.patch<Transform>(light_, [](Transform& t) { t.rotation = looking_along({0.0, -1.0, 0.0}); });
            draw();
            shown[high] = visibility();
        }
        double apart = 0.0;
        std::size_t between = 0;
        for (std::size_t i = 0; i < shown[0].size(); ++i) {
            if (!(shown[0][i] > 0.0f && shown[0][i] < 1.0f)) continue;
            ++between;
            apart += static_cast<double>(std::abs(shown[0][i] - shown[1][i]));
        }
        ASSERT_GT(between, 500u);
        apart /= static_cast<double>(between);
        if (aside)
            EXPECT_LT(apart, 0.05) << "another search, other seeds";
        else
            EXPECT_GT(apart, 0.2) << "the control: it hides the source";
    }
}

TEST_F(SoftShadows, WithoutTheCasterAreGone) {
    for (const ShadowFilter filter : {ShadowFilter::pcss, ShadowFilter::pcss_moments, ShadowFilter::soft_triangles})
        for (const LightKind kind : kKinds) {
            SCOPED_TRACE(kind_name(kind));
            build_soft(kind, 0.8, filter, false);
            draw();
            const std::vector<float> shown = visibility();
            EXPECT_EQ(std::count_if(shown.begin(), shown.end(), [](float v) { return v >= 0.0f && v < 1.0f; }), 0);
        }
}

void SoftShadows::plane_alone_is_lit(ShadowFilter filter) {
    for (const LightKind kind : kKinds)
        for (const double height_m : {0.02, 0.1, 0.5, 2.0}) {
            SCOPED_TRACE(std::string(kind_name(kind)) + " " + std::to_string(height_m));
            build_soft(kind, 0.0, filter, false);
            world.patch<Light>(light_, [](Light& light) { light.sun_radius_rad = light.source_radius_m = 0.3f; });
            const glm::dvec3 at_m(-1.7, height_m, 1.1);
            world.patch<Transform>(light_, [&](Transform& t) {
                t.translation_m = at_m;
                t.rotation = looking_along(-at_m);
            });
            draw();
            EXPECT_EQ(frame().report().lights[0].state, LightState::rendered) << "the plane casts";
            const std::vector<float> shown = visibility();
            constexpr float kRounding = 1e-5f;  // rounding of four moments
            const auto dimmed = [](float v) { return v >= 0.0f && v < 1.0f - kRounding; };
            EXPECT_EQ(std::count_if(shown.begin(), shown.end(), dimmed), 0);
            EXPECT_GT(std::count_if(shown.begin(), shown.end(), [](float v) { return v > 0.5f; }), 10000);
        }
}

TEST_F(SoftShadows, OfAPlaneAloneAreNoneHoweverLowTheSourceStandsAndHoweverLargeItIs) {
    for (const ShadowFilter filter : {ShadowFilter::pcss, ShadowFilter::pcss_moments, ShadowFilter::soft_triangles})
        plane_alone_is_lit(filter);
}

}  // namespace
}  // namespace gnomon
