#include "bench/frame/frame_times.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/common/timed_blocks.h"
#include "bench/common/units.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kTimesLength = 256;

void set(Stage& stage, bool shadows, bool economy, bool keep_visibility) {
    stage.show_shadows(shadows);
    stage.set_economy(economy);
    (void)stage.apply_setting(keep_visibility ? "keep_visibility=on" : "keep_visibility=off");
}

std::string line(const char* what, const TimedFrames& frames) {
    char text[kTimesLength];
    int used = std::snprintf(text, sizeof text, "%-28s %9.2f ms (%.2f-%.2f), processor %.2f ms", what,
                             frames.us.median / kUsPerMs, frames.us.min / kUsPerMs, frames.us.max / kUsPerMs,
                             frames.cpu_us.median / kUsPerMs);
    if (frames.ratio.count > 0 && used > 0)
        std::snprintf(text + used, sizeof text - static_cast<std::size_t>(used), "  x %.3f (%.3f-%.3f), x %.3f",
                      frames.ratio.median, frames.ratio.min, frames.ratio.max, frames.cpu_ratio.median);
    return std::string(text) + "\n";
}

/// Name of each kind of frame, in the table and in the file.
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
    TimedRounds without, kept, looked_up, redrawn, walk_without, walk, moving_without, moving;
    const BeforeFrame still = [](std::uint32_t) {};
    const auto run = [&](bool shadows, bool economy, bool keep_visibility, const BeforeFrame& step) {
        set(stage, shadows, economy, keep_visibility);
        return time_frames(stage, frames, step);
    };
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const TimedRounds::Medians base = without.add(run(false, true, true, still), nullptr);
        kept.add(run(true, true, true, still), &base);
        looked_up.add(run(true, true, false, still), &base);
        redrawn.add(run(true, false, true, still), &base);
    }
    {
        Walk way(stage);
        const BeforeFrame ahead = [&](std::uint32_t i) { way.place((i + 1) * kStep_s); };
        for (std::uint32_t round = 0; round < rounds; ++round) {
            const TimedRounds::Medians base = walk_without.add(run(false, true, true, ahead), nullptr);
            walk.add(run(true, true, true, ahead), &base);
        }
    }
    const BeforeFrame on = [&](std::uint32_t i) { stage.move_to(stage.time_s() + i * kStep_s); };
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const TimedRounds::Medians base = moving_without.add(run(false, true, true, on), nullptr);
        moving.add(run(true, true, true, on), &base);
    }
    for (const LightReport& light : stage.frame().report().lights) {
        times.moving_views += light.counts.views;
        times.moving_views_drawn += light.counts.views_drawn;
    }
    if (!stage.frame().snapshot().consumers.empty())
        times.size_px = stage.frame().snapshot().consumers.front().viewport_px;
    const std::array<const TimedRounds*, kKinds.size()> all = {&without,      &kept, &looked_up,      &redrawn,
                                                               &walk_without, &walk, &moving_without, &moving};
    for (std::size_t i = 0; i < kKinds.size(); ++i) times.*kKinds[i].frames = all[i]->frames();
    return times;
}

std::string frame_times_table(const FrameTimes& times) {
    std::string text = "scene   " + times.scene + "\ndevice  " + times.device + "\npicture " +
                       std::to_string(times.size_px.x) + " x " + std::to_string(times.size_px.y) + "\n\n";
    for (const Named& kind : kKinds) text += line(kind.words, times.*kind.frames);
    return text + "\nin the last frame with everything moving " + std::to_string(times.moving_views_drawn) + " of " +
           std::to_string(times.moving_views) + " views were drawn\nWhat the columns mean: bench frame --help\n";
}

std::string frame_legend() {
    return "Rows and columns of the tables:\n"
           "  ms               median (least-most) of whole frames until the device has finished\n"
           "  processor        the process's time on all cores\n"
           "  x                ratios per round to the same without shadows, of time and of processor time; with\n"
           "                   --against: to the other way\n"
           "  still            maps, and visibility per pixel, are reused\n"
           "  still, looked up maps are reused, every pixel is looked up; so it is with --against, in every row\n"
           "  camera walks     by 1.4 m/s\n"
           "  everything moves lights, casters and camera go on by 1/60 s per frame\n";
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
