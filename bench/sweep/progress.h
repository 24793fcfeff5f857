#pragma once
#include <cstdint>
#include <string>

namespace gnomon::bench {

/// How far a sweep has come.
struct SweepProgress {
    double judging_left_s = 0.0;          // by what the rows before took
    double spent_s = 0.0, timed_s = 0.0;  // in all, and of that on rounds of times
    double rounds_timed = 0.0;            // and a part of the next one
};

/// "about 40 s left". Rounds take as long as those before; before the first of their rows "at most 17 min left" is all
/// that is known, since no round begins that would go beyond `budget_s`.
std::string time_left(const SweepProgress& progress, std::uint32_t rounds, double budget_s);

}  // namespace gnomon::bench
