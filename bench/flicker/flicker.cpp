#include "bench/flicker/flicker.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "bench/flicker/camera_path.h"
#include "bench/flicker/map_readback.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/parallel_rows.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kStations = 16;       // places along a path where points are looked for
constexpr std::size_t kChunk = 2048;        // points per piece of work
constexpr std::uint32_t kAllLayers = 0xff;  // a lookup of a cube does not say which face
constexpr float kHalfLit = 0.5f;

std::vector<std::string> known_paths() {
    std::vector<std::string> names;
    for (const CameraPath& path : camera_paths()) names.emplace_back(path.name);
    return names;
}

/// One light's effect on its points in the last frame.
struct LookedUpLight {
    std::vector<std::uint32_t> points;    // points that the light shines on
    std::vector<ExactVisibility> values;  // same order
    std::vector<std::uint8_t> seen;       // same order: in view in the last frame
    std::uint32_t moved_layers = 0;       // bit per layer with a view that changed its matrices
    std::uint32_t stepped_layers = 0;     // bit per moved layer that changed by more than a shift
};

/// Half-open range of a light's points.
struct PointRange {
    std::size_t from = 0, to = 0;
};

/// One run along one path under one fit.
class PathRun {
public:
    PathRun(Stage& stage, ShadowFrames& frames, const std::vector<SurfacePoint>& points, std::string path,
            std::string fit)
        : stage_(stage), frames_(frames), points_(points) {
        const SceneSnapshot& scene = frames.snapshot();
        for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
            LookedUpLight state;
            for (std::uint32_t i = 0; i < points.size(); ++i)
                if (shines_on(scene.lights[l], points[i])) state.points.push_back(i);
            state.values.resize(state.points.size());
            state.seen.assign(state.points.size(), 0);
            PathFlicker row;
            row.path = path;
            row.fit = fit;
            row.light = scene.lights[l].name;
            row.kind = shadow::light_kind_row(scene.lights[l].kind).name;
            row.points = static_cast<std::uint32_t>(state.points.size());
            rows_.push_back(std::move(row));
            states_.push_back(std::move(state));
        }
    }

    std::optional<Error> walk(const ConsumerItem& start, double distance_m, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
            const ConsumerItem pose = on_path(start, rows_.empty() ? "" : rows_.front().path, share, distance_m);
            const int repeats = i == 0 ? kPathSettlingFrames : 1;
            for (int r = 0; r < repeats; ++r)
                if (auto error = frames_.run(pose)) return error;
            if (i > 0) compare_views();
            remember_views();
            if (auto error = look(i == 0)) return error;
        }
        for (std::size_t l = 0; l < rows_.size(); ++l) {
            const LightReport& report = frames_.report().lights[l];
            if (report.state == LightState::skipped) rows_[l].reason = reason_code(report.reason);
        }
        return std::nullopt;
    }

    std::vector<PathFlicker> take_rows() { return std::move(rows_); }

private:
    shadow::ShadowView* known_view(const shadow::ShadowView& view) {
        for (shadow::ShadowView& known : known_views_)
            if (known.light == view.light && known.layer == view.layer) return &known;
        return nullptr;
    }
    void remember_views() {
        for (const shadow::ShadowView& view : frames_.frame().fitted.views)
            if (shadow::ShadowView* known = known_view(view))
                *known = view;
            else
                known_views_.push_back(view);
    }
    /// Views against the same ones as they last were.
    void compare_views() {
        const shadow::ShadowFrame& frame = frames_.frame();
        const shadow::DrawnViews drawn = shadow::drawn_views(frame);
        for (LookedUpLight& state : states_) state.moved_layers = state.stepped_layers = 0;
        for (std::size_t v = 0; v < frame.fitted.views.size(); ++v) {
            const shadow::ShadowView& now = frame.fitted.views[v];
            const std::uint32_t light = now.light;
            PathFlicker& row = rows_[light];
            ++row.views;
            row.views_drawn += drawn.is_drawn(v);
            const shadow::ShadowView* before = known_view(now);
            const bool same = before && before->pose.anchor_ws_m == now.pose.anchor_ws_m &&
                              before->clip_from_anchor == now.clip_from_anchor;
            row.views_moved += !same;
            const bool is_cube = now.projection == shadow::ViewProjection::cube_face;
            const std::uint32_t layers = is_cube ? kAllLayers : 1u << now.layer;
            if (!same) states_[light].moved_layers |= layers;
            // A view that is new decided nothing before.
            if (!before || same_size(*before, now)) continue;
            ++row.views_stepped;
            states_[light].stepped_layers |= layers;
        }
        for (std::size_t l = 0; l < rows_.size(); ++l) rows_[l].frames_stepped += states_[l].stepped_layers != 0;
    }
    /// Returns whether two views are equal up to a shift. The tolerance covers roundings of the shift.
    static bool same_size(const shadow::ShadowView& a, const shadow::ShadowView& b) {
        constexpr double kRounding = 1e-9;
        const auto near = [](double x, double y) { return std::abs(x - y) <= kRounding * std::abs(x); };
        return near(a.plane.texel_u, b.plane.texel_u) && near(a.plane.texel_v, b.plane.texel_v) &&
               a.pose.axis_u == b.pose.axis_u && a.pose.axis_v == b.pose.axis_v &&
               near(a.depth.far_m - a.depth.near_m, b.depth.far_m - b.depth.near_m);
    }

    std::optional<Error> look(bool first) {
        const SceneSnapshot& scene = frames_.snapshot();
        const ConsumerItem& camera = scene.consumers.front();
        for (std::uint32_t l = 0; l < states_.size(); ++l) {
            const auto light = frames_.exact_light(l);
            if (!light)
                return Error{
                    "the lookup of light '" + scene.lights[l].name + "' is not among those that this bench knows",
                    stage_.scene_name(), "", "bench.row"};
            look_through(*light, camera, states_[l], rows_[l], first);
        }
        return std::nullopt;
    }

    void look_through(const ExactLight& light, const ConsumerItem& camera, LookedUpLight& state, PathFlicker& row,
                      bool first) {
        const std::size_t count = state.points.size();
        const auto chunks = static_cast<std::uint32_t>((count + kChunk - 1) / kChunk);
        std::vector<PathFlicker> parts(chunks);
        oracle::parallel_rows(chunks, 0, [&](std::uint32_t chunk) {
            const std::size_t from = chunk * kChunk;
            look_at(light, camera, {from, std::min(count, from + kChunk)}, first, state, parts[chunk]);
        });
        const std::uint64_t before = row.flips;
        for (const PathFlicker& part : parts) add(part, row);
        row.flips_by_frame.push_back(static_cast<std::uint32_t>(row.flips - before));
    }

    void look_at(const ExactLight& light, const ConsumerItem& camera, PointRange points, bool first,
                 LookedUpLight& state, PathFlicker& part) const {
        std::vector<std::size_t> seen;
        std::vector<SurfacePoint> at;
        for (std::size_t k = points.from; k < points.to; ++k) {
            const SurfacePoint& point = points_[state.points[k]];
            const bool in = in_view(camera, point.position_ws_m);
            if (in) {
                seen.push_back(k);
                at.push_back(point);
            } else {
                state.seen[k] = 0;
            }
        }
        std::vector<ExactVisibility> now(seen.size());
        light.evaluate(at, now);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const std::size_t k = seen[i];
            if (!first && state.seen[k]) compare(state.values[k], now[i], state, part);
            part.uncovered += now[i].layers == 0;
            state.values[k] = now[i];
            state.seen[k] = 1;
        }
    }

    static void compare(const ExactVisibility& before, const ExactVisibility& now, const LookedUpLight& state,
                        PathFlicker& row) {
        const bool still = (state.moved_layers & now.layers) == 0;
        const bool stepped = (state.stepped_layers & (before.layers | now.layers)) != 0;
        const bool flip = (before.value >= kHalfLit) != (now.value >= kHalfLit);
        const double jump = std::abs(static_cast<double>(now.value) - static_cast<double>(before.value));
        if (before.layers != now.layers || std::popcount(now.layers) > 1) {
            ++row.crossings;
            row.crossing_flips += flip;
            double& greatest = stepped ? row.greatest_step_jump : row.greatest_crossing_jump;
            greatest = std::max(greatest, jump);
        } else if (before.on_edge || now.on_edge) {
            ++row.edge_pairs;
            row.edge_flips += flip;
        } else {
            ++row.pairs;
            row.flips += flip;
            row.still_flips += flip && still;
            row.flips_between_steps += flip && !stepped;
            row.greatest_jump = std::max(row.greatest_jump, jump);
        }
    }

    static void add(const PathFlicker& part, PathFlicker& row) {
        row.pairs += part.pairs;
        row.flips += part.flips;
        row.still_flips += part.still_flips;
        row.flips_between_steps += part.flips_between_steps;
        row.edge_pairs += part.edge_pairs;
        row.edge_flips += part.edge_flips;
        row.crossings += part.crossings;
        row.crossing_flips += part.crossing_flips;
        row.greatest_jump = std::max(row.greatest_jump, part.greatest_jump);
        row.greatest_crossing_jump = std::max(row.greatest_crossing_jump, part.greatest_crossing_jump);
        row.greatest_step_jump = std::max(row.greatest_step_jump, part.greatest_step_jump);
        row.uncovered += part.uncovered;
    }

    Stage& stage_;
    ShadowFrames& frames_;
    const std::vector<SurfacePoint>& points_;
    std::vector<LookedUpLight> states_;
    std::vector<PathFlicker> rows_;
    std::vector<shadow::ShadowView> known_views_;  // each as it last was
};

std::vector<SurfacePoint> points_of_path(const ShadowFrames& frames, const Stage& stage, const ConsumerItem& start,
                                         const std::string& path, double distance_m, std::uint32_t count) {
    std::vector<ConsumerItem> stations;
    for (std::size_t s = 0; s < kStations; ++s)
        stations.push_back(
            on_path(start, path, static_cast<double>(s) / static_cast<double>(kStations - 1), distance_m));
    return surface_points(frames.snapshot(), stage.library(), stations, count);
}

}  // namespace

std::vector<std::string> known_fits() {
    std::vector<std::string> names;
    const game::LightSetting* setting = game::find_setting("fit");
    if (setting && setting->choice)
        for (std::size_t i = 0; !setting->choice(i).empty(); ++i) names.emplace_back(setting->choice(i));
    return names;
}

Result<Stability> measure_stability(Stage& stage, const StabilityOptions& options) {
    const auto paths = chosen_names(options.paths, known_paths(), "path");
    if (!paths) return paths.error();
    auto fits = chosen_names(options.fits, known_fits(), "fit");
    if (!fits) return fits.error();
    const bool no_choice = fits.value().empty();  // this build knows one fit only
    const std::vector<std::string> runs = no_choice ? std::vector<std::string>{"tight"} : fits.value();

    Stability stability;
    stability.scene = stage.scene_name();
    stability.device = stage.device().info().name;
    stability.size_px = stage.settings().viewport_px;
    stability.frames = options.frames;
    std::optional<ConsumerItem> start;
    double distance_m = 1.0;
    for (const std::string& path : paths.value()) {
        std::vector<SurfacePoint> points;
        for (const std::string& fit : runs) {
            if (!no_choice)
                if (auto error = stage.apply_setting("fit=" + fit)) return *error;
            auto frames = ShadowFrames::create(stage);
            if (!frames) return frames.error();
            if (auto error = start ? frames.value()->run(*start) : frames.value()->run()) return *error;
            if (!start) {
                start = frames.value()->snapshot().consumers.front();
                distance_m = seen_distance_m(frames.value()->snapshot(), stage.library(), *start);
            }
            if (points.empty())
                points = points_of_path(*frames.value(), stage, *start, path, distance_m, options.points);
            PathRun run(stage, *frames.value(), points, path, fit);
            if (auto error = run.walk(*start, distance_m, options.frames)) return *error;
            for (PathFlicker& row : run.take_rows()) stability.rows.push_back(std::move(row));
        }
    }
    return stability;
}

}  // namespace gnomon::bench
