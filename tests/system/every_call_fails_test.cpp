#include <gmock/gmock.h>

#include "engine/gl/device_recording.h"
#include "systems/frame.h"
#include "tests/system/test_world.h"

/// Fails each device call in turn, in each way, from set-up over three frames.
namespace gnomon {
namespace {

constexpr int kFrames = 3;

void fill(TestWorld& world) {
    world.add_stage();
    world.add_mesh(kMaskedBox, {1.5, 1, 0}, true);
    world.add_mesh(kBlendedBox, {-1.5, 1, 0}, false);
    world.add_light(LightKind::directional, kLightPlace_m, "sun");
    world.add_light(LightKind::spot, kLightPlace_m, "spot");
    world.add_light(LightKind::point, {0, 4, 0}, "point");
}

/// Set-up and the frames; what went wrong is left in the device's findings.
struct Outcome {
    bool created = false;
    std::string rule;
    int frames = 0;
    std::uint64_t calls = 0;
};
Outcome run(gl::RecordingDevice& device, const assets::MeshLibrary& library) {
    TestWorld world;
    fill(world);
    Outcome outcome;
    auto made = Frame::create(device, library);
    if (made) {
        outcome.created = true;
        for (int i = 0; i < kFrames; ++i) {
            if (i == 1) world.add_mesh(kBox, {0, 1, 1.5}, true);  // one more than the instance buffer holds
            made.value()->run(world.registry, {{320, 180}, {}, true, true});
            outcome.frames += made.value()->report().lights.size() == 3 ? 1 : 0;
        }
    } else {
        outcome.rule = made.error().rule;
    }
    outcome.calls = device.calls();
    return outcome;
}

class EveryCallFails : public ::testing::TestWithParam<gl::Failure> {};

TEST_P(EveryCallFails, OnceWithoutCrashMisuseOrLeak) {
    const assets::MeshLibrary library = test_library();
    std::uint64_t calls = 0;
    {
        gl::RecordingDevice sound;
        const Outcome outcome = run(sound, library);
        ASSERT_EQ(outcome.frames, kFrames);
        calls = outcome.calls;
    }
    ASSERT_GT(calls, 40u);
    int refused = 0;
    for (std::uint64_t k = 0; k < calls; ++k) {
        gl::RecordingDevice device;
        device.fail_call(k, GetParam());
        const Outcome outcome = run(device, library);
        if (outcome.created) {
            EXPECT_EQ(outcome.frames, kFrames) << "call " << k;
        } else {
            EXPECT_EQ(outcome.rule, "gpu.scene") << "call " << k;
        }
        refused += outcome.created ? 0 : 1;
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << "call " << k << ": " << gl::to_text(f.misuse) << ": " << f.detail;
    }
    EXPECT_GT(refused, 0) << "the first calls are those of the set-up";
}

TEST_P(EveryCallFails, FromTheNthOnWithoutCrashMisuseOrLeak) {
    const assets::MeshLibrary library = test_library();
    gl::RecordingDevice sound;
    const std::uint64_t calls = run(sound, library).calls;
    for (std::uint64_t k = 0; k < calls; ++k) {
        gl::RecordingDevice device;
        for (std::uint64_t later = k; later < 4 * calls; ++later) device.fail_call(later, GetParam());
        run(device, library);
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << "from call " << k << ": " << gl::to_text(f.misuse) << ": " << f.detail;
    }
}

INSTANTIATE_TEST_SUITE_P(EachFailure, EveryCallFails,
                         ::testing::Values(gl::Failure::out_of_memory, gl::Failure::invalid_value, gl::Failure::incomplete_target,
                                           gl::Failure::compile_failed, gl::Failure::link_failed, gl::Failure::map_failed,
                                           gl::Failure::context_lost),
                         [](const auto& param) {
                             std::string name = gl::to_text(param.param);
                             std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                             return name;
                         });

}  // namespace
}  // namespace gnomon
