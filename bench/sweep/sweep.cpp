#include "bench/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/accuracy/reference_images.h"
#include "bench/common/pattern.h"
#include "bench/compare/crop_images.h"
#include "bench/compare/paired_times.h"
#include "bench/sweep/progress.h"
#include "bench/sweep/resume_log.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// Version of the meaning of a journal's lines.
constexpr int kJournalVersion = 1;
/// Rows that share one block of the defaults: a fifth of the time goes into the base of all comparisons.
constexpr std::size_t kRowsPerBase = 4;
/// Rows that are timed between two lines of progress.
constexpr std::size_t kRowsPerLine = 16;
/// Frames of each kind in a block. On software devices a frame takes so long that one is as good as its neighbours.
constexpr std::uint32_t kSoftwareFrames = 1, kDeviceFrames = 15;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

LightKinds kinds_of(const TracedTruths& truths) {
    LightKinds kinds = 0;
    for (const TracedLight& light : truths.lights) kinds |= only(light.kind);
    return kinds;
}

/// Returns size and time of a file. Another program, or another scene of the same name, makes another journal.
Json stamp_of(const std::filesystem::path& file) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(file, error);
    if (error) return nullptr;
    return {bytes, std::filesystem::last_write_time(file, error).time_since_epoch().count()};
}

/// Returns the defaults, and rows with names that match. Errors: "rows.regex".
Result<std::vector<SweepRow>> chosen(std::vector<SweepRow> plan, const std::string& only) {
    const Pattern wanted(only);
    if (!wanted.is_valid()) return Error{"'" + only + "' is no regular expression", "", "", "rows.regex"};
    std::erase_if(plan, [&](const SweepRow& row) { return row.name != kDefaultsRow && !wanted.matches(row.name); });
    return plan;
}

std::string header_of(const Stage& stage, const std::string& device, const std::vector<SweepRow>& plan,
                      std::uint32_t frames, const SweepOptions& sweep) {
    const StageOptions& options = stage.options();
    Json rows = Json::array();
    for (const SweepRow& row : plan) rows.push_back({row.name, row.settings, row.kinds});
    const Json header{{"journal", kJournalVersion},
                      {"program", stamp_of("/proc/self/exe")},
                      {"device", device},
                      {"scene", stage.scene_name()},
                      {"file", options.scene ? stamp_of(*options.scene) : Json(nullptr)},
                      {"camera", options.camera.value_or("")},
                      {"size_px", {options.size_px.x, options.size_px.y}},
                      {"time_s", options.time_s},
                      {"offset_m", {options.offset_m.x, options.offset_m.y, options.offset_m.z}},
                      {"settings", options.settings},
                      {"frames", frames},
                      {"disks", sweep.disks},
                      {"area_side", sweep.area_side},
                      {"plan", rows}};
    return header.dump(-1, ' ', false, Json::error_handler_t::replace);
}

class Sweeper {
public:
    Sweeper(Stage& stage, const SweepOptions& options, const TracedTruths& truths, std::vector<SweepRow> plan,
            RowPictures pictures, SweepJournal journal)
        : stage_(stage),
          options_(options),
          truths_(truths),
          plan_(std::move(plan)),
          pictures_(std::move(pictures)),
          journal_(std::move(journal)) {}

    std::optional<Error> judge_all() {
        std::set<std::string> done;
        for (const JudgedRow& row : journal_.judged()) done.insert(row.name);
        if (!done.empty()) say(std::to_string(done.size()) + " rows are taken from an earlier run");
        const auto start = Clock::now();
        const std::size_t before = done.size();
        for (std::size_t i = 0; i < plan_.size(); ++i) {
            if (!done.insert(plan_[i].name).second) continue;
            const auto row_start = Clock::now();
            const JudgedRow row = judge(i);
            if (picture_error_) return picture_error_;
            if (auto error = journal_.add(row, seconds_since(row_start))) return error;
            const double each_s = seconds_since(start) / static_cast<double>(done.size() - before);
            const double left_s = each_s * static_cast<double>(plan_.size() - done.size());
            say("row " + std::to_string(done.size()) + " of " + std::to_string(plan_.size()) + ": " + plan_[i].name +
                (row.error ? ": FAILED: " + *row.error : std::string()) + left(left_s, 0.0));
        }
        return std::nullopt;
    }

    std::optional<Error> time_all(const BlockOptions& block) {
        for (std::uint32_t round = 0; round < options_.rounds && !is_spent(round); ++round) {
            if (auto error = time_round(round, block)) return error;
        }
        return std::nullopt;
    }

    /// Copies the journal's results in the plan's order.
    void collect(SceneSweep& sweep) && {
        std::map<std::string, std::vector<RatioRounds>> times;
        std::map<std::string, std::uint32_t> rounds;
        for (const TimedRow& timed : journal_.timed()) {
            auto& lights = times[timed.row];
            lights.resize(truths_.lights.size());
            ++rounds[timed.row];
            for (std::size_t k = 0; k < std::min(lights.size(), timed.times.size()); ++k)
                lights[k].add(timed.times[k], timed.base[k]);
        }
        sweep.rounds = options_.rounds;
        for (const SweepRow& row : plan_) {
            const auto found = std::find_if(journal_.judged().begin(), journal_.judged().end(),
                                            [&](const JudgedRow& judged) { return judged.name == row.name; });
            JudgedRow& judged = sweep.rows.emplace_back(*found);
            if (judged.error) continue;
            sweep.rounds = std::min(sweep.rounds, rounds[row.name]);
            for (std::size_t k = 0; k < truths_.lights.size() && times.contains(row.name); ++k)
                for (LightRow& light : judged.lights)
                    if (light.light == truths_.lights[k].name) times[row.name][k].put_into(light.figures);
        }
        sweep.spent_s = journal_.spent_s();
        sweep.plan = std::move(plan_);
    }

private:
    void say(const std::string& line) const { options_.progress(line); }

    std::string left(double judging_s, double rounds_timed) const {
        return "; " + time_left({judging_s, journal_.spent_s(), journal_.timed_s(), rounds_timed}, options_.rounds,
                                options_.budget_s);
    }

    /// Returns whether another round, as long as the ones before, would exceed the budget. The first round always runs.
    bool is_spent(std::uint32_t round) const {
        return round > 0 && journal_.spent_s() + journal_.timed_s() / round > options_.budget_s;
    }

    JudgedRow judge(std::size_t i) {
        std::vector<std::uint8_t> rgba;
        JudgeOptions options;
        options.on_measured = [&](const TracedLight& light, const std::vector<float>& measured) {
            if (rgba.empty()) (void)stage_.frame().read_picture(rgba);
            const ShadowFilter filter = stage_.frame().snapshot().lights[light.index].shadow.filter;
            const bool by_disk =
                shadow::filter_row(filter).width == shadow::FilterWidth::source && !light.disk.visibility.empty();
            if (auto error = pictures_.write(RowPictures::stem(i, light.name), light, measured, rgba, by_disk))
                picture_error_ = error;
        };
        return judge_row(stage_, truths_, plan_[i], options);
    }

    bool failed(const SweepRow& row) const {
        return std::any_of(journal_.judged().begin(), journal_.judged().end(),
                           [&](const JudgedRow& judged) { return judged.name == row.name && judged.error; });
    }

    std::optional<Error> time_round(std::uint32_t round, const BlockOptions& block) {
        std::set<std::string> done;
        for (const TimedRow& timed : journal_.timed())
            if (timed.round == round) done.insert(timed.row);
        std::vector<const SweepRow*> open;
        for (const SweepRow& row : plan_)
            if (!done.contains(row.name) && !failed(row)) open.push_back(&row);
        std::vector<LightTimes> base;
        for (std::size_t i = 0; i < open.size() && !is_spent(round); ++i) {
            const auto start = Clock::now();
            if (i % kRowsPerLine == 0) {
                const std::size_t row = done.size() + i, rows = done.size() + open.size();
                say("times, round " + std::to_string(round + 1) + ", row " + std::to_string(row + 1) + " of " +
                    std::to_string(rows) + left(0.0, round + static_cast<double>(row) / static_cast<double>(rows)));
            }
            if (i % kRowsPerBase == 0) base = time_block(stage_, truths_.indices(), plan_.front(), block);
            const TimedRow timed{open[i]->name, round, time_block(stage_, truths_.indices(), *open[i], block), base};
            if (auto error = journal_.add(timed, seconds_since(start))) return error;
        }
        return std::nullopt;
    }

    Stage& stage_;
    const SweepOptions& options_;
    const TracedTruths& truths_;
    std::vector<SweepRow> plan_;
    RowPictures pictures_;
    SweepJournal journal_;
    std::optional<Error> picture_error_;
};

}  // namespace

Result<SceneSweep> measure_sweep(Stage& stage, const SweepOptions& options) {
    SceneSweep sweep;
    sweep.scene = stage.scene_name();
    sweep.device = stage.device().info().name;
    options.progress("tracing the truth of " + sweep.scene);
    const auto truths = trace_truths(stage, {options.disks, options.area_side});
    if (!truths) return truths.error();
    sweep.camera = stage.frame().snapshot().consumers.front().name;
    sweep.size_px = truths.value().hits.size_px;
    sweep.trace_s = truths.value().trace_s;
    auto planned =
        chosen(options.plan.empty() ? sweep_plan(options.size, kinds_of(truths.value())) : options.plan, options.only);
    if (!planned) return planned.error();
    const std::vector<SweepRow> plan = std::move(planned).value();
    const bool software = stage.device().info().is_software;
    const std::uint32_t frames = options.frames > 0 ? options.frames : software ? kSoftwareFrames : kDeviceFrames;
    auto pictures = RowPictures::make(options.folder / "pictures", truths.value());
    if (!pictures) return pictures.error();
    auto journal =
        SweepJournal::open(options.folder / "journal.jsonl", header_of(stage, sweep.device, plan, frames, options));
    if (!journal) return journal.error();
    Sweeper sweeper(stage, options, truths.value(), plan, std::move(pictures).value(), std::move(journal).value());
    if (auto error = sweeper.judge_all()) return *error;
    if (auto error = sweeper.time_all(block_options(stage.device().info(), frames))) return *error;
    std::move(sweeper).collect(sweep);
    sweep.gl_complaints = stage.gl_complaints();
    return sweep;
}

}  // namespace gnomon::bench
