#pragma once
#include <memory>
#include <string>
#include <vector>

#include "systems/extract/extract.h"
#include "systems/lighting/lighting_system.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"
#include "tests/gl/frame_fixture.h"

namespace gnomon {

/// A frame with parts that the test owns, so that it can hand the lighting any inputs. `world` and `library` are filled
/// before the first run().
class HeldFrameTest : public FrameTest {
protected:
    void TearDown() override {
        lighting.reset();
        shadows.reset();
        scene.reset();
        FrameTest::TearDown();
    }
    /// Runs a frame as FrameSystem::run() does, with inputs as they were published.
    void run() {
        if (!scene) {
            auto made = GpuScene::create(device(), library);
            ASSERT_TRUE(made);
            scene = std::make_unique<GpuScene>(std::move(made).value());
            shadows = std::make_unique<shadow::ShadowSystem>(device());
            lighting = std::make_unique<lighting::LightingSystem>(device());
        }
        gl::CommandList& list = commands;
        list.clear();
        extractor.update(world, library, transforms.update(world), settings.viewport_px, snapshot);
        scene->update(snapshot, list);
        shadows->update(snapshot, *scene, {}, list, report);
        outcome.clear();
        record_picture(inputs(), list);
        shadows->report(snapshot, outcome, report);
        GlTest::run(list);
        shadows->commit(snapshot, true);
    }
    void record_picture(const shadow::LightingInputs& handed, gl::CommandList& list) {
        ASSERT_TRUE(lighting->record(handed, snapshot, *scene,
                                     {.exposure_ev = settings.exposure_ev, .most_rows = most_rows}, list, outcome));
    }
    const shadow::LightingInputs& inputs() const { return shadows->frame().inputs.front(); }
    std::vector<std::uint8_t> drawn_picture() {
        return read<std::uint8_t>(lighting->picture_texture(),
                                  std::size_t{4} * settings.viewport_px.x * settings.viewport_px.y);
    }

    std::uint32_t most_rows = lighting::LightPrograms::kNoLimit;  // LightingSettings::most_rows
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    gl::CommandList commands;  // recorded by the last run()
    FrameReport report;
    shadow::LightingOutcome outcome;
    std::unique_ptr<GpuScene> scene;
    std::unique_ptr<shadow::ShadowSystem> shadows;
    std::unique_ptr<lighting::LightingSystem> lighting;
};

}  // namespace gnomon
