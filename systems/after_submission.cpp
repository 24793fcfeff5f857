#include "systems/after_submission.h"

namespace gnomon {
namespace {

/// Registers the submission with all systems that measure it.
void note_submission(const FrameParts& parts, std::uint64_t submission, bool learn_costs, const FrameReport& report) {
    shadow::ShadowSystem& shadows = parts.shadows;
    shadows.draw_times().submitted(submission, parts.scene, report);
    const shadow::ShadowFrame& frame = shadows.frame();
    if (learn_costs)
        shadows.cost_calibration().submitted(submission, parts.scene, frame.decisions, frame.inputs, report);
}

}  // namespace

void commit_submission(const FrameParts& parts, const gl::SubmitResult& result, bool learn_costs, FrameReport& report) {
    const bool drawn = result.failure == gl::Failure::none;
    parts.shadows.commit(parts.scene, drawn);
    if (parts.lighting) parts.lighting->submitted(result.submission, drawn);
    parts.gpu.submitted(drawn);
    if (!drawn) report.failure = result.failure;
    note_submission(parts, result.submission, learn_costs, report);
}

void learn_times(const FrameParts& parts, std::span<const gl::Timing> timings, bool learn_costs) {
    if (timings.empty()) return;
    parts.shadows.draw_times().learn(timings);
    if (parts.lighting) parts.lighting->learn(timings);
    if (learn_costs) parts.shadows.cost_calibration().learn(timings);
}

std::vector<gl::Timing> after_submission(const FrameParts& parts, const gl::SubmitResult& result, bool learn_costs,
                                         FrameReport& report) {
    commit_submission(parts, result, learn_costs, report);
    std::vector<gl::Timing> timings = parts.device.take_timings();
    learn_times(parts, timings, learn_costs);
    return timings;
}

}  // namespace gnomon
