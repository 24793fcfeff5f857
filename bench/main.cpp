#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <span>

#include "bench/accuracy.h"
#include "bench/audit_command.h"
#include "bench/budget_speeds.h"
#include "bench/culling.h"
#include "bench/demand.h"
#include "bench/drawings.h"
#include "bench/filter_rows.h"
#include "bench/filters.h"
#include "bench/frame_times.h"
#include "bench/heat_pictures.h"
#include "bench/marked_text.h"
#include "bench/queries.h"
#include "bench/redraws.h"
#include "bench/set_shares.h"
#include "bench/size_and_place.h"
#include "bench/stability.h"
#include "bench/stage.h"
#include "bench/sweep_command.h"
#include "sample_game/number_text.h"
#include "sample_game/picture_files.h"

namespace gnomon::bench {
namespace {

constexpr int kNotSound = 1, kBadInput = 2;
constexpr glm::uvec2 kQuickSize_px{640, 360};
constexpr std::uint32_t kMaxRepeats = 100000;
constexpr std::uint32_t kMostLights = 100000;
constexpr std::uint32_t kMaxPoints = 10000000;
constexpr unsigned kMostThreads = 1024;

struct Arguments {
    StageOptions stage;
    std::vector<std::string> scenes;
    std::string camera, size = "1280x720", demand_size = "320x180", offset, json, pictures, filter;
    std::uint32_t repeat = 9, rounds = 5;
    StabilityOptions stability;
    std::string plot, drawings, filters, rows, markdown;
    DemandOptions demand;
    SpeedOptions speeds;
    QueriesOptions queries;
    std::string sweep, sweep_rows;
    bool quick = false, audit = false;
    std::string out = "gnomon_sweep";
    bool rounds_given = false, repeat_given = false, size_given = false;
};

int fail(const Error& error) {
    std::fprintf(stderr, "gnomon_bench: %s\n", game::on_one_line(to_line(error)).c_str());
    return kBadInput;
}

std::optional<Error> complete(Arguments& arguments) {
    if (arguments.quick) arguments.sweep = "quick";
    if (arguments.scenes.size() > 1 && arguments.sweep.empty() && !arguments.audit)
        return Error{"several scenes are for accuracy --sweep and audit alone", "", "", "scene"};
    if (!arguments.scenes.empty()) arguments.stage.scene = arguments.scenes.front();
    if (!arguments.camera.empty()) arguments.stage.camera = arguments.camera;
    for (const auto& [text, size_px] : {std::pair(&arguments.size, &arguments.stage.size_px),
                                        std::pair(&arguments.demand_size, &arguments.demand.size_px)}) {
        const auto size = parse_size(*text);
        if (!size) return Error{"--size wants WIDTHxHEIGHT, each 1 to 16384, not '" + *text + "'", "", "", "size"};
        *size_px = *size;
    }
    const auto offset = parse_offset(arguments.offset);
    if (!offset) return Error{"--offset wants X,Y,Z in metres, not '" + arguments.offset + "'", "", "", "offset"};
    arguments.stage.offset_m = *offset;
    if (!std::isfinite(arguments.stage.time_s)) return Error{"--time wants a finite number", "", "", "time"};
    return std::nullopt;
}

std::optional<Error> put_out(const Arguments& arguments, const std::string& table, const std::string& json) {
    std::fputs(table.c_str(), stdout);
    if (arguments.json.empty()) return std::nullopt;
    return game::write_file(arguments.json, std::as_bytes(std::span(json)));
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
    if (!arguments.markdown.empty())
        if (auto error = replace_marked(arguments.markdown, "rows", filter_rows_markdown(rows.value())))
            return fail(*error);
    return 0;
}

int run_sweeps(const Arguments& arguments) {
    SweepCommand command;
    command.size = arguments.sweep == "quick" ? SweepSize::quick : SweepSize::full;
    command.stage = arguments.stage;
    command.scenes.assign(arguments.scenes.begin(), arguments.scenes.end());
    command.folder = arguments.out;
    command.only = arguments.sweep_rows;
    command.markdown = arguments.markdown;
    if (!arguments.size_given && command.size == SweepSize::quick) command.stage.size_px = kQuickSize_px;
    if (arguments.rounds_given) command.rounds = arguments.rounds;
    if (arguments.repeat_given) command.frames = arguments.repeat;
    const auto scenes = run_sweep(command);
    if (!scenes) return fail(scenes.error());
    std::fputs(sweep_summary(scenes.value()).c_str(), stdout);
    std::printf("%s\n", (command.folder / "report.html").c_str());
    return 0;
}

int run_accuracy(const Arguments& arguments) {
    if (!arguments.sweep.empty()) return run_sweeps(arguments);
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    if (!arguments.rows.empty()) return run_rows(*stage.value(), arguments);
    const auto accuracy = measure_accuracy(*stage.value(), {arguments.repeat});
    if (!accuracy) return fail(accuracy.error());
    if (auto error = put_out(arguments, accuracy_table(accuracy.value()), accuracy_json(accuracy.value())))
        return fail(*error);
    if (!arguments.pictures.empty())
        if (auto error = write_heat_pictures(accuracy.value(), arguments.pictures)) return fail(*error);
    return 0;
}

int run_audits(const Arguments& arguments) {
    AuditCommand command;
    command.stage = arguments.stage;
    command.scenes.assign(arguments.scenes.begin(), arguments.scenes.end());
    command.on_audit = [](const Audit& audit) { std::fputs(audit_table(audit).c_str(), stdout); };
    const auto audits = run_audit(command);
    if (!audits) return fail(audits.error());
    if (auto error = put_out(arguments, audit_summary(audits.value()), audit_json(audits.value()))) return fail(*error);
    return std::all_of(audits.value().begin(), audits.value().end(), is_sound) ? 0 : kNotSound;
}

int run_frame(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    const FrameTimes times = measure_frame_times(*stage.value(), arguments.rounds, arguments.repeat);
    if (auto error = put_out(arguments, frame_times_table(times), frame_times_json(times))) return fail(*error);
    return 0;
}

int run_stability(const Arguments& arguments) {
    auto stage = Stage::open(arguments.stage);
    if (!stage) return fail(stage.error());
    const auto stability = measure_stability(*stage.value(), arguments.stability);
    if (!stability) return fail(stability.error());
    if (auto error = put_out(arguments, stability_table(stability.value()), stability_json(stability.value())))
        return fail(*error);
    const std::string plot = arguments.plot.empty() ? std::string() : stability_plot(stability.value());
    if (!plot.empty())
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
    const auto table = measure_queries(arguments.stage, options);
    if (!table) return fail(table.error());
    std::fputs(table.value().c_str(), stdout);
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
    std::fputs((pictures.point_figures + "\n" + pictures.disk_figures).c_str(), stdout);
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

int run_set_shares(const Arguments& arguments) {
    const auto table = set_shares(arguments.stage);
    if (!table) return fail(table.error());
    std::fputs(table.value().c_str(), stdout);
    return 0;
}

int run_redraws(const Arguments& arguments) {
    const auto table = redraws_table(arguments.stage, arguments.stability.frames);
    if (!table) return fail(table.error());
    std::fputs(table.value().c_str(), stdout);
    if (!arguments.markdown.empty())
        if (auto error = replace_marked(arguments.markdown, "redraws", table.value())) return fail(*error);
    return 0;
}

int run_demand(const Arguments& arguments) {
    const auto demand = measure_demand(arguments.demand);
    if (!demand) return fail(demand.error());
    const std::string table = demand_markdown(demand.value());
    if (auto error = put_out(arguments, table, demand_json(demand.value()))) return fail(*error);
    if (!arguments.markdown.empty())
        if (auto error = replace_marked(arguments.markdown, "demand", table)) return fail(*error);
    if (arguments.plot.empty()) return 0;
    const std::string plot = demand_plot(demand.value());
    if (auto error = game::write_file(arguments.plot, std::as_bytes(std::span(plot)))) return fail(*error);
    return 0;
}

int run_budget_speeds(const Arguments& arguments) {
    const auto speeds = measure_budget_speeds(arguments.speeds);
    if (!speeds) return fail(speeds.error());
    const std::string table = budget_speeds_markdown(speeds.value());
    std::fputs(table.c_str(), stdout);
    if (!arguments.markdown.empty())
        if (auto error = replace_marked(arguments.markdown, "speeds", table)) return fail(*error);
    return 0;
}

void add_demand(CLI::App& command, Arguments& arguments) {
    DemandOptions& options = arguments.demand;
    command.add_option("--lights", options.lights, "how many lights, one scene each; separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1u, kMostLights))
        ->capture_default_str();
    command.add_option("--size", arguments.demand_size, "WIDTHxHEIGHT")->capture_default_str();
    command.add_option("--set", options.settings, "KEY=VALUE of every LightShadow, as the game's --set")
        ->allow_extra_args(false);
    command.add_option("--repeat", options.frames, "frames of each block that are timed")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--rounds", options.rounds, "rounds of blocks without shadows, with economy on and off")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--json", arguments.json, "write all figures to this file");
    command.add_option("--plot", arguments.plot, "write times, draws and bytes against lights to this SVG file");
    command.add_option("--markdown", arguments.markdown,
                       "page whose text between <!-- demand --> and <!-- end of demand --> is replaced");
}

void add_scene(CLI::App& command, Arguments& arguments) {
    command.add_option("--scene", arguments.scenes, "glTF or GLB, or valley (default: the built-in courtyard)");
    command.add_option("--camera", arguments.camera, "name or index (default: the first)");
    command.add_option("--size", arguments.size, "WIDTHxHEIGHT")->capture_default_str();
    command.add_option("--set", arguments.stage.settings, "KEY=VALUE of every LightShadow, as the game's --set")
        ->allow_extra_args(false);
    command.add_option("--time", arguments.stage.time_s, "scene time in seconds")->capture_default_str();
    command.add_option("--offset", arguments.offset, "X,Y,Z metres by which the whole scene is moved");
    command.add_option("--json", arguments.json, "write all figures to this file");
}

void add_common(CLI::App& command, Arguments& arguments) {
    add_scene(command, arguments);
    command.add_option("--repeat", arguments.repeat, "frames that are timed")
        ->check(CLI::Range(0u, kMaxRepeats))
        ->capture_default_str();
}

void add_accuracy(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    command
        .add_option("--sweep", arguments.sweep,
                    "quick or full: what each setting costs and gains, as a report in --out; --scene may be repeated")
        ->check(CLI::IsMember({"quick", "full"}));
    command.add_option("--rows", arguments.sweep_rows,
                       "with --sweep: regular expression for rows' names, the defaults aside (default: all)");
    command.add_flag("--quick", arguments.quick, "the same as --sweep quick");
    command.add_option("--out", arguments.out, "with --sweep: folder of the report, and of what it goes on from")
        ->capture_default_str();
    command.add_option("--pictures", arguments.pictures, "folder for truth, measured and error pictures");
    command.add_option("--filters", arguments.rows,
                       "cost and error of rows of the filter table: all, or part of a name");
    command.add_option("--rounds", arguments.rounds, "with --filters and --sweep: rounds of --repeat frames each")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--markdown", arguments.markdown,
                       "page whose text between <!-- NAME --> and <!-- end of NAME --> is replaced; --filters: rows, "
                       "--sweep: cost");
}

int run(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("What Gnomon's shadows cost, and how far they are from the truth", "gnomon_bench");
    app.require_subcommand(1);
    CLI::App* accuracy = app.add_subcommand("accuracy", "shadows of each light against ray-traced truth");
    add_accuracy(*accuracy, arguments);
    CLI::App* audit = app.add_subcommand(
        "audit", "the truth itself: rays asked in two ways, and the triangles that they and the picture show");
    add_scene(*audit, arguments);
    CLI::App* frame = app.add_subcommand("frame", "frame times with and without shadows");
    add_common(*frame, arguments);
    frame->add_option("--rounds", arguments.rounds, "rounds of --repeat frames each")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    CLI::App* stability = app.add_subcommand("stability", "how shadows flicker while only the camera moves");
    add_common(*stability, arguments);
    stability->add_option("--frames", arguments.stability.frames, "frames of each path")
        ->check(CLI::Range(2u, kMaxRepeats))
        ->capture_default_str();
    stability->add_option("--points", arguments.stability.points, "points of the world that are watched on each path")
        ->check(CLI::Range(1u, kMaxPoints))
        ->capture_default_str();
    stability->add_option("--path", arguments.stability.paths, "pan, walk, roll or zoom (default: all)")
        ->allow_extra_args(false);
    stability->add_option("--fit", arguments.stability.fits, "one of --set fit's (default: all)")
        ->allow_extra_args(false);
    stability->add_option("--plot", arguments.plot, "write flips against frames to this SVG file");
    CLI::App* drawings = app.add_subcommand("drawings", "how the maps of each fit lie, as SVG files");
    add_common(*drawings, arguments);
    drawings->add_option("--out", arguments.drawings, "folder for the drawings")->required();
    CLI::App* filters = app.add_subcommand("filters", "every filter on one scene beside the truth: taps, error");
    add_common(*filters, arguments);
    filters->add_option("--out", arguments.filters, "folder for the pictures")->required();
    filters->add_option("--filter", arguments.filter, "part of a filter's name (default: all)");
    filters->add_option("--markdown", arguments.markdown,
                        "page whose text between <!-- pictures --> and <!-- end of pictures --> is replaced, likewise "
                        "pictures of a disk, figures, figures of a disk");
    CLI::App* culling = app.add_subcommand("culling", "what finding receivers and casters and fitting to them costs");
    culling->add_option("--filter", arguments.filter, "regular expression for benchmarks' names (default: all)");
    CLI::App* demand = app.add_subcommand("demand", "what shadows cost by the number of lights, economy on and off");
    add_demand(*demand, arguments);
    CLI::App* budget = app.add_subcommand("budget", "what a unit of each kind of work takes that budgets reckon with");
    budget->add_option("--rounds", arguments.speeds.rounds, "rounds of all rows")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    budget->add_option("--repeat", arguments.speeds.frames, "frames of each row in a round")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    budget->add_option("--markdown", arguments.markdown,
                       "page whose text between <!-- speeds --> and <!-- end of speeds --> is replaced");
    CLI::App* redraws = app.add_subcommand("redraws", "how many maps are drawn while a camera walks or a thing moves");
    add_common(*redraws, arguments);
    redraws->add_option("--frames", arguments.stability.frames, "frames of each run")
        ->check(CLI::Range(2u, kMaxRepeats))
        ->capture_default_str();
    redraws->add_option("--markdown", arguments.markdown,
                        "page whose text between <!-- redraws --> and <!-- end of redraws --> is replaced");
    CLI::App* sets = app.add_subcommand("sets", "how many casters each light keeps, and how many of those in vain");
    add_common(*sets, arguments);
    CLI::App* queries =
        app.add_subcommand("queries", "visibility queries on the CPU: how many per second, and their trees");
    add_common(*queries, arguments);
    queries->add_option("--places", arguments.queries.places, "places that are asked for in one batch")
        ->check(CLI::Range(1u, kMaxPoints))
        ->capture_default_str();
    queries->add_option("--threads", arguments.queries.threads, "threads that share a batch")
        ->check(CLI::Range(1u, kMostThreads))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        return fail({error.what(), "", "", "usage"});
    }
    arguments.rounds_given = accuracy->count("--rounds") > 0;
    arguments.repeat_given = accuracy->count("--repeat") > 0;
    arguments.size_given = accuracy->count("--size") > 0;
    arguments.audit = audit->parsed();
    if (auto error = complete(arguments)) return fail(*error);
    if (*audit) return run_audits(arguments);
    if (*culling) {
        run_culling(arguments.filter);
        return 0;
    }
    if (*demand) return run_demand(arguments);
    if (*budget) return run_budget_speeds(arguments);
    if (*redraws) return run_redraws(arguments);
    if (*sets) return run_set_shares(arguments);
    if (*queries) return run_queries(arguments);
    if (*drawings) return run_drawings(arguments);
    if (*filters) return run_filters(arguments);
    if (*stability) return run_stability(arguments);
    return *accuracy ? run_accuracy(arguments) : run_frame(arguments);
}

}  // namespace
}  // namespace gnomon::bench

int main(int argc, char** argv) { return gnomon::bench::run(argc, argv); }
