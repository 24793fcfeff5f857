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

/// Runs it, prints it, writes the file; says on standard error how far it is.
/// 0: all is well; 1: not all is. Errors: those of run_check(); "output.write".
Result<int> run_check_command(const CheckCommand& command);

}  // namespace gnomon::bench
