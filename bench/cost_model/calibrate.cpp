#include "bench/cost_model/calibrate.h"

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "bench/common/stage.h"
#include "bench/cost_model/calibration_scene.h"
#include "bench/text/printf_string.h"
#include "gnomon/components.h"
#include "systems/shadow/budget/cost_model.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/publish/publish_lights.h"

namespace gnomon::bench {
namespace {

constexpr std::array<SpeedGroup, 3> kGroups{SpeedGroup{}, SpeedGroup{.meshes = 256}, SpeedGroup{.cells = 24}};

/// Row that draws: maps of `lamps` lamps show one group.
struct DrawingRow {
    std::uint32_t group, lamps, map_px;
};
constexpr std::array<DrawingRow, 8> kDrawing{DrawingRow{0, 1, 256},  DrawingRow{0, 8, 256},  DrawingRow{0, 16, 256},
                                             DrawingRow{0, 1, 2048}, DrawingRow{0, 1, 4096}, DrawingRow{1, 1, 256},
                                             DrawingRow{1, 4, 256},  DrawingRow{2, 1, 256}};
constexpr std::uint32_t kMostLamps = 16;

/// Rows that light: a kept map is looked up by a grid of that edge.
constexpr std::array<std::uint32_t, 4> kGridSizes{1, 3, 5, 9};
constexpr std::uint32_t kLookedUp_px = 1024;

constexpr int kSettlingFrames = 2;

/// Drawing's units are passes, draws, triangles, texels; lighting's pixels and fetches.
template <class Vector>
struct Row {
    Vector units{0.0};
    double ns = 0.0;
};

/// Solves `rows` by least squares, each relative to its own time. `residual`: relative error of the worst row.
template <class Matrix, class Vector>
Vector solved(const std::vector<Row<Vector>>& rows, double& residual) {
    Matrix normal(0.0);
    Vector right(0.0);
    for (const Row<Vector>& row : rows) {
        const Vector units = row.units / row.ns;
        normal += glm::outerProduct(units, units);
        right += units;
    }
    const Vector found = glm::inverse(normal) * right;
    residual = 0.0;
    for (const Row<Vector>& row : rows)
        residual = std::max(residual, std::abs(glm::dot(row.units, found) / row.ns - 1.0));
    return found;
}

class Speeds {
public:
    Speeds(Stage& stage, const SpeedOptions& options) : stage_(stage), options_(options) {
        for (const ecs::Entity node : stage.spawned().nodes) {
            const Name* name = stage.world().get<Name>(node);
            if (!name || !stage.world().has<ShadowCaster>(node)) continue;
            for (std::uint32_t g = 0; g < kGroups.size(); ++g)
                if (name->text.starts_with("group" + std::to_string(g)))
                    stage.world().patch<ShadowCaster>(node, [&](ShadowCaster& c) { c.layers = layer_of(g); });
        }
    }

    glm::dvec4 draw_round(double& residual) {
        std::vector<Row<glm::dvec4>> rows;
        stage_.set_economy(false);
        for (const DrawingRow& row : kDrawing) {
            light_up(row.lamps,
                     {.filter = ShadowFilter::hard, .resolution_px = row.map_px, .layers = layer_of(row.group)},
                     {.reuse = {.economy = false, .keep_visibility = false}});
            rows.push_back({{}, timed([](const FrameReport& report) { return report.shadow_gpu_us.value_or(0.0); })});
            for (const LightReport& light : stage_.frame().report().lights)
                rows.back().units +=
                    glm::dvec4(light.counts.views_drawn, light.counts.draws,
                               static_cast<double>(light.counts.triangles), static_cast<double>(light.counts.texels));
        }
        return solved<glm::dmat4>(rows, residual);
    }

    glm::dvec2 light_round(double& residual) {
        std::vector<Row<glm::dvec2>> rows;
        for (const std::uint32_t size : kGridSizes) {
            const ShadowFilter filter = size == 1 ? ShadowFilter::hard : ShadowFilter::pcf_grid;
            light_up(1, {.filter = filter, .resolution_px = kLookedUp_px, .layers = layer_of(0)},
                     {.kernel = {.size_texel = size}, .reuse = {.keep_visibility = false}});
            const double ns = timed([](const FrameReport& report) { return report.lights[0].gpu_us.value_or(0.0); });
            const SceneSnapshot& scene = stage_.frame().snapshot();
            const gl::Rect area = shadow::screen_rectangle(scene.lights[0], scene.consumers[0]);
            const double pixels = static_cast<double>(area.width) * area.height;
            shadow::ShadowRequest demand;
            demand.map.filter = filter;
            rows.push_back({{pixels, pixels * shadow::mean_fetches(scene.lights[0], demand, demand.map.filter)}, ns});
        }
        return solved<glm::dmat2>(rows, residual);
    }

private:
    static ShadowLayers layer_of(std::uint32_t group) { return static_cast<ShadowLayers>(1u << group); }

    /// Lets the first `lamps` lamps shine, with these shadows, and the others not at all.
    void light_up(std::uint32_t lamps, const LightShadow& shadow, const ShadowTuning& tuning) {
        std::uint32_t i = 0;
        for (const auto& light : stage_.spawned().lights) {
            const bool on = i++ < lamps;
            stage_.world().patch<LightShadow>(light.entity, [&](LightShadow& s) {
                s = shadow;
                s.enabled = on;
            });
            stage_.world().emplace<ShadowTuning>(light.entity, tuning);
        }
    }

    /// Nanoseconds, the median of frames.
    template <class Time>
    double timed(Time time_us) {
        for (int i = 0; i < kSettlingFrames; ++i) stage_.run_frame();
        std::vector<double> all;
        for (std::uint32_t i = 0; i < options_.frames; ++i) {
            stage_.run_frame();
            all.push_back(time_us(stage_.frame().report()) * 1.0e3);
        }
        return spread_of(std::move(all)).median;
    }

    Stage& stage_;
    const SpeedOptions& options_;
};

}  // namespace

Result<BudgetSpeeds> measure_budget_speeds(const SpeedOptions& options) {
    StageOptions stage_options;
    stage_options.size_px = options.size_px;
    auto stage = Stage::open(stage_options, speed_scene(kGroups.data(), kGroups.size(), kMostLamps));
    if (!stage) return stage.error();
    Speeds speeds(*stage.value(), options);
    std::array<std::vector<double>, 6> rounds;
    std::vector<double> drawing_residuals, lighting_residuals;
    for (std::uint32_t round = 0; round < options.rounds; ++round) {
        double drawing = 0.0, lighting = 0.0;
        const glm::dvec4 drawn = speeds.draw_round(drawing);
        const glm::dvec2 lit = speeds.light_round(lighting);
        for (int i = 0; i < 4; ++i) rounds[static_cast<std::size_t>(i)].push_back(drawn[i]);
        rounds[4].push_back(lit[1]);
        rounds[5].push_back(lit[0]);
        drawing_residuals.push_back(drawing);
        lighting_residuals.push_back(lighting);
    }
    BudgetSpeeds out;
    out.device = stage.value()->device().info().name;
    out.speeds = {Speed{"pass", shadow::kPass_ns, {}},         Speed{"draw", shadow::kDraw_ns, {}},
                  Speed{"triangle", shadow::kTriangle_ns, {}}, Speed{"texel", shadow::kTexel_ns, {}},
                  Speed{"fetch", shadow::kFetch_ns, {}},       Speed{"lit pixel", shadow::kShadedPixel_ns, {}}};
    for (std::size_t i = 0; i < rounds.size(); ++i) out.speeds[i].measured_ns = spread_of(std::move(rounds[i]));
    out.drawing_residual = spread_of(std::move(drawing_residuals)).median;
    out.lighting_residual = spread_of(std::move(lighting_residuals)).median;
    return out;
}

std::string budget_speeds_markdown(const BudgetSpeeds& speeds) {
    std::string text =
        "Device: " + speeds.device + ".\n\n| work | model, ns | measured, ns | [least, most] | ratio |\n";
    text += "|---|---|---|---|---|\n";
    for (const Speed& s : speeds.speeds)
        text += formatted("| %s | %.3g | %.3g | [%.3g, %.3g] | %.3g |\n", s.work, s.model_ns, s.measured_ns.median,
                          s.measured_ns.min, s.measured_ns.max, s.measured_ns.median / s.model_ns);
    text += formatted("\nRows differ from these figures by %.0f %% at worst (drawing), %.0f %% (lighting).\n",
                      100.0 * speeds.drawing_residual, 100.0 * speeds.lighting_residual);
    return text;
}

}  // namespace gnomon::bench
