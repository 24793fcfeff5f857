#pragma once
#include <cstdint>
#include <string>

namespace gnomon::bench {

/// Progress of a sweep.
struct SweepProgress {
    double judging_left_s = 0.0;          // estimate by the time of earlier rows
    double spent_s = 0.0, timed_s = 0.0;  // spent: in all; timed: part of it on rounds of times
    double rounds_timed = 0.0;            // finished rounds, plus the finished part of the next one
};

/// Estimates the time left, as in "about 40 s left". A round takes as long as the ones before. Before the first timed
/// row only a bound is known, "at most 17 min left": no round begins that would exceed `budget_s`.
std::string time_left(const SweepProgress& progress, std::uint32_t rounds, double budget_s);

}  // namespace gnomon::bench
