#include "bench/frame_times.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "components/transform.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kSettlingFrames = 4;  // the third one of a still scene fills what is kept
constexpr double kUsPerMs = 1000.0, kUsPerS = 1.0e6;
constexpr double kStep_s = 1.0 / 60.0, kWalk_m_s = 1.4;
constexpr std::size_t kLineLength = 256;

struct Times {
    std::vector<double> us, cpu_us;
};

/// One frame, its times added to `times`.
void time_frame(Stage& stage, Times& times) {
    stage.device().finish();
    const std::clock_t cpu_start = std::clock();
    const auto start = std::chrono::steady_clock::now();
    stage.run_frame();
    stage.device().finish();
    times.us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    times.cpu_us.push_back(static_cast<double>(std::clock() - cpu_start) * kUsPerS / CLOCKS_PER_SEC);
}

using Step = std::function<void(std::uint32_t frame)>;  // before each of a block

Times run_block(Stage& stage, std::uint32_t frames, const Step& step) {
    Times block;
    for (std::uint32_t i = 0; i < kSettlingFrames + frames; ++i) {
        step(i);
        if (i < kSettlingFrames)
            stage.run_frame();
        else
            time_frame(stage, block);
    }
    return block;
}

/// Rounds of one kind; `base`: the round's without shadows, which this is held against.
struct Rounds {
    Times all, ratios;
    struct Medians {
        double us = 0.0, cpu_us = 0.0;
    };
    Medians add(const Times& block, const Medians* base) {
        all.us.insert(all.us.end(), block.us.begin(), block.us.end());
        all.cpu_us.insert(all.cpu_us.end(), block.cpu_us.begin(), block.cpu_us.end());
        const Medians medians{spread_of(block.us).median, spread_of(block.cpu_us).median};
        if (base) ratios.us.push_back(medians.us / base->us);
        if (base) ratios.cpu_us.push_back(medians.cpu_us / base->cpu_us);
        return medians;
    }
    TimedFrames frames() const {
        return {spread_of(all.us), spread_of(all.cpu_us), spread_of(ratios.us), spread_of(ratios.cpu_us)};
    }
};

void set(Stage& stage, bool shadows, bool economy, bool keep_visibility) {
    stage.show_shadows(shadows);
    stage.set_economy(economy);
    (void)stage.apply_setting(keep_visibility ? "keep_visibility=on" : "keep_visibility=off");
}

/// Ahead along its own view, from where it stands.
class Walk {
public:
    explicit Walk(Stage& stage) : stage_(stage) {
        if (stage.spawned().cameras.empty()) return;
        camera_ = stage.spawned().cameras.front().entity;
        rest_ = *stage.world().get<Transform>(camera_);
    }
    ~Walk() { place(0.0); }
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;
    void place(double time_s) {
        if (camera_ == ecs::Entity{}) return;
        const glm::dvec3 ahead = rest_.rotation * glm::dvec3(0.0, 0.0, -1.0);
        stage_.world().patch<Transform>(
            camera_, [&](Transform& t) { t.translation_m = rest_.translation_m + ahead * (kWalk_m_s * time_s); });
    }

private:
    Stage& stage_;
    ecs::Entity camera_;
    Transform rest_;
};

std::string line(const char* what, const TimedFrames& frames) {
    char text[kLineLength];
    int used = std::snprintf(text, sizeof text, "%-28s %9.2f ms (%.2f-%.2f), processor %.2f ms", what,
                             frames.us.median / kUsPerMs, frames.us.min / kUsPerMs, frames.us.max / kUsPerMs,
                             frames.cpu_us.median / kUsPerMs);
    if (frames.ratio.count > 0 && used > 0)
        std::snprintf(text + used, sizeof text - static_cast<std::size_t>(used), "  x %.3f (%.3f-%.3f), x %.3f",
                      frames.ratio.median, frames.ratio.min, frames.ratio.max, frames.cpu_ratio.median);
    return std::string(text) + "\n";
}

nlohmann::ordered_json to_json(const Spread& s) {
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}, {"count", s.count}};
}

/// What each is called, in the table and in the file.
struct Named {
    const char* words;
    const char* key;
    TimedFrames FrameTimes::*frames;
};
constexpr std::array kKinds = {
    Named{"without shadows", "without", &FrameTimes::without},
    Named{"still", "kept", &FrameTimes::kept},
    Named{"still, looked up", "looked_up", &FrameTimes::looked_up},
    Named{"still, maps redrawn", "redrawn", &FrameTimes::redrawn},
    Named{"camera walks, without", "walk_without", &FrameTimes::walk_without},
    Named{"camera walks, shadows", "walk", &FrameTimes::walk},
    Named{"everything moves, without", "moving_without", &FrameTimes::moving_without},
    Named{"everything moves, shadows", "moving", &FrameTimes::moving},
};

}  // namespace

FrameTimes measure_frame_times(Stage& stage, std::uint32_t rounds, std::uint32_t frames) {
    FrameTimes times;
    times.scene = stage.scene_name();
    times.device = stage.device().info().name;
    stage.device().set_timing(gl::TimingMode::off);  // finishing around every pass would slow the frame itself
    Rounds without, kept, looked_up, redrawn, walk_without, walk, moving_without, moving;
    const Step still = [](std::uint32_t) {};
    const auto run = [&](bool shadows, bool economy, bool keep_visibility, const Step& step) {
        set(stage, shadows, economy, keep_visibility);
        return run_block(stage, frames, step);
    };
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const Rounds::Medians base = without.add(run(false, true, true, still), nullptr);
        kept.add(run(true, true, true, still), &base);
        looked_up.add(run(true, true, false, still), &base);
        redrawn.add(run(true, false, true, still), &base);
    }
    {
        Walk way(stage);
        const Step ahead = [&](std::uint32_t i) { way.place((i + 1) * kStep_s); };
        for (std::uint32_t round = 0; round < rounds; ++round) {
            const Rounds::Medians base = walk_without.add(run(false, true, true, ahead), nullptr);
            walk.add(run(true, true, true, ahead), &base);
        }
    }
    const Step on = [&](std::uint32_t i) { stage.move_to(stage.time_s() + i * kStep_s); };
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const Rounds::Medians base = moving_without.add(run(false, true, true, on), nullptr);
        moving.add(run(true, true, true, on), &base);
    }
    for (const LightReport& light : stage.frame().report().lights) {
        times.moving_views += light.views;
        times.moving_views_drawn += light.views_drawn;
    }
    if (!stage.frame().snapshot().consumers.empty())
        times.size_px = stage.frame().snapshot().consumers.front().viewport_px;
    const std::array<const Rounds*, kKinds.size()> all = {&without,      &kept, &looked_up,      &redrawn,
                                                          &walk_without, &walk, &moving_without, &moving};
    for (std::size_t i = 0; i < kKinds.size(); ++i) times.*kKinds[i].frames = all[i]->frames();
    return times;
}

std::string frame_times_table(const FrameTimes& times) {
    std::string text = "scene   " + times.scene + "\ndevice  " + times.device + "\npicture " +
                       std::to_string(times.size_px.x) + " x " + std::to_string(times.size_px.y) + "\n\n";
    for (const Named& kind : kKinds) text += line(kind.words, times.*kind.frames);
    return text +
           "\nmedian (min-max) of whole frames until the device has finished, and the process's time on all cores; x: "
           "ratios per round\nto the same without shadows, of either. still: maps, and what pixels saw of the lights, "
           "are kept. looked up: maps alone.\ncamera walks: by 1.4 m/s. everything moves: lights, casters and camera "
           "go on by 1/60 s per frame; " +
           std::to_string(times.moving_views_drawn) + " of " + std::to_string(times.moving_views) +
           " views were drawn in the last of them\n";
}

std::string frame_times_json(const FrameTimes& times) {
    nlohmann::ordered_json json;
    json["scene"] = times.scene;
    json["device"] = times.device;
    json["size_px"] = {times.size_px.x, times.size_px.y};
    for (const Named& kind : kKinds) {
        const TimedFrames& frames = times.*kind.frames;
        const std::string key = kind.key;
        json[key + "_us"] = to_json(frames.us);
        json[key + "_cpu_us"] = to_json(frames.cpu_us);
        if (frames.ratio.count == 0) continue;
        json[key + "_ratio"] = to_json(frames.ratio);
        json[key + "_cpu_ratio"] = to_json(frames.cpu_ratio);
    }
    json["moving_views"] = times.moving_views;
    json["moving_views_drawn"] = times.moving_views_drawn;
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
