#include "tests/oracle/area_flicker.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::oracle {
namespace {

constexpr double kTail = 0.99;

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double tail_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(std::ceil(kTail * static_cast<double>(values.size()))) - 1];
}

}  // namespace

AreaFlicker compare_changes(std::span<const std::vector<WatchedTruth>> truth,
                            std::span<const std::vector<float>> visibility) {
    assert(truth.size() == visibility.size());
    AreaFlicker flicker;
    std::vector<double> crossed, others, moves;
    for (std::size_t frame = 1; frame < truth.size(); ++frame) {
        assert(truth[frame].size() == visibility[frame].size() && truth[frame].size() == truth[0].size());
        for (std::size_t i = 0; i < truth[frame].size(); ++i) {
            const WatchedTruth &before = truth[frame - 1][i], &now = truth[frame][i];
            const WatchedState worse = std::min(before.state, now.state);
            if (worse != WatchedState::whole) {
                ++flicker.left_out[static_cast<std::size_t>(worse)];
                continue;
            }
            const float was_seen = visibility[frame - 1][i], is_seen = visibility[frame][i];
            const double move = static_cast<double>(now.lit) - static_cast<double>(before.lit);
            const double seen = static_cast<double>(is_seen) - static_cast<double>(was_seen);
            const double off = was_seen >= 0.0f && is_seen >= 0.0f ? std::abs(seen - move) : 1.0;
            const bool is_crossed = before.is_crossed() || now.is_crossed();
            (is_crossed ? crossed : others).push_back(off);
            if (is_crossed) moves.push_back(std::abs(move));
        }
    }
    flicker.pairs = crossed.size();
    flicker.mean = mean_of(crossed);
    flicker.p99 = tail_of(crossed);
    flicker.truth = mean_of(moves);
    flicker.uncrossed = others.size();
    flicker.uncrossed_mean = mean_of(others);
    return flicker;
}

}  // namespace gnomon::oracle
