#include "bench/frame_times.h"

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kSettlingFrames = 3;
constexpr double kUsPerMs = 1000.0;
constexpr double kStep_s = 1.0 / 60.0;
constexpr std::size_t kLineLength = 256;

double timed_frame_us(Stage& stage) {
    stage.device().finish();
    const auto start = std::chrono::steady_clock::now();
    stage.run_frame();
    stage.device().finish();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

double run_block(Stage& stage, bool shadows, bool economy, std::uint32_t frames, std::vector<double>& all) {
    stage.show_shadows(shadows);
    stage.set_economy(economy);
    for (std::uint32_t i = 0; i < kSettlingFrames; ++i) stage.run_frame();
    std::vector<double> block;
    for (std::uint32_t i = 0; i < frames; ++i) block.push_back(timed_frame_us(stage));
    all.insert(all.end(), block.begin(), block.end());
    return spread_of(block).median;
}

double run_moving_block(Stage& stage, bool shadows, std::uint32_t frames, std::vector<double>& all) {
    stage.show_shadows(shadows);
    stage.set_economy(true);
    std::vector<double> block;
    for (std::uint32_t i = 0; i < kSettlingFrames + frames; ++i) {
        stage.move_to(stage.time_s() + i * kStep_s);
        if (i < kSettlingFrames)
            stage.run_frame();
        else
            block.push_back(timed_frame_us(stage));
    }
    all.insert(all.end(), block.begin(), block.end());
    return spread_of(block).median;
}

std::string line(const char* what, const Spread& us, const Spread* ratio) {
    char text[kLineLength];
    int used = std::snprintf(text, sizeof text, "%-28s %9.2f ms (%.2f-%.2f)", what, us.median / kUsPerMs,
                             us.min / kUsPerMs, us.max / kUsPerMs);
    if (ratio && used > 0)
        std::snprintf(text + used, sizeof text - static_cast<std::size_t>(used), "  x %.3f (%.3f-%.3f)", ratio->median,
                      ratio->min, ratio->max);
    return std::string(text) + "\n";
}

nlohmann::ordered_json to_json(const Spread& s) {
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}, {"count", s.count}};
}

}  // namespace

FrameTimes measure_frame_times(Stage& stage, std::uint32_t rounds, std::uint32_t frames) {
    FrameTimes times;
    times.scene = stage.scene_name();
    times.device = stage.device().info().name;
    stage.device().set_timing(gl::TimingMode::off);  // finishing around every pass would slow the frame itself
    std::vector<double> without, kept, redrawn, kept_ratio, redrawn_ratio, moving_without, moving, moving_ratio;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const double base = run_block(stage, false, true, frames, without);
        kept_ratio.push_back(run_block(stage, true, true, frames, kept) / base);
        redrawn_ratio.push_back(run_block(stage, true, false, frames, redrawn) / base);
    }
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const double base = run_moving_block(stage, false, frames, moving_without);
        moving_ratio.push_back(run_moving_block(stage, true, frames, moving) / base);
    }
    for (const LightReport& light : stage.frame().report().lights) {
        times.moving_views += light.views;
        times.moving_views_drawn += light.views_drawn;
    }
    if (!stage.frame().snapshot().consumers.empty())
        times.size_px = stage.frame().snapshot().consumers.front().viewport_px;
    times.without_us = spread_of(without);
    times.kept_us = spread_of(kept);
    times.redrawn_us = spread_of(redrawn);
    times.kept_ratio = spread_of(kept_ratio);
    times.redrawn_ratio = spread_of(redrawn_ratio);
    times.moving_without_us = spread_of(moving_without);
    times.moving_us = spread_of(moving);
    times.moving_ratio = spread_of(moving_ratio);
    return times;
}

std::string frame_times_table(const FrameTimes& times) {
    std::string text = "scene   " + times.scene + "\ndevice  " + times.device + "\npicture " +
                       std::to_string(times.size_px.x) + " x " + std::to_string(times.size_px.y) + "\n\n";
    text += line("without shadows", times.without_us, nullptr);
    text += line("with shadows, maps kept", times.kept_us, &times.kept_ratio);
    text += line("with shadows, maps redrawn", times.redrawn_us, &times.redrawn_ratio);
    text += line("everything moves, without", times.moving_without_us, nullptr);
    text += line("everything moves, shadows", times.moving_us, &times.moving_ratio);
    return text +
           "\nmedian (min-max) of whole frames until the device has finished; x: ratio per round to the same without "
           "shadows.\neverything moves: lights, casters and camera go on by 1/60 s per frame; " +
           std::to_string(times.moving_views_drawn) + " of " + std::to_string(times.moving_views) +
           " views were drawn in the last of them\n";
}

std::string frame_times_json(const FrameTimes& times) {
    nlohmann::ordered_json json;
    json["scene"] = times.scene;
    json["device"] = times.device;
    json["size_px"] = {times.size_px.x, times.size_px.y};
    json["without_us"] = to_json(times.without_us);
    json["kept_us"] = to_json(times.kept_us);
    json["redrawn_us"] = to_json(times.redrawn_us);
    json["kept_ratio"] = to_json(times.kept_ratio);
    json["redrawn_ratio"] = to_json(times.redrawn_ratio);
    json["moving_without_us"] = to_json(times.moving_without_us);
    json["moving_us"] = to_json(times.moving_us);
    json["moving_ratio"] = to_json(times.moving_ratio);
    json["moving_views"] = times.moving_views;
    json["moving_views_drawn"] = times.moving_views_drawn;
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
