#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/gl/device.h"
#include "systems/report.h"
#include "systems/shadow/budget/cost_model.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::shadow {

/// Learns from the device's timers how much longer than the model says its work takes: drawing maps, and lighting with
/// them. Slowly, and from frames alone that did enough of that kind. It has no clock of its own: without timers, and in
/// repeatable runs, which show it none, the model stands.
class CostClock {
public:
    /// The frame that was just submitted.
    void submitted(std::uint64_t submission, const SceneSnapshot& scene, std::span<const BudgetDecision> decisions,
                   std::span<const LightingInputs> inputs, const FrameReport& report);
    /// Timers that came in since, of whichever of the last kFrames.
    void learn(std::span<const gl::Timing> timings);

    const CostFactors& factors() const { return factors_; }

    static constexpr std::size_t kFrames = 8;  // more than drivers queue
    /// One frame moves a factor by an eighth of the way (by half at first), and by no more than a quarter: an outlier
    /// is not believed.
    static constexpr double kFirstGain = 1.0 / 2.0, kGain = 1.0 / 8.0, kMostStep = 0.25;
    static constexpr std::uint32_t kFirstFrames = 16;
    /// Beyond, no GPU is so fast, and no software device so slow, that it is not the timer that is wrong.
    static constexpr double kLeastFactor = 1.0 / 64.0, kMostFactor = 4096.0;
    /// By the model; less work drowns in what starting and ending a timer takes.
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
        bool open = false;  // its timers are awaited
        Work modelled, measured;
    };
    void close(Submission& submission);

    std::array<Submission, kFrames> submissions_;
    std::size_t next_ = 0;
    CostFactors factors_;
    Frames learned_;  // of how many each has learned
};

/// `factor` after one more measurement of work that the model gives `modelled` nanoseconds; `frames` counts those that
/// were of use.
double learned(double factor, double measured_ns, double modelled_ns, std::uint32_t& frames);

}  // namespace gnomon::shadow
