#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>

#include "bench/accuracy/accuracy.h"
#include "bench/accuracy/error_images.h"
#include "bench/accuracy/stated_accuracy.h"
#include "bench/audit/audit_command.h"
#include "bench/common/arguments.h"
#include "bench/common/stage.h"
#include "bench/compare/filter_comparison.h"
#include "bench/compare/filter_gallery.h"
#include "bench/cost_model/calibrate.h"
#include "bench/culling/culling.h"
#include "bench/culling/culling_efficiency.h"
#include "bench/draws/draw_costs.h"
#include "bench/embed/embed_costs.h"
#include "bench/embed/host_engine.h"
#include "bench/fit_drawings/fit_drawings.h"
#include "bench/flicker/edge_flicker.h"
#include "bench/flicker/flicker.h"
#include "bench/frame/frame_compare.h"
#include "bench/frame/frame_times.h"
#include "bench/judge/judge_pictures.h"
#include "bench/pictures/edges.h"
#include "bench/pictures/strip.h"
#include "bench/queries/queries.h"
#include "bench/scaling/light_count.h"
#include "bench/scaling/redraws.h"
#include "bench/sweep/sweep_command.h"
#include "bench/text/replace_doc_section.h"
#include "bench/text/wrap_lines.h"
#include "sample_game/support/files/image_files.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::bench {
namespace {

constexpr int kNotSound = 1, kBadInput = 2;
constexpr glm::uvec2 kQuickSize_px{640, 360}, kSmallEmbed_px{320, 180};
constexpr std::uint32_t kQuickEmbedRounds = 3;

int fail(const Error& error) {
    std::fprintf(stderr, "gnomon_bench: %s\n", game::on_one_line(to_line(error)).c_str());
    return kBadInput;
}

/// Prints a text so that it fits into a terminal.
void print(const std::string& text) { std::fputs(wrapped(text).c_str(), stdout); }

std::optional<Error> put_out(const Arguments& arguments, const std::string& table, const std::string& json) {
    print(table);
    if (arguments.json.empty()) return std::nullopt;
    return game::write_file(arguments.json, std::as_bytes(std::span(json)));
}

/// Prints the table of a measurement. Returns the exit status.
int put_table(const Result<std::string>& table) {
    if (!table) return fail(table.error());
    print(table.value());
    return 0;
}

/// Writes a text into its marked part of the page that --markdown names; without a page does nothing.
std::optional<Error> put_marked(const Arguments& arguments, const char* part, const std::string& text) {
    return arguments.markdown.empty() ? std::nullopt : replace_marked(arguments.markdown, part, text);
}

int run_rows(Stage& stage, const Arguments& arguments) {
    FilterRowsOptions options;
    if (arguments.rows != "all") options.only = arguments.rows;
    options.rounds = arguments.rounds;
    options.frames = arguments.repeat;
    const auto rows = measure_filter_rows(stage, options);
    if (!rows) return fail(rows.error());
    if (auto error = put_out(arguments, filter_rows_table(rows.value()), filter_rows_json(rows.value())))
        return fail(*error);
    if (auto error = put_marked(arguments, "rows", filter_rows_markdown(rows.value()))) return fail(*error);
    return 0;
}

int run_sweeps(const Arguments& arguments) {
    SweepCommand command;
    command.size = arguments.sweep == "quick" ? SweepSize::quick : SweepSize::full;
    command.stage = arguments.stage;
    command.scenes.assign(arguments.scenes.begin(), arguments.scenes.end());
    command.folder = arguments.out;
    command.only = arguments.sweep_rows;
    if (!arguments.size_given && command.size == SweepSize::quick) command.stage.size_px = kQuickSize_px;
    if (arguments.rounds_given) command.rounds = arguments.rounds;
    if (arguments.repeat_given) command.frames = arguments.repeat;
    command.area_side = arguments.area_side;
    if (auto error = run_sweep(command)) return fail(*error);
    std::printf("%s: bench/sweep/report.py makes the page and the tables of it\n",
                (command.folder / "report.json").c_str());
    return 0;
}

int run_accuracy(const Arguments& arguments) {
    if (!arguments.sweep.empty()) return run_sweeps(arguments);
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (!arguments.rows.empty()) return run_rows(*stage.value(), arguments);
    const auto accuracy = measure_accuracy(*stage.value(), {.timed_frames = arguments.repeat,
                                                            .with_edges = true,
                                                            .area_side = arguments.area_side,
                                                            .noise_rounds = arguments.noise_rounds});
    if (!accuracy) return fail(accuracy.error());
    if (auto error = put_out(arguments, accuracy_table(accuracy.value()), accuracy_json(accuracy.value())))
        return fail(*error);
    if (!arguments.pictures.empty())
        if (auto error = write_heat_pictures(accuracy.value(), arguments.pictures)) return fail(*error);
    const auto& lights = accuracy.value().lights;
    return std::none_of(lights.begin(), lights.end(), fails_bench) ? 0 : kNotSound;
}

int run_audits(const Arguments& arguments) {
    AuditCommand command;
    command.stage = arguments.stage;
    command.scenes.assign(arguments.scenes.begin(), arguments.scenes.end());
    command.on_audit = [](const Audit& audit) { print(audit_table(audit)); };
    const auto audits = run_audit(command);
    if (!audits) return fail(audits.error());
    if (auto error = put_out(arguments, audit_summary(audits.value()), audit_json(audits.value()))) return fail(*error);
    return std::all_of(audits.value().begin(), audits.value().end(), is_sound) ? 0 : kNotSound;
}

int run_against(Stage& stage, const Arguments& arguments) {
    const auto times = measure_frames_against(stage, arguments.against, arguments.rounds, arguments.repeat);
    if (!times) return fail(times.error());
    if (auto error = put_out(arguments, frames_against_table(times.value()), frames_against_json(times.value())))
        return fail(*error);
    return 0;
}

int run_frame(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (!arguments.against.empty()) return run_against(*stage.value(), arguments);
    const FrameTimes times = measure_frame_times(*stage.value(), arguments.rounds, arguments.repeat);
    if (auto error = put_out(arguments, frame_times_table(times), frame_times_json(times))) return fail(*error);
    return 0;
}

int run_edge_flicker(Stage& stage, const Arguments& arguments) {
    EdgeFlickerOptions options;
    if (arguments.frames_given) options.frames = arguments.stability.frames;
    if (arguments.points_given) options.points = arguments.stability.points;
    options.step_px = arguments.step_px;
    options.area_side = arguments.area_side;
    options.paths = arguments.stability.paths;
    const auto flickers = measure_edge_flicker(stage, options);
    if (!flickers) return fail(flickers.error());
    if (auto error = put_out(arguments, edge_flicker_table(flickers.value()), edge_flicker_json(flickers.value())))
        return fail(*error);
    return 0;
}

int run_stability(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (arguments.area_side > 0) return run_edge_flicker(*stage.value(), arguments);
    const auto stability = measure_stability(*stage.value(), arguments.stability);
    if (!stability) return fail(stability.error());
    if (auto error = put_out(arguments, stability_table(stability.value()), stability_json(stability.value())))
        return fail(*error);
    if (arguments.plot.empty()) return 0;
    const std::string plot = stability_plot(stability.value());
    if (auto error = game::write_file(arguments.plot, std::as_bytes(std::span(plot)))) return fail(*error);
    return 0;
}

int run_drawings(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (auto error = game::make_writable_folder(arguments.drawings)) return fail(*error);
    if (auto error = write_drawings(*stage.value(), arguments.drawings)) return fail(*error);
    return 0;
}

int run_queries(const Arguments& arguments) {
    QueriesOptions options = arguments.queries;
    options.repeat = arguments.repeat;
    return put_table(measure_queries(arguments.stage, options));
}

int run_embed(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (!arguments.size_given && stage.value()->device().info().is_software) stage.value()->set_size(kSmallEmbed_px);
    EmbedOptions options = arguments.embed;
    options.settings = arguments.stage.settings;
    if (options.quick && !arguments.lights_given) options.lights = {1, kMostHostLights};
    if (options.quick && !arguments.rounds_given) options.rounds = kQuickEmbedRounds;
    const auto costs = measure_embed(*stage.value(), options);
    if (!costs) return fail(costs.error());
    if (auto error = put_out(arguments, embed_table(costs.value()), embed_json(costs.value()))) return fail(*error);
    return 0;
}

int run_filters(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    FilterPicturesOptions options;
    options.only = arguments.filter;
    const auto found = write_filter_pictures(*stage.value(), arguments.filters, options);
    if (!found) return fail(found.error());
    const FilterPictures& pictures = found.value();
    print(pictures.point_figures + "\n" + pictures.disk_figures);
    if (arguments.markdown.empty()) return 0;
    const std::filesystem::path page = arguments.markdown;
    const std::string folder = std::filesystem::proximate(arguments.filters, page.parent_path()).generic_string();
    const std::pair<const char*, std::string> parts[] = {{"pictures", picture_table(pictures.point, folder)},
                                                         {"pictures of a disk", picture_table(pictures.disk, folder)},
                                                         {"figures", pictures.point_figures},
                                                         {"figures of a disk", pictures.disk_figures}};
    for (const auto& [name, text] : parts)
        if (auto error = replace_marked(page, name, text)) return fail(*error);
    return 0;
}

int run_pictures(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    const auto strip = make_strip(*stage.value());
    if (!strip) return fail(strip.error());
    if (auto error = write_strip(strip.value(), arguments.plot)) return fail(*error);
    const std::string table = strip_table(strip.value());
    if (auto error = put_out(arguments, table, strip_json(strip.value()))) return fail(*error);
    if (auto error = put_marked(arguments, "strip", table)) return fail(*error);
    return 0;
}

int run_judge(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    const auto judged = judge_pictures(*stage.value(), {arguments.visibility, arguments.area_side, arguments.beside});
    if (!judged) return fail(judged.error());
    if (auto error = put_out(arguments, judge_table(judged.value()), judge_json(judged.value()))) return fail(*error);
    return 0;
}

int run_edges(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    const auto edges = make_edges(*stage.value());
    if (!edges) return fail(edges.error());
    if (auto error = write_edges(edges.value(), arguments.plot)) return fail(*error);
    print(edges_table(edges.value()));
    return 0;
}

int run_redraws(const Arguments& arguments) {
    const auto table = redraws_table(arguments.stage, arguments.stability.frames);
    if (!table) return put_table(table);
    if (auto error = put_marked(arguments, "redraws", table.value())) return fail(*error);
    return put_table(table);
}

int run_demand(const Arguments& arguments) {
    const auto demand = measure_demand(arguments.demand);
    if (!demand) return fail(demand.error());
    const std::string table = demand_markdown(demand.value());
    if (auto error = put_out(arguments, table, demand_json(demand.value()))) return fail(*error);
    if (auto error = put_marked(arguments, "demand", table)) return fail(*error);
    if (arguments.plot.empty()) return 0;
    const std::string plot = demand_plot(demand.value());
    if (auto error = game::write_file(arguments.plot, std::as_bytes(std::span(plot)))) return fail(*error);
    return 0;
}

int run_budget_speeds(const Arguments& arguments) {
    const auto speeds = measure_budget_speeds(arguments.speeds);
    if (!speeds) return fail(speeds.error());
    const std::string table = budget_speeds_markdown(speeds.value());
    print(table);
    if (auto error = put_marked(arguments, "speeds", table)) return fail(*error);
    return 0;
}

int run_draws(const Arguments& arguments) {
    const auto costs = measure_draw_costs(arguments.draws);
    if (!costs) return fail(costs.error());
    if (auto error = put_out(arguments, draw_costs_markdown(costs.value()), draw_costs_json(costs.value())))
        return fail(*error);
    return 0;
}

int run_set_shares(const Arguments& arguments) { return put_table(set_shares(arguments.stage)); }

int run_checks(const Arguments& arguments) {
    const auto code = run_check_command(arguments.check);
    return code ? code.value() : fail(code.error());
}

int run_culling_benchmarks(const Arguments& arguments) {
    run_culling(arguments.filter);
    return 0;
}

struct Command {
    const char* name;
    const char* words;
    AddOptions* add_options;
    int (*run)(const Arguments&);
};
constexpr Command kCommands[] = {
    {"check", "what this device is, whether every program and row is right on it, what each costs", add_check,
     run_checks},
    {"accuracy", "shadows of each light against ray-traced truth", add_accuracy, run_accuracy},
    {"audit", "the truth itself: rays asked in two ways, and the triangles that they and the picture show", add_audit,
     run_audits},
    {"frame", "frame times with and without shadows, or of two ways to cast them", add_frame, run_frame},
    {"stability", "how shadows flicker while only the camera moves", add_stability, run_stability},
    {"drawings", "how the maps of each fit lie, as SVG files", add_drawings, run_drawings},
    {"filters", "every filter on one scene beside the truth: taps, error", add_filters, run_filters},
    {"pictures", "one view with a tutorial's shadow map, with Gnomon and by rays: a strip, wrong pixels in red",
     add_pictures, run_pictures},
    {"judge", "shadows that another renderer drew against ray-traced truth", add_judge, run_judge},
    {"edges", "one view with one sample per pixel, smoothed, and with 64: a part at 200 %, and how far they are apart",
     add_edges, run_edges},
    {"culling", "what finding receivers and casters and fitting to them costs", add_culling, run_culling_benchmarks},
    {"demand", "what shadows cost by the number of lights, economy on and off", add_demand, run_demand},
    {"budget", "what a unit of each kind of work takes that budgets reckon with", add_budget, run_budget_speeds},
    {"draws", "what depth passes of many meshes cost the processor, a command for each and one for all", add_draws,
     run_draws},
    {"redraws", "how many maps are drawn while a camera walks or a thing moves", add_redraws, run_redraws},
    {"sets", "how many casters each light keeps, and how many of those in vain", add_common, run_set_shares},
    {"queries", "visibility queries on the CPU: how many per second, and their trees", add_queries, run_queries},
    {"embed", "masks and lookups of gnomon::Shadows against Gnomon's own light passes", add_embed, run_embed},
};

int run(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("What Gnomon's shadows cost, and how far they are from the truth", "gnomon_bench");
    app.require_subcommand(1);
    for (const Command& command : kCommands)
        command.add_options(*app.add_subcommand(command.name, command.words), arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        return fail({error.what(), "", "", "usage"});
    }
    const CLI::App& chosen = *app.get_subcommands().front();
    const auto is_given = [&](const char* name) {
        const CLI::Option* option = chosen.get_option_no_throw(name);
        return option && option->count() > 0;
    };
    arguments.rounds_given = is_given("--rounds");
    arguments.repeat_given = is_given("--repeat");
    arguments.size_given = is_given("--size");
    arguments.lights_given = is_given("--lights");
    arguments.frames_given = is_given("--frames");
    arguments.points_given = is_given("--points");
    arguments.audit = chosen.get_name() == "audit";
    if (auto error = complete(arguments)) return fail(*error);
    const auto* command = std::find_if(std::begin(kCommands), std::end(kCommands),
                                       [&](const Command& c) { return chosen.get_name() == c.name; });
    try {
        return command->run(arguments);
    } catch (const FailedFrame& frame) {
        return fail(frame.error);
    }
}

}  // namespace
}  // namespace gnomon::bench

int main(int argc, char** argv) { return gnomon::bench::run(argc, argv); }
