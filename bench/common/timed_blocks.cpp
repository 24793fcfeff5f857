#include "bench/common/timed_blocks.h"

#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>

namespace gnomon::bench {
namespace {

constexpr double kUsPerS = 1.0e6, kWalk_m_s = 1.4;

void time_frame(Stage& stage, BlockTimes& times) {
    stage.device().finish();
    const std::clock_t cpu_start = std::clock();
    const auto start = std::chrono::steady_clock::now();
    stage.run_frame();
    stage.device().finish();
    times.us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    times.cpu_us.push_back(static_cast<double>(std::clock() - cpu_start) * kUsPerS / CLOCKS_PER_SEC);
}

}  // namespace

TimedRounds::Medians TimedRounds::add(const BlockTimes& block, const Medians* base) {
    all_.us.insert(all_.us.end(), block.us.begin(), block.us.end());
    all_.cpu_us.insert(all_.cpu_us.end(), block.cpu_us.begin(), block.cpu_us.end());
    const Medians medians{spread_of(block.us).median, spread_of(block.cpu_us).median};
    if (base) ratios_.us.push_back(medians.us / base->us);
    if (base) ratios_.cpu_us.push_back(medians.cpu_us / base->cpu_us);
    return medians;
}

TimedFrames TimedRounds::frames() const {
    return {spread_of(all_.us), spread_of(all_.cpu_us), spread_of(ratios_.us), spread_of(ratios_.cpu_us)};
}

nlohmann::ordered_json to_json(const Spread& s) {
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}, {"count", s.count}};
}

BlockTimes time_frames(Stage& stage, std::uint32_t frames, const BeforeFrame& before, std::uint32_t settling) {
    BlockTimes block;
    for (std::uint32_t i = 0; i < settling + frames; ++i) {
        before(i);
        if (i < settling)
            stage.run_frame();
        else
            time_frame(stage, block);
    }
    return block;
}

Walk::Walk(Stage& stage) : stage_(stage) {
    if (stage.spawned().cameras.empty()) return;
    camera_ = stage.spawned().cameras.front().entity;
    rest_ = *stage.world().get<Transform>(camera_);
}

void Walk::place(double time_s) {
    if (camera_ == ecs::Entity{}) return;
    const glm::dvec3 ahead = rest_.rotation * glm::dvec3(0.0, 0.0, -1.0);
    stage_.world().patch<Transform>(
        camera_, [&](Transform& t) { t.translation_m = rest_.translation_m + ahead * (kWalk_m_s * time_s); });
}

}  // namespace gnomon::bench
