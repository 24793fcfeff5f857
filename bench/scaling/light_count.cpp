#include "bench/scaling/light_count.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

#include "bench/scaling/many_lights_scene.h"
#include "gnomon/components.h"

namespace gnomon::bench {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr std::uint32_t kSettlingFrames = 3;
constexpr std::uint32_t kMostSettlingFrames = 90;  // some fits and maps are kept for a second after their last use
// A metre to and fro in 4 s is 1.6 m/s at most; a walk of 1.4 m/s; both in frames of 1/60 s.
constexpr double kFrame_s = 1.0 / 60.0, kSlide_m = 1.0, kSlidePeriod_s = 4.0, kWalk_m_s = 1.4;

/// One level, run frame by frame.
class Level {
public:
    explicit Level(Stage& stage) : stage_(stage) {
        stage.device().set_timing(gl::TimingMode::off);  // finishing around every pass would slow the frame itself
        camera_ = stage.spawned().cameras.front().entity;
        for (const ecs::Entity node : stage.spawned().nodes)
            if (const Name* name = stage.world().get<Name>(node); name && name->text == kDemandMover) mover_ = node;
        camera_rest_ = *stage.world().get<Transform>(camera_);
        mover_rest_ = *stage.world().get<Transform>(mover_);
    }

    /// Returns the median frame. Every block of a motion goes the same way.
    double run_block(DemandMotion motion, DemandMode mode, std::uint32_t frames, DemandFigures& figures) {
        stage_.show_shadows(mode != DemandMode::without);
        stage_.set_economy(mode != DemandMode::redrawn);
        place(camera_, camera_rest_.translation_m);
        place(mover_, mover_rest_.translation_m);
        for (std::uint32_t i = 0; i < settling_frames(motion, mode); ++i) {
            run_frame();
            if (stage_.frame().report().still) break;
        }
        std::vector<double> frame_us;
        for (std::uint32_t i = 0; i < kSettlingFrames + frames; ++i) {
            move(motion, i);
            const double us = run_frame();
            if (i < kSettlingFrames) continue;
            frame_us.push_back(us);
            all_cpu_us_[index(motion, mode)].push_back(stage_.frame().report().shadow_cpu_us);
        }
        auto& all = all_frame_us_[index(motion, mode)];
        all.insert(all.end(), frame_us.begin(), frame_us.end());
        figures.frame_us = spread_of(all);
        figures.shadow_cpu_us = spread_of(all_cpu_us_[index(motion, mode)]);
        count(figures);
        return spread_of(frame_us).median;
    }

    /// Returns the number of distinct programs that frames have used so far.
    std::uint32_t programs() const { return static_cast<std::uint32_t>(programs_.size()); }

private:
    static std::size_t index(DemandMotion motion, DemandMode mode) {
        return static_cast<std::size_t>(motion) * kDemandModes.size() + static_cast<std::size_t>(mode);
    }

    /// Returns the frames to settle: many where a still scene comes to rest, else one.
    static std::uint32_t settling_frames(DemandMotion motion, DemandMode mode) {
        return motion == DemandMotion::still && mode == DemandMode::economy ? kMostSettlingFrames : 1;
    }

    void place(ecs::Entity entity, const glm::dvec3& at_m) {
        stage_.world().patch<Transform>(entity, [&](Transform& t) { t.translation_m = at_m; });
    }

    void move(DemandMotion motion, std::uint32_t frame) {
        const double time_s = (frame + 1.0) * kFrame_s;
        const double slide_m = kSlide_m * std::sin(2.0 * std::numbers::pi * time_s / kSlidePeriod_s);
        if (motion == DemandMotion::mover) place(mover_, mover_rest_.translation_m + glm::dvec3(slide_m, 0.0, 0.0));
        if (motion == DemandMotion::walk)
            place(camera_, camera_rest_.translation_m + glm::dvec3(0.0, 0.0, -kWalk_m_s * time_s));
    }

    double run_frame() {
        stage_.device().finish();
        const auto start = std::chrono::steady_clock::now();
        stage_.run_frame();
        stage_.device().finish();
        const auto end = std::chrono::steady_clock::now();
        for (const gl::Command& command : stage_.frame().commands().commands) {
            if (const auto* pipeline = std::get_if<gl::SetPipeline>(&command))
                programs_.insert(pipeline->state.program.id);
            if (const auto* dispatch = std::get_if<gl::Dispatch>(&command)) programs_.insert(dispatch->program.id);
        }
        return std::chrono::duration<double, std::micro>(end - start).count();
    }

    void count(DemandFigures& figures) const {
        figures.lights_given = figures.views = figures.views_drawn = figures.draws = figures.passes = 0;
        figures.bytes = 0;
        for (const LightReport& light : stage_.frame().report().lights) {
            figures.lights_given += light.counts.views > 0 ? 1 : 0;
            figures.views += light.counts.views;
            figures.views_drawn += light.counts.views_drawn;
            figures.draws += light.counts.draws;
            figures.bytes += light.counts.bytes;
        }
        for (const gl::Command& command : stage_.frame().commands().commands)
            figures.passes += std::holds_alternative<gl::BeginPass>(command) ? 1 : 0;
    }

    Stage& stage_;
    ecs::Entity camera_, mover_;
    Transform camera_rest_, mover_rest_;
    std::set<std::uint32_t> programs_;
    std::array<std::vector<double>, kDemandMotions.size() * kDemandModes.size()> all_frame_us_, all_cpu_us_;
};

Result<DemandRow> measure_row(const DemandOptions& options, std::uint32_t lights, std::string& device) {
    StageOptions stage_options;
    stage_options.size_px = options.size_px;
    stage_options.settings = options.settings;
    auto stage = Stage::open(stage_options, demand_scene(lights, kSeed));
    if (!stage) return stage.error();
    device = stage.value()->device().info().name;
    Level level(*stage.value());
    DemandRow row;
    row.lights = lights;
    row.shadowed = std::min(lights, kMostShadowedLights);
    for (const DemandMotion motion : kDemandMotions) {
        auto& figures = row.figures[static_cast<std::size_t>(motion)];
        std::array<std::vector<double>, kDemandModes.size()> ratios;
        for (std::uint32_t round = 0; round < options.rounds; ++round) {
            double base_us = 0.0;
            for (const DemandMode mode : kDemandModes) {
                const auto m = static_cast<std::size_t>(mode);
                const double us = level.run_block(motion, mode, options.frames, figures[m]);
                if (mode == DemandMode::without) base_us = us;
                if (row.programs_without == 0) row.programs_without = level.programs();
                ratios[m].push_back(us / base_us);
            }
        }
        for (std::size_t m = 0; m < kDemandModes.size(); ++m) figures[m].frame_ratio = spread_of(ratios[m]).median;
    }
    row.programs = level.programs();
    return row;
}

}  // namespace

const char* to_text(DemandMotion motion) {
    constexpr std::array kNames = {"still", "one mover", "walk"};
    return kNames[static_cast<std::size_t>(motion)];
}

const char* to_text(DemandMode mode) {
    constexpr std::array kNames = {"no shadows", "economy on", "economy off"};
    return kNames[static_cast<std::size_t>(mode)];
}

Result<Demand> measure_demand(const DemandOptions& options) {
    Demand demand;
    demand.size_px = options.size_px;
    demand.rounds = options.rounds;
    demand.frames = options.frames;
    for (const std::uint32_t lights : options.lights) {
        auto row = measure_row(options, lights, demand.device);
        if (!row) return row.error();
        demand.rows.push_back(row.value());
    }
    return demand;
}

}  // namespace gnomon::bench
