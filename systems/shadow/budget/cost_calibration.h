#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/frame_timers.h"
#include "systems/shadow/budget/cost_model.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::shadow {

/// Calibration of the cost model by the device's timers: measured over modelled time, for drawing maps and for lighting
/// with them. It changes slowly, and only in frames with enough work of that kind. It reads no clock itself. Without
/// timers, and in repeatable runs, which pass it none, the model's times stand.
class CostCalibration {
public:
    /// Records the modelled work of the frame that was just submitted.
    void submitted(std::uint64_t submission, const SceneSnapshot& scene, std::span<const BudgetDecision> decisions,
                   std::span<const LightingInputs> inputs, const FrameReport& report);
    /// Learns from timers that arrived since the last call, for any of the last kFrames submissions.
    void learn(std::span<const gl::Timing> timings);

    const CostFactors& factors() const { return factors_; }

    static constexpr std::size_t kFrames = kTimedSubmissions;
    /// Share of the remaining difference by which one frame moves a factor: half in the first frames, an eighth later.
    /// A frame changes it by a quarter at most, so that an outlier has little effect.
    static constexpr double kFirstGain = 1.0 / 2.0, kGain = 1.0 / 8.0, kMostStep = 0.25;
    static constexpr std::uint32_t kFirstFrames = 16;
    /// Bounds of a factor. No GPU is so fast, and no software device so slow; beyond, the timer is wrong.
    static constexpr double kLeastFactor = 1.0 / 64.0, kMostFactor = 4096.0;
    /// Least modelled work that is measured, ns. The start and end of a timer take as long as less work.
    static constexpr double kLeastWork_ns = 10'000.0;

private:
    struct Work {
        double drawing_ns = 0.0, lighting_ns = 0.0;
    };
    struct Frames {
        std::uint32_t drawing = 0, lighting = 0;
    };
    struct Submission {
        std::uint64_t number = 0;
        bool open = false;  // not all of its timers have arrived
        Work modelled, measured;
    };
    void close(Submission& submission);

    std::array<Submission, kFrames> submissions_;
    std::size_t next_ = 0;
    CostFactors factors_;
    Frames learned_;  // number of measurements behind each factor
};

/// Returns `factor` after one more measurement of work with the modelled time `modelled_ns`. `frames`: number of
/// measurements that were used.
double learned(double factor, double measured_ns, double modelled_ns, std::uint32_t& frames);

}  // namespace gnomon::shadow
