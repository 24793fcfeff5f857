#include "sample_game/gui/light_history.h"

#include <algorithm>
#include <utility>

namespace gnomon::game {
namespace {

constexpr double kMsPerUs = 1.0e-3;

LightSample sample_of(const LightReport& light) {
    LightSample sample{.cpu_ms = static_cast<float>(light.cpu_us * kMsPerUs)};
    if (light.gpu_us) sample.gpu_ms = static_cast<float>(*light.gpu_us * kMsPerUs);
    if (light.state != LightState::skipped) sample.error_px = static_cast<float>(light.predicted_error_px);
    return sample;
}

}  // namespace

std::optional<float> median(std::vector<float> values) {
    if (values.empty()) return std::nullopt;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::optional<float> LightLine::median_gpu_ms() const {
    std::vector<float> values;
    for (std::size_t i = 0; i < size(); ++i)
        if ((*this)[i].gpu_ms) values.push_back(*(*this)[i].gpu_ms);
    return median(std::move(values));
}

void LightGraph::add(const FrameReport& report) {
    std::vector<LightLine> lines;
    lines.reserve(report.lights.size());
    for (const LightReport& light : report.lights) {
        const auto old = std::find_if(lines_.begin(), lines_.end(),
                                      [&](const LightLine& line) { return line.name() == light.name; });
        lines.push_back(old == lines_.end() ? LightLine(light.name) : std::move(*old));
        lines.back().add(sample_of(light));
    }
    lines_ = std::move(lines);
}

float LightGraph::most_ms() const {
    float most = 0.0f;
    for (const LightLine& line : lines_)
        for (std::size_t i = 0; i < line.size(); ++i)
            most = std::max({most, line[i].cpu_ms, line[i].gpu_ms.value_or(0.0f)});
    return most;
}

float LightGraph::most_error_px() const {
    float most = 0.0f;
    for (const LightLine& line : lines_)
        for (std::size_t i = 0; i < line.size(); ++i) most = std::max(most, line[i].error_px.value_or(0.0f));
    return most;
}

}  // namespace gnomon::game
