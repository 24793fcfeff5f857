#include <CLI/CLI.hpp>
#include <cmath>

#include "bench/accuracy/accuracy.h"
#include "bench/common/arguments.h"
#include "bench/common/parse_arguments.h"
#include "bench/embed/host_engine.h"
#include "bench/frame/frame_times.h"
#include "bench/judge/judge_pictures.h"
#include "bench/text/wrap_lines.h"
#include "sample_game/support/scene/mist.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kMostAreaSide = 64;
constexpr std::uint32_t kMaxRepeats = 100000;
constexpr std::uint32_t kMostDrawnCasters = 1000000, kMostDrawnViews = 64;
constexpr std::uint32_t kMostLights = 100000;
constexpr std::uint32_t kMaxPoints = 10000000;
constexpr unsigned kMostThreads = 1024;
constexpr double kLeastStep_px = 0.01, kMostStep_px = 100.0;

void add_scene(CLI::App& command, Arguments& arguments) {
    command.add_option("--scene", arguments.scenes, game::kSceneHelp);
    command.add_option("--camera", arguments.camera, "name or index (default: the first)");
    command.add_option("--size", arguments.size, "WIDTHxHEIGHT")->capture_default_str();
    command.add_option("--set", arguments.stage.settings, "KEY=VALUE of every light, as the game's --set")
        ->allow_extra_args(false);
    command.add_option("--time", arguments.stage.time_s, "scene time in seconds")->capture_default_str();
    command.add_option("--offset", arguments.offset, "X,Y,Z metres by which the whole scene is moved");
    command.add_option("--json", arguments.json, "write all figures to this file");
}

void add_rounds(CLI::App& command, std::uint32_t& rounds, const char* words) {
    command.add_option("--rounds", rounds, words)->check(CLI::Range(1u, kMaxRepeats))->capture_default_str();
}

void add_area(CLI::App& command, Arguments& arguments) {
    command
        .add_option("--area", arguments.area_side,
                    "judge edges by the lit share of each pixel's area as well, by N x N rays a pixel: 16 for figures; "
                    "bench accuracy does so by itself for lights with antialias")
        ->check(CLI::Range(0u, kMostAreaSide));
}

void add_markdown(CLI::App& command, Arguments& arguments, const char* words) {
    command.add_option("--markdown", arguments.markdown, words);
}

}  // namespace

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
                    "quick or full: what each setting costs and gains, as report.json in --out, of which ./gnomon "
                    "makes a page and tables; --scene may be repeated")
        ->check(CLI::IsMember({"quick", "full"}));
    command.add_option("--rows", arguments.sweep_rows,
                       "with --sweep: regular expression for rows' names, the defaults aside (default: all)");
    command.add_flag("--quick", arguments.quick, "the same as --sweep quick");
    command.add_option("--out", arguments.out, "with --sweep: folder of the report, and of what it goes on from")
        ->capture_default_str();
    add_area(command, arguments);
    command
        .add_option("--mist", arguments.stage.mist_per_m, "fog that takes this share of light per metre, and is judged")
        ->check(CLI::Range(0.0f, game::kMostMist_per_m));
    command
        .add_option("--noise-rounds", arguments.noise_rounds,
                    "judge the mean of so many frames, each with its own noise, as a still picture's samples have")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--pictures", arguments.pictures, "folder for truth, measured and error pictures");
    command.add_option("--filters", arguments.rows,
                       "cost and error of rows of the filter table: all, or part of a name");
    add_rounds(command, arguments.rounds, "with --filters and --sweep: rounds of --repeat frames each");
    add_markdown(command, arguments,
                 "page whose text between <!-- NAME --> and <!-- end of NAME --> is replaced; --filters: rows, "
                 "--sweep: cost (./gnomon)");
    command.footer([] { return accuracy_legend(); });
}

void add_audit(CLI::App& command, Arguments& arguments) { add_scene(command, arguments); }

void add_frame(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    add_rounds(command, arguments.rounds, "rounds of --repeat frames each");
    command
        .add_option("--against", arguments.against,
                    "KEY=VALUE on top of --set: frames of both ways and their ratios instead")
        ->allow_extra_args(false);
    command.footer([] { return frame_legend(); });
}

void add_stability(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    StabilityOptions& options = arguments.stability;
    command.add_option("--frames", options.frames, "frames of each path")
        ->check(CLI::Range(2u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--points", options.points, "points of the world that are watched on each path")
        ->check(CLI::Range(1u, kMaxPoints))
        ->capture_default_str();
    command.add_option("--path", options.paths, "pan, walk, roll or zoom, with --area also jitter (default: all)")
        ->allow_extra_args(false);
    command.add_option("--fit", options.fits, "one of --set fit's (default: all)")->allow_extra_args(false);
    command.add_option("--plot", arguments.plot, "write flips against frames to this SVG file");
    command
        .add_option("--area", arguments.area_side,
                    "edges in pictures instead, antialias=off beside on, by N x N rays a pixel: 16 for figures; then "
                    "by default 24 frames and 1000 points a light")
        ->check(CLI::Range(0u, kMostAreaSide));
    command.add_option("--step", arguments.step_px, "with --area: pixels that points move from frame to frame")
        ->check(CLI::Range(kLeastStep_px, kMostStep_px))
        ->capture_default_str();
    command.footer([] { return stability_legend() + edge_flicker_legend(); });
}

void add_drawings(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    command.add_option("--out", arguments.drawings, "folder for the drawings")->required();
}

void add_filters(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    command.add_option("--out", arguments.filters, "folder for the pictures")->required();
    command.add_option("--filter", arguments.filter, "part of a filter's name (default: all)");
    add_markdown(command, arguments,
                 "page whose text between <!-- pictures --> and <!-- end of pictures --> is replaced, likewise "
                 "pictures of a disk, figures, figures of a disk");
}

void add_pictures(CLI::App& command, Arguments& arguments) {
    add_scene(command, arguments);
    command.add_option("--out", arguments.plot, "F.png: the strip")->required();
    add_markdown(command, arguments, "page whose text between <!-- strip --> and <!-- end of strip --> is replaced");
}

void add_judge(CLI::App& command, Arguments& arguments) {
    add_scene(command, arguments);
    command
        .add_option("--visibility", arguments.visibility,
                    "folders of <light>.pfm: what of each light a pixel sees, 0 to 1, bottom row first; -1 no surface")
        ->required();
    command.add_flag("--pictures", arguments.beside, "write <light>.png beside each file: in grey, wrong pixels in red");
    add_area(command, arguments);
    command.footer([] { return judge_legend(); });
}

void add_edges(CLI::App& command, Arguments& arguments) {
    add_scene(command, arguments);
    command.add_option("--out", arguments.plot, "F.png: the pictures beside each other")->required();
}

void add_culling(CLI::App& command, Arguments& arguments) {
    command.add_option("--filter", arguments.filter, "regular expression for benchmarks' names (default: all)");
}

void add_demand(CLI::App& command, Arguments& arguments) {
    DemandOptions& options = arguments.demand;
    command.add_option("--lights", options.lights, "how many lights, one scene each; separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1u, kMostLights))
        ->capture_default_str();
    command.add_option("--size", arguments.demand_size, "WIDTHxHEIGHT")->capture_default_str();
    command.add_option("--set", options.settings, "KEY=VALUE of every light, as the game's --set")
        ->allow_extra_args(false);
    command.add_option("--repeat", options.frames, "frames of each block that are timed")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    add_rounds(command, options.rounds, "rounds of blocks without shadows, with economy on and off");
    command.add_option("--json", arguments.json, "write all figures to this file");
    command.add_option("--plot", arguments.plot, "write times, draws and bytes against lights to this SVG file");
    add_markdown(command, arguments, "page whose text between <!-- demand --> and <!-- end of demand --> is replaced");
}

void add_budget(CLI::App& command, Arguments& arguments) {
    add_rounds(command, arguments.speeds.rounds, "rounds of all rows");
    command.add_option("--repeat", arguments.speeds.frames, "frames of each row in a round")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    add_markdown(command, arguments, "page whose text between <!-- speeds --> and <!-- end of speeds --> is replaced");
}

void add_draws(CLI::App& command, Arguments& arguments) {
    DrawCostOptions& options = arguments.draws;
    command.add_option("--casters", options.casters, "casters, each a mesh of its own")
        ->check(CLI::Range(1u, kMostDrawnCasters))
        ->capture_default_str();
    command.add_option("--views", options.views, "views, each of which shows all casters")
        ->check(CLI::Range(1u, kMostDrawnViews))
        ->capture_default_str();
    command.add_option("--repeat", options.frames, "frames of each row that are timed")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--json", arguments.json, "write all figures to this file");
}

void add_redraws(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    command.add_option("--frames", arguments.stability.frames, "frames of each run")
        ->check(CLI::Range(2u, kMaxRepeats))
        ->capture_default_str();
    add_markdown(command, arguments,
                 "page whose text between <!-- redraws --> and <!-- end of redraws --> is replaced");
}

void add_queries(CLI::App& command, Arguments& arguments) {
    add_common(command, arguments);
    command.add_option("--places", arguments.queries.places, "places that are asked for in one batch")
        ->check(CLI::Range(1u, kMaxPoints))
        ->capture_default_str();
    command.add_option("--threads", arguments.queries.threads, "threads that share a batch")
        ->check(CLI::Range(1u, kMostThreads))
        ->capture_default_str();
}

void add_embed(CLI::App& command, Arguments& arguments) {
    EmbedOptions& options = arguments.embed;
    add_scene(command, arguments);
    command.add_option("--lights", options.lights, "how many lights; separated by commas")
        ->delimiter(',')
        ->check(CLI::Range(1u, kMostHostLights))
        ->capture_default_str();
    add_rounds(command, options.rounds, "rounds of --repeat calls of each way");
    command.add_option("--repeat", options.frames, "calls of each way in a round")
        ->check(CLI::Range(1u, kMaxRepeats))
        ->capture_default_str();
    command.add_option("--only", options.only, "part of kind and filter, as 'spots default' (default: all)");
    command.add_flag("--quick", options.quick, "1 and 8 lights, fewer filters and rounds");
    command.add_flag("!--no-lookup-all", options.whole_text, "leave out lookup_all: its shader takes long to compile");
    command.footer([] { return wrapped(embed_legend()); });
}

void add_check(CLI::App& command, Arguments& arguments) { add_check_options(command, arguments.check); }

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
    if (std::isnan(arguments.stage.mist_per_m)) return Error{"--mist wants a number", "", "", "mist"};
    if (!std::isfinite(arguments.stage.time_s)) return Error{"--time wants a finite number", "", "", "time"};
    return std::nullopt;
}

}  // namespace gnomon::bench
