#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/compare/evaluate_configuration.h"
#include "bench/compare/paired_times.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// One block of frames of a row in a round, and the base row's beside it, per light in the order of the truths.
struct TimedRow {
    std::string row;
    std::uint32_t round = 0;
    std::vector<LightTimes> times, base;
};

/// Results of a sweep so far, a line of JSON each. An interrupted sweep goes on from them. The first line is `header`,
/// which names the measurement, its subject and the device. A journal with another header starts from empty. A last
/// line that was cut short counts as not written.
class SweepJournal {
public:
    /// Opens or starts a journal. `header`: one line. Errors: "output.write".
    static Result<SweepJournal> open(const std::filesystem::path& file, const std::string& header);

    const std::vector<JudgedRow>& judged() const { return judged_; }
    const std::vector<TimedRow>& timed() const { return timed_; }
    double spent_s() const { return spent_s_; }  // time spent on all its results
    double timed_s() const { return timed_s_; }  // part of it that was spent on timing

    /// Adds a result. `spent_s`: time that it took. Errors: "output.write".
    std::optional<Error> add(const JudgedRow& row, double spent_s);
    std::optional<Error> add(const TimedRow& row, double spent_s);

private:
    explicit SweepJournal(std::filesystem::path file) : file_(std::move(file)) {}
    void take(const std::string& line);
    std::optional<Error> append(const std::string& line);

    std::filesystem::path file_;
    std::vector<JudgedRow> judged_;
    std::vector<TimedRow> timed_;
    double spent_s_ = 0.0, timed_s_ = 0.0;
};

}  // namespace gnomon::bench
