#include "tests/oracle/soft_metrics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace gnomon::oracle {
namespace {

constexpr float kDark = 0.1f, kBright = 0.9f;
// A share of 256 rays is off by three hundredths at most in most places: such a step back is no second edge.
constexpr float kNoise = 0.06f;
// Pixels of one plane: cosine of their normals, and their distance from it as a share of how far apart they are.
constexpr double kSameNormal = 1.0 - 1.0e-6, kSamePlane = 1.0e-4;

/// Where values rise through a tenth and nine tenths, between whole places.
struct Rise {
    double low = 0.0, high = 0.0;
    double width() const { return high - low; }
};

double crossing(std::span<const float> values, std::size_t before, float level) {
    const auto a = static_cast<double>(values[before]), b = static_cast<double>(values[before + 1]);
    return static_cast<double>(before) + (static_cast<double>(level) - a) / (b - a);
}

/// Returns the first rise from dark to bright at or after `from` and before `end`.
std::optional<Rise> first_rise(std::span<const float> values, std::size_t from, std::size_t end) {
    std::optional<std::size_t> dark;
    for (std::size_t i = from; i < end; ++i) {
        if (values[i] <= kDark) dark = i;
        if (values[i] >= kBright && dark) return Rise{crossing(values, *dark, kDark), crossing(values, i - 1, kBright)};
    }
    return std::nullopt;
}

bool rises_steadily(std::span<const float> values) {
    float highest = values.front();
    for (const float value : values) {
        if (value < highest - kNoise) return false;
        highest = std::max(highest, value);
    }
    return true;
}

class Widths {
public:
    /// Judges the rises along one line of pixels on one plane.
    void look_along(const std::vector<float>& truth, const std::vector<float>& measured) {
        for (std::size_t from = 0; from < truth.size();) {
            const auto rise = first_rise(truth, from, truth.size());
            if (!rise) return;
            const auto first = static_cast<std::size_t>(std::floor(rise->low));
            const auto last = static_cast<std::size_t>(std::ceil(rise->high));
            if (rise->width() >= static_cast<double>(kLeastPenumbra_px) &&
                rises_steadily(std::span(truth).subspan(first, last - first + 1)))
                judge(*rise, first, last, measured);
            from = last;
        }
    }

    PenumbraWidths result() {
        PenumbraWidths widths{ratios_.size(), lost_};
        if (ratios_.empty()) return widths;
        std::sort(ratios_.begin(), ratios_.end());
        const auto at = [&](double share) {
            return ratios_[static_cast<std::size_t>(share * static_cast<double>(ratios_.size() - 1) + 0.5)];
        };
        widths.median_ratio = at(0.5);
        widths.p10_ratio = at(0.1);
        widths.p90_ratio = at(0.9);
        return widths;
    }

private:
    /// Compares a true rise with the first measured one, searched as far again to either side.
    void judge(const Rise& truth, std::size_t first, std::size_t last, const std::vector<float>& measured) {
        const std::size_t width = last - first;
        const std::size_t from = first > width ? first - width : 0, end = std::min(last + width + 1, measured.size());
        const auto found = first_rise(measured, from, end);
        ratios_.push_back(found ? found->width() / truth.width() : 0.0);
        lost_ += !found;
    }

    std::vector<double> ratios_;
    std::size_t lost_ = 0;
};

/// Returns whether q lies on the plane of p.
bool on_one_plane(const PrimaryHits& hits, std::size_t p, std::size_t q) {
    if (glm::dot(hits.normal_ws[p], hits.normal_ws[q]) < kSameNormal) return false;
    const glm::dvec3 way = hits.position_rel_m[q] - hits.position_rel_m[p];
    return std::abs(glm::dot(hits.normal_ws[p], way)) <= kSamePlane * glm::length(way);
}

/// Judges a row or a column both ways, in runs of pixels on one plane.
void look_along_line(const PrimaryHits& hits, const SoftTruth& truth, std::span<const float> measured,
                     std::size_t first, std::size_t step, std::size_t count, Widths& widths) {
    std::vector<float> truths, values;
    const auto flush = [&] {
        for (int way = 0; way < 2; ++way) {
            widths.look_along(truths, values);
            std::reverse(truths.begin(), truths.end());
            std::reverse(values.begin(), values.end());
        }
        truths.clear();
        values.clear();
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t pixel = first + i * step;
        const bool usable = truth.scored[pixel] != 0 && measured[pixel] >= 0.0f;
        if (!usable || (!truths.empty() && !on_one_plane(hits, pixel - step, pixel))) flush();
        if (!usable) continue;
        truths.push_back(truth.visibility[pixel]);
        values.push_back(measured[pixel]);
    }
    flush();
}

}  // namespace

SoftMetrics compare_soft(const PrimaryHits& hits, const SoftTruth& truth, std::span<const float> measured) {
    SoftMetrics m{truth::compare_soft(measured, truth.visibility, truth.scored), {}};
    Widths widths;
    const std::size_t columns = hits.size_px.x, rows = hits.size_px.y;
    for (std::size_t y = 0; y < rows; ++y) look_along_line(hits, truth, measured, y * columns, 1, columns, widths);
    for (std::size_t x = 0; x < columns; ++x) look_along_line(hits, truth, measured, x, columns, rows, widths);
    m.widths = widths.result();
    return m;
}

}  // namespace gnomon::oracle
