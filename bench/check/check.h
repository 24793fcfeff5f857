#pragma once
#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "bench/check/check_device.h"
#include "bench/check/check_programs.h"
#include "bench/check/check_rows.h"
#include "engine/core/result.h"

namespace gnomon::bench {

struct CheckOptions {
    std::string programs, rows;         // regular expressions for names; empty: all
    std::vector<std::string> settings;  // KEY=VALUE on top of every row's; the
                                        // truth is traced without them
    std::uint32_t frames = 5;           // of each row that are timed, maps drawn anew and kept; 0: none
    CheckProgress progress = [](const std::string&, std::size_t, std::size_t) {};
};

/// A machine's own proof that every program, light kind and filter is right
/// there, and what each costs.
struct Check {
    DeviceCheck device;
    ProgramChecks programs;
    RowChecks rows;
    double took_s = 0.0;
};

/// Asks the device, compiles the programs, draws and judges the rows. Errors:
/// those of Stage::open and trace_check_truths(); "check.pattern" for no
/// regular expression, or one that no program and no row has; "set.*".
Result<Check> run_check(const CheckOptions& options);

/// Nothing below is other than it should be.
bool is_well(const Check& check);
/// The last line, without its end: "all is well here: ..." or "not all is well
/// here: ...".
std::string check_verdict(const Check& check);

/// For people; at most 120 characters a line. Ends with check_verdict().
std::string check_text(const Check& check);
/// Everything, for reports and scripts: docs/check.md lists the keys.
std::string check_json(const Check& check);

}  // namespace gnomon::bench
