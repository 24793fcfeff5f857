#include <spdlog/sinks/stdout_sinks.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "sample_game/app/app.h"
#include "sample_game/support/settings/parse_number.h"

namespace {

using namespace gnomon;

constexpr int kBadInput = 2;

std::optional<Error> play(const game::CommandLine& line, spdlog::logger& log) {
    auto world = game::make_world(line);
    if (!world) return world.error();
    if (auto error = game::check_outputs(line)) return error;
    return line.headless ? game::run_headless(line, *world.value(), log) : game::run_window(line, *world.value(), log);
}

int run(int argc, const char* const* argv, spdlog::logger& log) {
    const Result<game::CommandLine> line = game::parse_command_line(argc, argv);
    if (!line) {
        log.error(game::on_one_line(to_line(line.error())));
        return kBadInput;
    }
    if (!line.value().print.empty()) {
        std::fputs(line.value().print.c_str(), stdout);
        return 0;
    }
    if (const auto error = play(line.value(), log)) {
        log.error(game::on_one_line(to_line(*error)));
        return kBadInput;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        spdlog::logger log("gnomon", std::make_shared<spdlog::sinks::stderr_sink_st>());
        log.set_pattern("%n: %l: %v");
        return run(argc, argv, log);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon: error: %s\n", game::on_one_line(error.what()).c_str());
        return kBadInput;
    }
}
