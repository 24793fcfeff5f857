#include "bench/flicker/edge_flicker.h"

#include "bench/flicker/camera_path.h"
#include "bench/flicker/map_readback.h"
#include "bench/flicker/watched_points.h"
#include "systems/picture/sample_places.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

constexpr std::string_view kJitter = "jitter";
// Sizes of maps may settle for a second before a picture counts as still.
constexpr std::uint32_t kMostStillFrames = 200;
// Way along a path that a step is measured by: so short that paths are straight.
constexpr double kShortWay = 1.0e-5;

/// What is measured of one scene, before any path.
struct Watch {
    SceneSnapshot scene;
    ConsumerItem start;
    double distance_m = 1.0;
    std::vector<WatchedLight> lights;
};

std::optional<Error> read_visibility(Stage& stage, const Watch& watch, const std::vector<WatchedFrames>& watched,
                                     std::size_t frame, std::vector<std::vector<std::vector<float>>>& seen) {
    std::vector<float> picture;
    for (std::size_t l = 0; l < watch.lights.size(); ++l) {
        const LightItem& light = watch.scene.lights[watch.lights[l].light];
        if (!stage.frame().read_visibility(watch.lights[l].light, picture))
            return Error{"visibility of light '" + light.name + "' cannot be read", stage.scene_name(), "",
                         "bench.visibility"};
        std::vector<float>& values = seen[l][frame];
        values.clear();
        for (const std::size_t pixel : watched[l].pixels[frame])
            values.push_back(pixel == kNoPixel ? -1.0f : picture[pixel]);
    }
    return std::nullopt;
}

/// Draws a still camera's samples. The first one is the picture at rest, which is drawn until nothing changes.
std::optional<Error> draw_samples(Stage& stage, const Watch& watch, const std::vector<WatchedFrames>& watched,
                                  std::vector<std::vector<std::vector<float>>>& seen) {
    place_camera(watch.start, stage.world());
    FrameSettings settings = stage.settings();
    settings.still_samples = kJitterPhases;
    for (std::uint32_t i = 0; i < kMostStillFrames; ++i) {
        stage.frame().run(stage.world(), settings);
        const std::uint32_t samples = stage.frame().report().samples;
        if (auto error = read_visibility(stage, watch, watched, samples - 1, seen)) return error;
        if (samples == kJitterPhases) return std::nullopt;
    }
    return Error{"a picture cannot be drawn with all its samples", stage.scene_name(), "", "bench.samples"};
}

std::optional<Error> draw_path(Stage& stage, const Watch& watch, const std::vector<PathFrame>& frames,
                               const std::vector<WatchedFrames>& watched,
                               std::vector<std::vector<std::vector<float>>>& seen) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        place_camera(frames[i].pose, stage.world());
        for (int r = 0; r < (i == 0 ? kPathSettlingFrames : 1); ++r) stage.run_frame();
        if (auto error = read_visibility(stage, watch, watched, i, seen)) return error;
    }
    return std::nullopt;
}

std::vector<PathFrame> frames_of(const std::string& path, const Watch& watch, const EdgeFlickerOptions& options) {
    std::vector<PathFrame> frames;
    if (path == kJitter) {
        for (std::uint32_t i = 0; i < kJitterPhases; ++i) frames.push_back({watch.start, picture::sample_place_px(i)});
        return frames;
    }
    const ConsumerItem beside = on_path(watch.start, path, kShortWay, watch.distance_m);
    const double way_px = median_way_px(watch.lights, watch.start, beside);
    const double step = way_px > 0.0 ? options.step_px * kShortWay / way_px : 0.0;
    for (std::uint32_t i = 0; i < options.frames; ++i)
        frames.push_back({on_path(watch.start, path, step * i, watch.distance_m), glm::dvec2(0.0)});
    return frames;
}

std::vector<EdgeFlicker> rows_of(const std::string& path, const Watch& watch) {
    std::vector<EdgeFlicker> rows;
    for (const WatchedLight& watched : watch.lights) {
        const LightItem& light = watch.scene.lights[watched.light];
        EdgeFlicker row;
        row.path = path;
        row.light = light.name;
        row.kind = shadow::light_kind_row(light.kind).name;
        row.points = static_cast<std::uint32_t>(watched.points.size());
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Draws the start as the first setting has it, and keeps what it shows.
std::optional<Error> begin(Stage& stage, const EdgeFlickerOptions& options, Watch& watch) {
    const std::vector<std::string> first{options.compared[0]};
    if (auto error = stage.start_over(first)) return error;
    for (int i = 0; i < kPathSettlingFrames; ++i) stage.run_frame();
    watch.scene = stage.frame().snapshot();
    if (watch.scene.consumers.empty()) return Error{"no usable camera", stage.scene_name(), "", "bench.camera"};
    watch.start = watch.scene.consumers.front();
    watch.distance_m = seen_distance_m(watch.scene, stage.library(), watch.start);
    for (std::uint32_t l = 0; l < watch.scene.lights.size(); ++l)
        if (watch.scene.lights[l].has_shadow) watch.lights.push_back({l, {}});
    return std::nullopt;
}

}  // namespace

std::vector<std::string> edge_flicker_paths() {
    std::vector<std::string> names;
    for (const CameraPath& path : camera_paths()) names.emplace_back(path.name);
    names.emplace_back(kJitter);
    return names;
}

Result<EdgeFlickers> measure_edge_flicker(Stage& stage, const EdgeFlickerOptions& options) {
    const auto paths = chosen_names(options.paths, edge_flicker_paths(), "path");
    if (!paths) return paths.error();
    EdgeFlickers flickers;
    flickers.scene = stage.scene_name();
    flickers.device = stage.device().info().name;
    flickers.size_px = stage.settings().viewport_px;
    flickers.options = options;
    Watch watch;
    if (auto error = begin(stage, options, watch)) return *error;
    const glm::dvec3 origin_ws_m = watch.start.position_ws_m;
    const oracle::ReferenceTracer tracer(watch.scene, stage.library(), origin_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(watch.start);
    for (WatchedLight& light : watch.lights)
        if (stage.frame().report().lights[light.light].state != LightState::skipped)
            light.points = points_beside_edges(tracer, hits, watch.start, origin_ws_m, watch.scene.lights[light.light],
                                               options.points);
    for (const std::string& path : paths.value()) {
        std::vector<EdgeFlicker> rows = rows_of(path, watch);
        const std::vector<PathFrame> frames = frames_of(path, watch, options);
        const auto watched = trace_watched(tracer, watch.scene, origin_ws_m, watch.lights, frames, options.area_side);
        for (std::size_t c = 0; c < options.compared.size(); ++c) {
            const std::vector<std::string> setting{options.compared[c]};
            place_camera(watch.start, stage.world());
            if (auto error = stage.start_over(setting)) return *error;
            std::vector<std::vector<std::vector<float>>> seen(watch.lights.size());
            for (auto& of_light : seen) of_light.resize(frames.size());
            if (auto error = path == kJitter ? draw_samples(stage, watch, watched, seen)
                                             : draw_path(stage, watch, frames, watched, seen))
                return *error;
            for (std::size_t l = 0; l < rows.size(); ++l) {
                const LightReport& report = stage.frame().report().lights[watch.lights[l].light];
                if (report.state == LightState::skipped) rows[l].reason = reason_code(report.reason);
                rows[l].compared[c] = oracle::compare_changes(watched[l].truth, seen[l]);
            }
        }
        for (EdgeFlicker& row : rows) flickers.rows.push_back(std::move(row));
    }
    place_camera(watch.start, stage.world());
    return flickers;
}

}  // namespace gnomon::bench
