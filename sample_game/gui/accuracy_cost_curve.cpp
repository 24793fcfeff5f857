#include "sample_game/gui/accuracy_cost_curve.h"

#include <algorithm>
#include <cmath>

#include "sample_game/gui/light_history.h"

namespace gnomon::game {
namespace {

constexpr double kStepsPerDoubling = 4.0, kMsPerUs = 1.0e-3;

void keep(float value, std::vector<float>& values, std::uint32_t& count) {
    if (values.size() < ContractCurve::kKept)
        values.push_back(value);
    else
        values[count % ContractCurve::kKept] = value;
    ++count;
}

/// The lights that a setting is about, together.
struct Sum {
    std::uint64_t texels = 0, bytes = 0;
    double predicted_px = 0.0, gpu_us = 0.0;
    bool any = false, timed = true, drew = false;
};

Sum sum_of(const FrameReport& report, const std::string& name) {
    Sum sum;
    for (const LightReport& light : report.lights) {
        if (light.state == LightState::skipped || (!name.empty() && light.name != name)) continue;
        sum.any = true;
        sum.texels += light.counts.texels;
        sum.bytes += light.counts.bytes;
        sum.predicted_px = std::max(sum.predicted_px, light.predicted_error_px);
        sum.drew |= light.counts.views_drawn > 0;
        sum.timed &= light.gpu_us.has_value();
        sum.gpu_us += light.gpu_us.value_or(0.0);
    }
    return sum;
}

}  // namespace

float contract_px(int step) {
    const int within = std::clamp(step, kLeastContractStep, kMostContractStep);
    return static_cast<float>(std::exp2(within / kStepsPerDoubling));
}

int contract_step(float max_error_px) {
    if (!(max_error_px > 0.0f)) return kLeastContractStep;
    const double step = kStepsPerDoubling * std::log2(static_cast<double>(max_error_px));
    return static_cast<int>(std::lround(std::clamp<double>(step, kLeastContractStep, kMostContractStep)));
}

void ContractCurve::add(float max_error_px, const FrameReport& report, const std::string& light) {
    const Sum sum = sum_of(report, light);
    if (!sum.any) return;
    auto at = std::lower_bound(settings_.begin(), settings_.end(), max_error_px,
                               [](const Setting& s, float px) { return s.last.max_error_px < px; });
    if (at == settings_.end() || at->last.max_error_px > max_error_px) at = settings_.insert(at, Setting{});
    at->last.max_error_px = max_error_px;
    at->last.texels = sum.texels;
    at->last.bytes = sum.bytes;
    at->last.predicted_px = sum.predicted_px;
    ++at->last.frames;
    if (!sum.timed) return;
    const auto ms = static_cast<float>(sum.gpu_us * kMsPerUs);
    if (sum.drew)
        keep(ms, at->drawn_ms, at->drawn);
    else
        keep(ms, at->kept_ms, at->kept);
}

std::vector<ContractPoint> ContractCurve::points() const {
    std::vector<ContractPoint> points;
    for (const Setting& setting : settings_) {
        points.push_back(setting.last);
        points.back().drawn_ms = median(setting.drawn_ms);
        points.back().kept_ms = median(setting.kept_ms);
    }
    return points;
}

}  // namespace gnomon::game
