#include "systems/shadow/budget/cost_calibration.h"

#include <algorithm>
#include <cmath>

#include "systems/frame_timers.h"

namespace gnomon::shadow {
namespace {

double drawn_ns(const MapSettings& map, const LightReport& light) {
    if (light.counts.views_drawn == 0) return 0.0;
    return drawing_ns(map, map_edge_px(map), light.counts.views_drawn, static_cast<double>(light.counts.triangles),
                      light.counts.draws);
}

/// Returns the modelled time of lighting by one light as it was drawn, ns: with its own filter, its fallback, or kept
/// visibility.
double lit_ns(const LightItem& item, const ShadowRequest& request, const LightingLight& light,
              const LightReport& report) {
    const double pixels = static_cast<double>(light.area.screen.width) * light.area.screen.height;
    const bool looks_up = !light.row.filter_file.empty() && report.filter.filter != ShadowFilter::automatic &&
                          report.kept.reason == Reason::none;
    const double fetches = looks_up ? mean_fetches(item, request, report.filter.filter) : 0.0;
    return pixels * (kShadedPixel_ns + fetches * kFetch_ns);
}

}  // namespace

double learned(double factor, double measured_ns, double modelled_ns, std::uint32_t& frames) {
    if (!(modelled_ns >= CostCalibration::kLeastWork_ns) || !(measured_ns > 0.0) || !std::isfinite(measured_ns))
        return factor;
    const double gain = frames < CostCalibration::kFirstFrames ? CostCalibration::kFirstGain : CostCalibration::kGain;
    frames = std::min(frames + 1, CostCalibration::kFirstFrames);
    const double step = (std::log(measured_ns / modelled_ns) - std::log(factor)) * gain;
    return std::clamp(factor * std::exp(std::clamp(step, -CostCalibration::kMostStep, CostCalibration::kMostStep)),
                      CostCalibration::kLeastFactor, CostCalibration::kMostFactor);
}

void CostCalibration::submitted(std::uint64_t submission, const SceneSnapshot& scene,
                                std::span<const BudgetDecision> decisions, std::span<const LightingInputs> inputs,
                                const FrameReport& report) {
    Submission& now = submissions_[next_];
    next_ = (next_ + 1) % kFrames;
    now = {submission, true, {}, {}};
    for (std::size_t i = 0; i < report.lights.size(); ++i)
        now.modelled.drawing_ns += drawn_ns(decisions[i].request.map, report.lights[i]);
    if (inputs.empty()) return;
    for (const LightingLight& light : inputs.front().lights)
        now.modelled.lighting_ns +=
            lit_ns(scene.lights[light.light], decisions[light.light].request, light, report.lights[light.light]);
}

void CostCalibration::close(Submission& submission) {
    submission.open = false;
    factors_.drawing =
        learned(factors_.drawing, submission.measured.drawing_ns, submission.modelled.drawing_ns, learned_.drawing);
    factors_.lighting =
        learned(factors_.lighting, submission.measured.lighting_ns, submission.modelled.lighting_ns, learned_.lighting);
}

/// Adds the timers of a submission, which may arrive in parts. The first timer of a later submission completes it.
void CostCalibration::learn(std::span<const gl::Timing> timings) {
    for (const gl::Timing& timing : timings) {
        if (timing.id >= kSurfaceTimer) continue;
        for (Submission& s : submissions_) {
            if (s.open && s.number < timing.submission && s.measured.drawing_ns + s.measured.lighting_ns > 0.0)
                close(s);
            if (!s.open || s.number != timing.submission) continue;
            const bool drawing = timing.id == shadow_timer(timing.id / 2);
            (drawing ? s.measured.drawing_ns : s.measured.lighting_ns) += timing.gpu_us * 1000.0;
        }
    }
}

}  // namespace gnomon::shadow
