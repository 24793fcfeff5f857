#include "systems/shadow/publish/visibility_hash.h"

#include <gtest/gtest.h>

#include <functional>

#include "systems/shadow/frame/shadow_frame.h"

/// Which lights' lookups are signed at all, and what of a light and of its map counts (visibility_hash.h).
/// tests/system/kept_visibility_test.cpp covers what else a kept picture follows from.
namespace gnomon::shadow {
namespace {

class LookupSignature : public ::testing::Test {
protected:
    LookupSignature() {
        scene.version = 7;
        scene.lights.resize(1);
        frame.decisions.resize(1);
        frame.statuses.resize(1);
        frame.fitted.lights.resize(1);
        frame.fitted.lights[0].views.count = 2;
        frame.fitted.views.resize(2);
        frame.maps.resize(2);
        for (MapAssignment& map : frame.maps) map.texture = {1};
        frame.updates.resize(2);
        inputs.lights.resize(1);
        light().row.filter_file = "shadow/filters/pcf/hard.glsl";
    }
    LightingLight& light() { return inputs.lights[0]; }
    std::uint64_t signature() {
        light().lookup_signature = 0;
        sign_lookups(scene, drawn_views(frame), inputs);
        return light().lookup_signature;
    }
    SceneSnapshot scene;
    ShadowFrame frame;
    LightingInputs inputs;
};

TEST_F(LookupSignature, IsTheSameForTheSameAndFollowsFromWhatIsLookedUp) {
    const std::uint64_t before = signature();
    EXPECT_NE(before, 0u);
    EXPECT_EQ(signature(), before);
    light().record.radiance = {3.0f, 2.0f, 1.0f, light().record.radiance.w};
    EXPECT_EQ(signature(), before) << "how much arrives, not whether";
    scene.version = 8;
    EXPECT_EQ(signature(), before) << "something moved elsewhere";
    frame.updates[1].content = 5;
    const std::uint64_t redrawn = signature();
    EXPECT_NE(redrawn, before);
    light().row.rays = true;
    const std::uint64_t rays = signature();
    EXPECT_NE(rays, redrawn);
    scene.version = 9;
    EXPECT_NE(signature(), rays) << "rays meet whatever casts anywhere";
}

TEST_F(LookupSignature, IsNoneWhereNothingIsToBeKept) {
    const auto without = [&](const std::function<void()>& change) {
        const auto old_scene = scene;
        const auto old_frame = frame;
        const auto old_inputs = inputs;
        change();
        const std::uint64_t changed = signature();
        scene = old_scene;
        frame = old_frame;
        inputs = old_inputs;
        return changed;
    };
    EXPECT_NE(without([] {}), 0u);
    EXPECT_EQ(without([&] { light().row.filter_file = {}; }), 0u) << "no shadow";
    EXPECT_EQ(without([&] { scene.lights[0].tuning.reuse.economy = false; }), 0u);
    EXPECT_EQ(without([&] { scene.lights[0].tuning.reuse.keep_visibility = false; }), 0u);
    EXPECT_EQ(without([&] { scene.version = 0; }), 0u) << "nobody counts its changes";
    EXPECT_EQ(without([&] { frame.updates[1].hold = Hold::by_turn; }), 0u) << "casters as they were";
    // What is kept while a map changes too much to be drawn goes with the first frame that draws it.
    EXPECT_EQ(without([&] { frame.updates[0].skipped_for_rays = true; }), 0u);
}

}  // namespace
}  // namespace gnomon::shadow
