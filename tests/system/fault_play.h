#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/device_recording.h"
#include "systems/frame_system.h"
#include "tests/system/fault_scenes.h"

namespace gnomon {

/// How long a fault lasts: for one call, or until the last faulty frame is over, for whatever creates or for all calls.
enum class FaultSpan : std::uint8_t { once, creations, all_calls };

struct Fault {
    std::uint64_t call = 0;
    gl::Failure failure = gl::Failure::out_of_memory;
    FaultSpan span = FaultSpan::once;
};

/// Plays a scene on recording devices, first without any fault, then as often as wanted with one each.
class FaultPlay {
public:
    explicit FaultPlay(FaultScene scene);

    /// Returns the number of create_*, submit and read_buffer calls of set-up and the faulty frames, if nothing fails.
    std::size_t calls() const { return calls_.size(); }
    bool is_creation(std::uint64_t call) const { return !calls_.at(call).is_submission && !calls_.at(call).is_reading; }

    /// Plays the scene with this fault and checks the outcome. Set-up is refused whole, or every frame is delivered.
    /// Each light that lost something reports it, the shadows come back, and nothing is misused or left behind.
    void check(const Fault& fault);

    static constexpr int kFaultyFrames = 3, kMostFramesToRecover = 60;

private:
    struct Call {
        int frame;  // -1: set-up
        bool is_submission, is_reading;
        std::string label;
    };
    /// What one light got of one frame.
    struct LightOutcome {
        std::string name;
        LightKind kind;
        LightState state;
        Reason reason;
        std::uint64_t bytes;
        bool samples_map;  // in its own pass
        std::string_view filter_file;
        ShadowFilter drawn, said;  // filter of that pass's lookups, and filter in the report
        double predicted_error_px;
        bool keeps_max_error;
    };
    /// A device and what lives on it.
    struct Host {
        std::unique_ptr<gl::RecordingDevice> device = std::make_unique<gl::RecordingDevice>();
        std::unique_ptr<FrameSystem> frame;
    };

    bool set_up(Host& host, const Fault& fault);
    std::vector<LightOutcome> run_frame(Host& host, int index);
    void expect_delivered(const Host& host, int index, const Fault& fault, const std::vector<LightOutcome>& lights);
    void expect_consistent(const std::vector<LightOutcome>& lights, int index, bool picture) const;
    void expect_named(const std::vector<LightOutcome>& lights, const Call& call) const;
    void expect_recovery(Host& host);
    static void expect_nothing_left(Host& host);

    FaultScene scene_;
    std::vector<Call> calls_;
    std::vector<std::vector<LightOutcome>> sound_;  // by frame
};

}  // namespace gnomon
