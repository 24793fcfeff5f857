#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/check/check_device.h"
#include "bench/check/check_first_frames.h"
#include "bench/check/check_programs.h"
#include "bench/check/check_rows.h"
#include "gnomon/result.h"

namespace gnomon::bench {

struct CheckOptions {
    std::string programs, rows;         // regular expressions for names; empty: all
    std::vector<std::string> settings;  // KEY=VALUE on top of every row's; the
                                        // truth is traced without them
    std::uint32_t frames = 5;           // timed per row, maps drawn again and kept; 0: none
    CheckProgress progress = [](const std::string&, std::size_t, std::size_t) {};
};

/// A machine's own proof that every program, light kind and filter is right
/// there, and what each costs.
struct Check {
    DeviceCheck device;
    ProgramChecks programs;
    RowChecks rows;
    FirstFrames first_frames;
    double took_s = 0.0;
};

/// Queries the device, compiles the programs, draws and judges the rows. Errors:
/// as Stage::open and trace_check_truths(); "set.*"; "check.pattern" for no
/// regular expression, or if no program and no row matches it.
Result<Check> run_check(const CheckOptions& options);

/// Returns whether nothing in the check failed.
bool is_well(const Check& check);
/// Returns the last line, without its end: "all is well here: ..." or "not all
/// is well here: ...".
std::string check_verdict(const Check& check);

/// Returns a text for people, at most 120 characters a line. It ends with
/// check_verdict().
std::string check_text(const Check& check);
/// Returns all results for reports and scripts: docs/reference/check.md lists the keys.
std::string check_json(const Check& check);

}  // namespace gnomon::bench
