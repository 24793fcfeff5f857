#include <gtest/gtest.h>

#include <cctype>
#include <iostream>
#include <limits>
#include <optional>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "systems/frame_system.h"
#include "tests/gl/failing_gl.h"
#include "tests/long_run.h"
#include "tests/system/fault_scenes.h"

// OpenGL itself fails under the executor, call by call, while the built-in scene is set up and runs. Every frame comes,
// the pictures after the fault are those without one, and no object is left behind.
namespace gnomon {
namespace {

using Picture = std::vector<std::uint8_t>;
constexpr int kFaultyFrames = 3, kMostFramesToRecover = 60;
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kShortRunCases = 8;  // per fault and span

struct Gpu {
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<FrameSystem> frame;
};

class EveryGlCallFails : public ::testing::TestWithParam<GlFault> {
protected:
    void SetUp() override {
        auto made = platform::make_headless_context(false);
        ASSERT_TRUE(made) << to_line(made.error());
        context = std::move(made).value();
        play_soundly();
        gl.emplace();
    }
    void play_soundly() {
        Gpu gpu;
        ASSERT_EQ(make(gpu), "");
        for (int i = 0; i < kFaultyFrames + kMostFramesToRecover; ++i) {
            run(gpu, i);
            ASSERT_TRUE(gpu.frame->read_picture(sound.emplace_back()));
        }
    }
    /// Makes the device and the frame system. Returns the rule of the error, or nothing.
    std::string make(Gpu& gpu) {
        auto device = gl::make_gl45_device({}, {.keeps_state = keeps_state});
        if (!device) return device.error().rule;
        gpu.device = std::move(device).value();
        auto frame = FrameSystem::create(*gpu.device, *scene.library);
        if (!frame) return frame.error().rule;
        gpu.frame = std::move(frame).value();
        return {};
    }
    static void lose(Gpu& gpu) {
        gpu.frame.reset();
        gpu.device.reset();
    }
    void run(Gpu& gpu, int index) {
        scene.play(index);
        gpu.frame->run(*scene.registry, {.viewport_px = {64, 64}, .exposure_ev = {}, .repeatable = true});
    }
    void expect_delivered(Gpu& gpu, bool lasting) {
        const FrameReport& report = gpu.frame->report();
        EXPECT_EQ(report.lights.size(), 3u);
        Picture picture;
        // A readback may be what the fault strikes: then the next one succeeds.
        const bool read = gpu.frame->read_picture(picture) || gpu.frame->read_picture(picture);
        if (!lasting && GetParam() != GlFault::context_lost) {
            EXPECT_TRUE(read);
        }
        if (!gpu.frame->picture_target()) {
            EXPECT_NE(report.failure, gl::Failure::none) << "no picture, and no word";
        }
    }
    void expect_recovery(Gpu& gpu) {
        for (int i = kFaultyFrames; i < kFaultyFrames + kMostFramesToRecover; ++i) {
            run(gpu, i);
            Picture picture;
            if (gpu.frame->read_picture(picture) && picture == sound[static_cast<std::size_t>(i)]) return;
        }
        ADD_FAILURE() << "the pictures are not those without a fault, " << kMostFramesToRecover << " frames later";
    }
    /// Plays set-up and the faulty frames; then the fault ends.
    void play(std::uint64_t call, bool lasting) {
        SCOPED_TRACE("call " + std::to_string(call) + (lasting ? " and all later ones" : ""));
        const std::int64_t names = gl->live_names();
        keeps_state = lasting;  // each way to set state meets one way to fail
        Gpu gpu;
        gl->begin(GetParam(), call, lasting);
        const std::string refusal = make(gpu);
        if (refusal.empty()) {
            for (int i = 0; i < kFaultyFrames; ++i) {
                run(gpu, i);
                expect_delivered(gpu, lasting);
            }
        } else {
            EXPECT_EQ(refusal, "gpu.scene");
        }
        gl->end();
        if (!refusal.empty() || GetParam() == GlFault::context_lost) {
            lose(gpu);
            EXPECT_EQ(gl->live_names(), names);
            gl->begin(GetParam(), kNever, false);
            ASSERT_EQ(make(gpu), "");
        }
        expect_recovery(gpu);
        lose(gpu);
        EXPECT_EQ(gl->live_names(), names);
    }
    std::uint64_t count_calls() {
        Gpu gpu;
        gl->begin(GetParam(), kNever, false);
        EXPECT_EQ(make(gpu), "");
        Picture picture;
        for (int i = 0; i < kFaultyFrames; ++i) {
            run(gpu, i);
            EXPECT_TRUE(gpu.frame->read_picture(picture));
            EXPECT_EQ(picture, sound[static_cast<std::size_t>(i)]) << "two runs differ";
        }
        return gl->calls(GetParam());
    }

    FaultScene scene = sampled_courtyard_scene();
    bool keeps_state = false;  // option of the device
    std::unique_ptr<platform::Context> context;
    std::vector<Picture> sound;   // by frame
    std::optional<FailingGl> gl;  // once all of OpenGL that is used has been called
};

TEST_P(EveryGlCallFails, WithoutAFrameOrAShadowOrAnObjectLostForGood) {
    const std::uint64_t calls = count_calls();
    const bool few = GetParam() == GlFault::null_map;  // memory is mapped where lists get larger
    ASSERT_GE(calls, few ? 1u : kShortRunCases);
    // Every other call of a long run fails, in turn once or with all later ones.
    const std::uint64_t stride = few ? 1 : is_long_run() ? 4 : calls / kShortRunCases;
    std::uint64_t cases = 0;
    for (const bool lasting : {false, true})
        for (std::uint64_t call = lasting ? stride / 2 : 0; call < calls; call += stride, ++cases) play(call, lasting);
    std::cout << to_text(GetParam()) << ": " << cases << " of " << 2 * calls << " cases\n";
    RecordProperty("cases", std::to_string(cases));
}

INSTANTIATE_TEST_SUITE_P(EachFault, EveryGlCallFails,
                         ::testing::Values(GlFault::out_of_memory, GlFault::invalid_value, GlFault::incomplete_target,
                                           GlFault::compile_failed, GlFault::link_failed, GlFault::null_map,
                                           GlFault::context_lost),
                         [](const auto& param) {
                             std::string name = to_text(param.param);
                             std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                             return name;
                         });

}  // namespace
}  // namespace gnomon
