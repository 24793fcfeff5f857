#include "bench/check/check_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <span>

#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kMostFrames = 1000;
constexpr int kWell = 0, kNotWell = 1;

/// One line that moves on a terminal; elsewhere a line every half minute.
class ProgressLine {
public:
    ProgressLine() = default;
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() {
        if (shown_ && moves_) std::fputs("\r\033[K", stderr);
    }
    void show(const std::string& what, std::size_t done, std::size_t all) {
        const auto now = Clock::now();
        if (now - last_ < (moves_ ? kMove : kElsewhere)) return;
        last_ = now;
        shown_ = true;
        std::fprintf(stderr, moves_ ? "\r\033[K%s %zu of %zu" : "%s %zu of %zu\n", what.c_str(), done, all);
        std::fflush(stderr);
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr Clock::duration kMove = std::chrono::milliseconds(100), kElsewhere = std::chrono::seconds(30);
    const bool moves_ = isatty(STDERR_FILENO) == 1;
    bool shown_ = false;
    Clock::time_point last_ = Clock::now();
};

}  // namespace

void add_check_options(CLI::App& command, CheckCommand& check) {
    command.add_option("--json", check.json,
                       "write everything to this file, for reports; -: to "
                       "standard output instead");
    command.add_option("--rows", check.options.rows, "regular expression for rows' names (default: all)");
    command.add_option("--programs", check.options.programs, "regular expression for programs' names (default: all)");
    command
        .add_option("--set", check.options.settings,
                    "KEY=VALUE of every row's light, as the game's --set; "
                    "the truth stays as it is")
        ->allow_extra_args(false);
    command.add_option("--repeat", check.options.frames, "frames of each row that are timed; 0: none")
        ->check(CLI::Range(0u, kMostFrames))
        ->capture_default_str();
}

Result<int> run_check_command(const CheckCommand& command) {
    const bool to_stdout = command.json == "-";
    if (!command.json.empty() && !to_stdout)
        if (auto error = game::check_writable(command.json)) return *error;
    const auto check = [&] {
        ProgressLine line;
        CheckOptions options = command.options;
        options.progress = [&line](const std::string& what, std::size_t done, std::size_t all) {
            line.show(what, done, all);
        };
        return run_check(options);
    }();
    if (!check) return check.error();
    const std::string json = check_json(check.value());
    std::fputs(to_stdout ? json.c_str() : check_text(check.value()).c_str(), stdout);
    if (!command.json.empty() && !to_stdout)
        if (auto error = game::write_file(command.json, std::as_bytes(std::span(json)))) return *error;
    return is_well(check.value()) ? kWell : kNotWell;
}

}  // namespace gnomon::bench
