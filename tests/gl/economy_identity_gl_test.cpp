#include <array>
#include <bit>
#include <iostream>

#include "systems/shadow/request/filter_table.h"
#include "tests/economy/both_ways.h"
#include "tests/economy/changing_world.h"
#include "tests/gl/gl_test_context.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/unit/math/random_seed.h"

/// The scripted runs in pictures: the visibility of every light, for every camera, is bit for bit that of economy=off.
/// There every view is drawn in every frame. Lights that get no shadow at all are compared with rays.
namespace gnomon {
namespace {

constexpr glm::uvec2 kPicture_px{96, 64};
/// Number of frames of the script, then of frames in which nothing changes: there visibility is kept.
constexpr int kStretch = 6;
constexpr int kMostRuns = 20;             // the script goes on where it had nothing to see
constexpr std::uint64_t kManyDark = 200;  // pixels of a frame
constexpr std::size_t kPixels = std::size_t{kPicture_px.x} * kPicture_px.y;

/// Returns whether a light's shadows must be those of its rays. A range that was set leaves out casters beyond it; a
/// sun in perspective has rays that are not parallel.
bool follows_rays(const LightItem& light) {
    const ShadowTuning::Projection& given = light.tuning.projection;
    const bool is_spread = light.kind == LightKind::directional && given.kind == LightProjection::perspective;
    return given.near_m == 0.0f && given.far_m == 0.0f && !is_spread;
}

std::vector<ShadowFilter> all_filters() {
    std::vector<ShadowFilter> filters;
    for (const shadow::FilterRow& row : shadow::filter_table()) filters.push_back(row.id);
    return filters;
}

class EconomyIdentityGl : public GlTest {
protected:
    using DepthVariant = BothWays::DepthVariant;
    using Floats = std::vector<float>;

    void TearDown() override {
        both.reset();
        GlTest::TearDown();
    }
    Floats visibility_of(const BothWays::Picture& p, std::uint32_t light) {
        lighting::LightingSystem& lighting = both->lighting(p.way);
        gl::CommandList list;
        EXPECT_TRUE(lighting.record_visibility(p.inputs, light, both->gpu(), list));
        run(list);
        return read<float>(lighting.visibility_texture(), kPixels);
    }
    /// Pixels of lights that differ; a run that is misled ends with the first. `frames`: those of the script, with as
    /// many still ones between.
    std::size_t play(int frames) {
        both = std::make_unique<BothWays>(device(), library);
        both->mislead = mislead;
        const bool misled = static_cast<bool>(mislead);
        std::size_t differing = 0;
        for (int frame = 0; frame < 2 * frames && !(misled && differing > 0); ++frame) {
            if (frame % (2 * kStretch) < kStretch) world.change();
            for (std::vector<Floats>& seen : visibilities) seen.clear();
            for (auto& seen : pictures) seen.clear();
            both->run(world.registry(), kPicture_px, [&](const BothWays::Picture& p) {
                pictures[p.way].push_back(read<std::uint8_t>(both->lighting(p.way).picture_texture(), 4 * kPixels));
                for (std::uint32_t i = 0; i < p.inputs.lights.size(); ++i)
                    visibilities[p.way].push_back(visibility_of(p, i));
            });
            differing += difference();
            if (!misled) compare_unshadowed_with_rays();
            count();
        }
        return differing;
    }
    void count() {
        for (const LightReport& light : both->report(DepthVariant::kThrifty).lights) {
            thrifty_views += light.counts.views_drawn;
            kept += light.kept.reason == Reason::visibility_kept ? 1 : 0;
        }
        for (const LightReport& light : both->report(DepthVariant::kLavish).lights) {
            lavish_views += light.counts.views_drawn;
            EXPECT_EQ(light.kept.bytes, 0u) << "economy=off keeps";
        }
    }
    std::size_t difference() {
        const std::vector<Floats>&a = visibilities[DepthVariant::kThrifty], &b = visibilities[DepthVariant::kLavish];
        EXPECT_EQ(a.size(), b.size());
        std::size_t differing = 0;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            for (std::size_t p = 0; p < a[i].size(); ++p) {
                differing += std::bit_cast<std::uint32_t>(a[i][p]) != std::bit_cast<std::uint32_t>(b[i][p]) ? 1 : 0;
                shadowed += a[i][p] >= 0.0f && a[i][p] < 1.0f ? 1 : 0;
            }
        if (differing == 0 && pictures[DepthVariant::kThrifty] != pictures[DepthVariant::kLavish]) ++differing;
        return differing;
    }
    /// Lights without a map because nothing that is seen could be dark: no ray may say otherwise.
    void compare_unshadowed_with_rays() {
        const SceneSnapshot& scene = both->scene();
        for (std::size_t c = 0; c < scene.consumers.size(); ++c) {
            const oracle::ReferenceTracer tracer(scene, library, scene.consumers[c].position_ws_m);
            oracle::PrimaryHits hits;
            for (std::size_t i = 0; i < scene.lights.size(); ++i) {
                const Reason reason = both->report(DepthVariant::kThrifty).lights[i].reason;
                if (reason != Reason::no_caster && reason != Reason::no_visible_receiver) continue;
                if (!follows_rays(scene.lights[i])) continue;
                if (hits.count() == 0) hits = tracer.trace_primary(scene.consumers[c]);
                const oracle::LightTruth truth = tracer.trace_light(hits, scene.lights[i], true);
                const Floats& seen = visibilities[DepthVariant::kThrifty][c * scene.lights.size() + i];
                for (std::size_t p = 0; p < seen.size(); ++p) {
                    if (!truth.scored[p] || truth.ambiguous[p]) continue;
                    ++judged;
                    lost += truth.visibility[p] < 1.0f && seen[p] > 0.0f ? 1 : 0;
                }
            }
        }
    }

    const assets::MeshLibrary library = test_library();
    ChangingWorld world{print_seed(), all_filters()};
    std::unique_ptr<BothWays> both;
    std::function<void(SceneSnapshot&)> mislead;
    std::array<std::vector<Floats>, BothWays::kWays> visibilities;                 // by consumer, then by light
    std::array<std::vector<std::vector<std::uint8_t>>, BothWays::kWays> pictures;  // by consumer
    std::uint64_t kept = 0;  // times that a light was read instead of looked up
    std::uint64_t thrifty_views = 0, lavish_views = 0, shadowed = 0, judged = 0, lost = 0;
};

TEST_F(EconomyIdentityGl, EveryLightsVisibilityIsThatOfEconomyOffToTheBit) {
    const int frames = is_exploring() ? 150 : 500;
    const auto least = static_cast<std::uint64_t>(frames);
    std::size_t differing = 0;
    int runs = 0;
    do {  // few random worlds skip a light before what is seen
        differing += play(frames);
        ++runs;
    } while (runs < kMostRuns && (shadowed <= least * kManyDark || kept <= least / 4 || judged <= least / 3));
    EXPECT_EQ(differing, 0u);
    EXPECT_EQ(lost, 0u) << "pixels that rays find dark, of lights that were skipped";
    EXPECT_LT(runs, kMostRuns) << "too few pixels are dark, kept or judged by rays";
    EXPECT_LT(thrifty_views * 2, lavish_views);
    std::cout << 2 * frames * runs << " frames: " << thrifty_views << " views drawn, " << lavish_views << " with economy off; "
              << shadowed << " dark pixels alike; " << judged << " pixels of skipped lights traced; " << kept
              << " times a light was read instead of looked up\n";
}

TEST_F(EconomyIdentityGl, AMoveThatASignatureMissesWouldBeSeen) {
    mislead = [](SceneSnapshot& scene) {
        for (InstanceItem& item : scene.instances) item.version = 1;
    };
    std::size_t differing = 0;
    for (int runs = 0; runs < kMostRuns && differing == 0; ++runs) differing = play(300);
    EXPECT_GT(differing, 0u);
}

}  // namespace
}  // namespace gnomon
