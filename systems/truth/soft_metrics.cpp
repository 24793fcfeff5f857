#include "systems/truth/soft_metrics.h"

#include <cassert>
#include <cmath>

namespace gnomon::truth {
namespace {

void count_pixel(float truth, float measured, SoftMetrics& m) {
    constexpr double kHalf = 0.5;
    const double off = measured >= 0.0f ? static_cast<double>(measured - truth) : -1.0, error = std::abs(off);
    ++m.scored;
    m.false_shadow += off < -kHalf;
    m.false_light += off > kHalf;
    m.mean_error += error;
    if (truth <= 0.0f) {
        ++m.umbra;
        m.umbra_leak += error;
    } else if (truth >= 1.0f) {
        ++m.lit;
        m.lit_loss += error;
    } else {
        ++m.penumbra;
        m.penumbra_error += error;
    }
}

double mean(double sum, std::size_t count) { return count == 0 ? 0.0 : sum / static_cast<double>(count); }

}  // namespace

SoftMetrics compare_soft(std::span<const float> measured, std::span<const float> truth,
                         std::span<const std::uint8_t> scored) {
    assert(measured.size() == truth.size() && scored.size() == truth.size());
    SoftMetrics m;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (scored[i] != 0) count_pixel(truth[i], measured[i], m);
    m.mean_error = mean(m.mean_error, m.scored);
    m.umbra_leak = mean(m.umbra_leak, m.umbra);
    m.lit_loss = mean(m.lit_loss, m.lit);
    m.penumbra_error = mean(m.penumbra_error, m.penumbra);
    return m;
}

}  // namespace gnomon::truth
