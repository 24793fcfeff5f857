#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "engine/gl/device_recording.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/economy/both_ways.h"
#include "tests/economy/changing_world.h"
#include "tests/economy/map_contents.h"
#include "tests/long_run.h"
#include "tests/unit/math/random_seed.h"

/// Random runs in which anything may happen, on the recording device, as usual and with economy=off. The latter draws
/// every view in every frame. Lighting's inputs are the same, and the maps that it reads would contain the same.
namespace gnomon {
namespace {

std::vector<ShadowFilter> all_filters() {
    std::vector<ShadowFilter> filters;
    for (const shadow::FilterRow& row : shadow::filter_table()) filters.push_back(row.id);
    return filters;
}

class EconomyIdentity : public ::testing::Test {
protected:
    using DepthVariant = BothWays::DepthVariant;

    void TearDown() override {
        both.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    /// Frames that differ.
    int run(int frames) {
        both = std::make_unique<BothWays>(device, library);
        both->mislead = mislead;
        int differing = 0;
        for (frame = 0; frame < frames; ++frame) {
            world.change();
            both->run(world.registry(), {96, 64},
                      [&](const BothWays::Picture& p) { contents[p.way].draw(p.commands, device); });
            differing += same() ? 0 : 1;
            count();
            device.forget();
        }
        return differing;
    }
    /// Runs until a frame differs. With few seeds nothing moves within 300 frames that an error would show; with none
    /// of 300 seeds within 6000.
    bool differs_soon() {
        for (int round = 0; round < 20; ++round)
            if (run(300) > 0) return true;
        return false;
    }
    static bool is_left_to_rays(const shadow::ShadowFrame& frame, std::uint32_t light) {
        const shadow::IndexRange views = frame.fitted.lights[light].views;
        return views.count > 0 && frame.updates[views.first].skipped_for_rays;
    }
    /// Prints the first difference.
    bool same() const {
        const shadow::ShadowFrame &a = both->frame(DepthVariant::kThrifty), &b = both->frame(DepthVariant::kLavish);
        if (a.fitted.views.size() != b.fitted.views.size() || a.inputs.size() != b.inputs.size()) return false;
        for (std::size_t c = 0; c < a.inputs.size(); ++c)
            for (std::size_t i = 0; i < a.inputs[c].lights.size(); ++i) {
                if (is_left_to_rays(a, static_cast<std::uint32_t>(i)))
                    continue;  // which see what its map would; EconomyIdentityGl has both
                const shadow::LightingLight &x = a.inputs[c].lights[i], &y = b.inputs[c].lights[i];
                if (!(x.row == y.row) || std::memcmp(&x.record, &y.record, sizeof x.record) != 0) return false;
            }
        for (std::size_t v = 0; v < a.maps.size(); ++v) {
            if (a.updates[v].skipped_for_rays) continue;
            // Neither drawn nor looked up: it may hold what it did before rays did without it.
            if (a.fitted.views[v].lit && b.fitted.views[v].lit &&
                a.fitted.lights[a.fitted.views[v].light].request.rays.used)
                continue;
            if (contents[DepthVariant::kThrifty].of(a.maps[v].target, device) ==
                contents[DepthVariant::kLavish].of(b.maps[v].target, device))
                continue;
            const LightItem& light = both->scene().lights[a.fitted.views[v].light];
            if (!mislead)
                std::cout << "frame " << frame << ": layer " << a.fitted.views[v].layer << " of a light of kind "
                          << static_cast<int>(light.kind) << " and filter " << static_cast<int>(light.shadow.filter)
                          << "\n";
            return false;
        }
        return true;
    }
    void count() {
        for (const LightReport& light : both->report(DepthVariant::kThrifty).lights) {
            thrifty_views += light.counts.views_drawn;
            states.insert(light.state);
            reasons.insert(light.reason);
        }
        for (const LightReport& light : both->report(DepthVariant::kLavish).lights) {
            lavish_views += light.counts.views_drawn;
            if (light.state == LightState::skipped) continue;
            EXPECT_EQ(light.counts.views_drawn, light.counts.views) << "economy=off saves";
        }
        consumers.insert(both->scene().consumers.size());
    }

    gl::RecordingDevice device;
    const assets::MeshLibrary library = test_library();
    ChangingWorld world{print_seed(), all_filters()};
    std::unique_ptr<BothWays> both;
    std::function<void(SceneSnapshot&)> mislead;
    MapContents contents[BothWays::kWays];
    int frame = 0;
    std::uint64_t thrifty_views = 0, lavish_views = 0;
    std::set<LightState> states;
    std::set<Reason> reasons;
    std::set<std::size_t> consumers;
};

TEST_F(EconomyIdentity, MapsAndRecordsAreThoseOfEconomyOffWhateverHappens) {
    EXPECT_EQ(run(is_long_run() ? 100000 : 2000), 0);
    // The run did what it is for.
    EXPECT_LT(thrifty_views * 2, lavish_views);
    EXPECT_GT(thrifty_views, 500u);
    for (const LightState state : {LightState::rendered, LightState::reused, LightState::skipped})
        EXPECT_TRUE(states.contains(state)) << to_text(state);
    for (const Reason reason : {Reason::no_light_shadow, Reason::shadows_off, Reason::light_off,
                                Reason::no_visible_receiver, Reason::no_caster, Reason::content_unchanged})
        EXPECT_TRUE(reasons.contains(reason)) << reason_code(reason);
    EXPECT_EQ(consumers, (std::set<std::size_t>{1, 2, 3}));
    std::cout << thrifty_views << " views drawn, " << lavish_views << " with economy off\n";
}

TEST_F(EconomyIdentity, AMoveThatASignatureMissesWouldBeSeen) {
    mislead = [](SceneSnapshot& scene) {
        for (InstanceItem& item : scene.instances) item.version = 1;
    };
    EXPECT_TRUE(differs_soon());
}

TEST_F(EconomyIdentity, ACasterThatIsForgottenWouldBeSeen) {
    mislead = [](SceneSnapshot& scene) {
        if (scene.instances.size() > 4) scene.instances.back().casts = false;
    };
    EXPECT_TRUE(differs_soon());
}

}  // namespace
}  // namespace gnomon
