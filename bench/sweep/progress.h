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

/// Estimates the time left, as in "about 40 s left". A round takes as long as the ones before. Before the first timed
/// row only a bound is known, "at most 17 min left": no round begins that would exceed `budget_s`.
std::string time_left(const SweepProgress& progress, std::uint32_t rounds, double budget_s);

}  // namespace gnomon::bench
