#include "bench/sweep/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::bench {

std::string time_left(const SweepProgress& progress, std::uint32_t rounds, double budget_s) {
    const double of_budget_s = std::max(budget_s - progress.spent_s, progress.judging_left_s);
    const bool known = rounds == 0 || progress.rounds_timed > 0.0;
    const double rounds_left = std::max(rounds - progress.rounds_timed, 0.0);
    double left_s = of_budget_s;
    if (known) left_s = progress.judging_left_s;
    if (known && rounds_left > 0.0)
        left_s = std::min(left_s + rounds_left * progress.timed_s / progress.rounds_timed, of_budget_s);
    constexpr double kMinute_s = 60.0;
    const char* const how = known ? "about" : "at most";
    char text[48];
    if (left_s < kMinute_s)
        std::snprintf(text, sizeof text, "%s %.0f s left", how, left_s);
    else
        std::snprintf(text, sizeof text, "%s %.0f min left", how, std::ceil(left_s / kMinute_s));
    return text;
}

}  // namespace gnomon::bench
