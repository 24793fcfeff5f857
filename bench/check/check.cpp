#include "bench/check/check.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "bench/check/check_scene.h"
#include "bench/common/pattern.h"
#include "bench/text/printf_string.h"
#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "sample_game/support/settings/light_settings.h"

namespace gnomon::bench {
namespace {

// Every shadow is some pixels wide, and the slowest rows take a second or two
// on a processor.
constexpr glm::uvec2 kPicture_px{192, 108};
// 64 frames miss a fault of one frame in twenty with a probability of 4 %: 0.95^63. Software draws in order.
constexpr std::uint32_t kFirstFrames = 64, kFirstFramesInSoftware = 4;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Leaves out what has no part that matches; empty matches all. Returns how many were left out.
template <class Item, class Name>
Result<std::size_t> select(std::vector<Item>& items, const std::string& text, const char* what, Name name) {
    const Pattern wanted(text);
    if (!wanted.is_valid()) return Error{"'" + text + "' is no regular expression", "", "", "check.pattern"};
    const std::size_t left_out = std::erase_if(items, [&](const Item& item) { return !wanted.matches(name(item)); });
    if (items.empty() && left_out > 0)
        return Error{std::string("no ") + what + " has a part that matches '" + text + "'", "", "", "check.pattern"};
    return left_out;
}

/// In a context of their own, so that what they say of themselves is there
/// whatever becomes of a frame.
struct OwnDevice {
    std::unique_ptr<platform::Context> context;
    std::unique_ptr<gl::Device> device;  // before its context goes
};
Result<OwnDevice> make_own_device() {
    auto context = platform::make_headless_context(false);
    if (!context) return context.error();
    auto device = gl::make_gl45_device({});
    if (!device) return device.error();
    return OwnDevice{std::move(context).value(), std::move(device).value()};
}

// Drivers compile on every thread with a context. Beyond some number the
// threads block each other.
constexpr unsigned kMostThreads = 8;

std::optional<Error> check_device_and_programs(std::span<const gl::ProgramDesc> programs, const CheckOptions& options,
                                               Check& check) {
    const auto own = make_own_device();
    if (!own) return own.error();
    gl::Device& device = *own.value().device;
    check.device = check_device(gl::read_device_facts(), device.info());
    const OtherDevice other = [](const auto& use) {
        if (const auto made = make_own_device()) use(*made.value().device);
    };
    const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1u, kMostThreads);
    const std::size_t left_out = check.programs.left_out;
    check.programs = compile_programs(device, programs, options.progress, threads - 1, other);
    check.programs.left_out = left_out;
    return std::nullopt;
}

std::optional<Error> check_frames(std::span<const CheckRowSetup> setups, const CheckOptions& options, Check& check) {
    RowChecks& rows = check.rows;
    StageOptions stage_options;
    stage_options.scene = "check";
    stage_options.size_px = kPicture_px;
    const auto stage = Stage::open(stage_options, check_scene());
    if (!stage) return stage.error();
    const auto start = Clock::now();
    options.progress("truth", 0, 1);
    const auto truths = trace_check_truths(*stage.value(), setups);
    if (!truths) return truths.error();
    rows.size_px = truths.value().hits.size_px;
    rows.trace_s = seconds_since(start);
    for (std::size_t i = 0; i < setups.size(); ++i) {
        options.progress("rows", i, setups.size());
        rows.rows.push_back(check_row(*stage.value(), truths.value(), setups[i], {options.settings, options.frames}));
    }
    if (auto error = stage.value()->start_over({})) return error;
    const bool software = stage.value()->device().info().is_software;
    check.first_frames =
        check_first_frames(*stage.value(), software ? kFirstFramesInSoftware : kFirstFrames, options.progress);
    return std::nullopt;
}

}  // namespace

Result<Check> run_check(const CheckOptions& options) {
    const auto start = Clock::now();
    Check check;
    std::vector<gl::ProgramDesc> programs = check_programs();
    std::vector<CheckRowSetup> setups = check_row_setups();
    const auto without = select(programs, options.programs, "program", [](const auto& p) { return p.label; });
    if (!without) return without.error();
    const auto rows_without = select(setups, options.rows, "row", [](const auto& row) { return row.name; });
    if (!rows_without) return rows_without.error();
    check.programs.left_out = without.value();
    check.rows.left_out = rows_without.value();
    game::LightSettings probe;
    for (const std::string& setting : options.settings)
        if (auto error = game::apply_setting(probe, setting)) return *error;
    if (auto error = check_device_and_programs(programs, options, check)) return *error;
    const auto rows_start = Clock::now();
    try {
        if (const auto error = check_frames(setups, options, check)) check.rows.error = to_line(*error);
    } catch (const FailedFrame& frame) {
        check.rows.error = frame.what();
    }
    check.rows.took_s = seconds_since(rows_start);
    check.took_s = seconds_since(start);
    return check;
}

bool is_well(const Check& check) {
    const bool rows = std::none_of(check.rows.rows.begin(), check.rows.rows.end(),
                                   [](const CheckRow& row) { return row.verdict == CheckVerdict::failed; });
    return check.device.short_of.empty() && check.programs.failed.empty() && check.rows.error.empty() &&
           !check.rows.rows.empty() && rows && check.first_frames.well();
}

std::string check_verdict(const Check& check) {
    const auto of = [](std::size_t some, std::size_t left_out) {
        return left_out > 0 ? formatted("%zu of %zu", some, some + left_out) : formatted("%zu", some);
    };
    const auto judged =
        static_cast<std::size_t>(std::count_if(check.rows.rows.begin(), check.rows.rows.end(), [](const CheckRow& row) {
            return row.verdict != CheckVerdict::not_judged;
        }));
    const auto failed =
        static_cast<std::size_t>(std::count_if(check.rows.rows.begin(), check.rows.rows.end(), [](const CheckRow& row) {
            return row.verdict == CheckVerdict::failed;
        }));
    const std::string done = of(check.programs.all, check.programs.left_out) + " programs, " +
                             of(judged, check.rows.left_out + check.rows.rows.size() - judged) + " rows";
    if (is_well(check)) return "all is well here: " + done;
    std::string text = "not all is well here: ";
    if (!check.device.short_of.empty()) text += formatted("%zu limits too low, ", check.device.short_of.size());
    if (!check.programs.failed.empty()) text += formatted("%zu programs failed, ", check.programs.failed.size());
    if (failed > 0) text += formatted("%zu rows failed, ", failed);
    if (!check.rows.error.empty())
        text += "no rows could be drawn, ";
    else if (!check.first_frames.well())
        text += formatted("%u of %u first frames differ, ", check.first_frames.differ, check.first_frames.drawn);
    return text + "of " + done;
}

}  // namespace gnomon::bench
