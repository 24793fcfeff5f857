#pragma once
#include <optional>
#include <string>

#include "bench/check/check.h"

namespace CLI {
class App;
}

namespace gnomon::bench {

struct CheckCommand {
    CheckOptions options;
    std::string json;  // file; "-": standard output, without the text; empty: none
};

void add_check_options(CLI::App& command, CheckCommand& check);

/// Runs the check, prints it and writes the file. Reports its progress on
/// standard error. Returns 0 if all is well, else 1. Errors: those of run_check(); "output.write".
Result<int> run_check_command(const CheckCommand& command);

}  // namespace gnomon::bench
