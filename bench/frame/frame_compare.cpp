#include "bench/frame/frame_compare.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/common/units.h"
#include "systems/shadow/request/ray_limit.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kLineLength = 512;
constexpr double kBytesPerMb = 1.0e6;

/// An exact sun gets finer maps once its casters have stayed for so long while the camera moves.
constexpr std::uint32_t kWalkSettlingFrames = shadow::kStaticSunFrames + kSettlingFrames;

/// Motion and drawing while frames are timed.
enum class Going : std::uint8_t { still, drawn_anew, walk, walk_drawn_anew, everything, count };
constexpr std::size_t kGoings = static_cast<std::size_t>(Going::count);

struct Block {
    BlockTimes times;
    std::uint32_t views_drawn = 0;
    std::uint64_t bytes = 0;
};

BlockTimes time_going(Stage& stage, Going going, std::uint32_t frames) {
    stage.set_economy(going != Going::drawn_anew && going != Going::walk_drawn_anew);
    if (going == Going::walk || going == Going::walk_drawn_anew) {
        Walk way(stage);
        return time_frames(
            stage, frames, [&](std::uint32_t i) { way.place((i + 1) * kStep_s); }, kWalkSettlingFrames);
    }
    if (going == Going::everything)
        return time_frames(stage, frames, [&](std::uint32_t i) { stage.move_to(stage.time_s() + i * kStep_s); });
    return time_frames(stage, frames, [](std::uint32_t) {});
}

Block run_going(Stage& stage, Going going, std::uint32_t frames) {
    Block block{time_going(stage, going, frames)};
    for (const LightReport& light : stage.frame().report().lights) {
        block.views_drawn += light.counts.views_drawn;
        block.bytes += light.counts.bytes;
    }
    return block;
}

/// Two kinds of frames that are compared.
struct Pair {
    const char* words;
    const char* key;
    Going own, other;
};
constexpr std::array kPairs = {
    Pair{"still", "still", Going::still, Going::still},
    Pair{"still, the other drawn anew", "still_against_drawn", Going::still, Going::drawn_anew},
    Pair{"camera walks", "walk", Going::walk, Going::walk},
    Pair{"walks, the other drawn anew", "walk_against_drawn", Going::walk, Going::walk_drawn_anew},
    Pair{"everything moves", "moving", Going::everything, Going::everything},
    Pair{"maps drawn anew", "drawn", Going::drawn_anew, Going::drawn_anew},
};

/// Returns whether a comparison needs frames of that kind, from the first settings or the others.
bool is_asked(bool others, Going going) {
    return std::any_of(kPairs.begin(), kPairs.end(),
                       [&](const Pair& p) { return (others ? p.other : p.own) == going; });
}

nlohmann::ordered_json to_json(const FramesAgainst::DepthVariant& way) {
    return {{"us", bench::to_json(way.frames.us)},
            {"cpu_us", bench::to_json(way.frames.cpu_us)},
            {"views_drawn", way.views_drawn},
            {"bytes", way.bytes}};
}

std::string words_of(const std::vector<std::string>& settings) {
    std::string words;
    for (const std::string& setting : settings) words += (words.empty() ? "" : " ") + setting;
    return words.empty() ? "as the scene has them" : words;
}

}  // namespace

Result<FramesAgainst> measure_frames_against(Stage& stage, std::span<const std::string> other_settings,
                                             std::uint32_t rounds, std::uint32_t frames) {
    FramesAgainst times;
    times.scene = stage.scene_name();
    times.device = stage.device().info().name;
    times.settings = stage.options().settings;
    times.other_settings.assign(other_settings.begin(), other_settings.end());
    stage.device().set_timing(gl::TimingMode::off);  // finishing around every pass would slow the frame itself
    std::array<TimedRounds, kPairs.size()> own, other;
    for (const Pair& pair : kPairs) times.rows.push_back({pair.words, pair.key, {}, {}});
    for (std::uint32_t round = 0; round < rounds; ++round) {
        std::array<Block, kGoings> blocks[2];
        // What moves is back in its place before maps are made for the next: both see the same. They take turns, so
        // that a machine that grows slower does so for both.
        for (std::size_t going = 0; going < kGoings; ++going)
            for (const bool others : {false, true}) {
                if (!is_asked(others, static_cast<Going>(going))) continue;
                stage.move_to(stage.time_s());
                if (auto error = stage.start_over(others ? other_settings : std::span<const std::string>{}))
                    return *error;
                blocks[others ? 1 : 0][going] = run_going(stage, static_cast<Going>(going), frames);
            }
        for (std::size_t i = 0; i < kPairs.size(); ++i) {
            const Block& theirs = blocks[1][static_cast<std::size_t>(kPairs[i].other)];
            const Block& ours = blocks[0][static_cast<std::size_t>(kPairs[i].own)];
            const auto base = other[i].add(theirs.times, nullptr);
            own[i].add(ours.times, &base);
            times.rows[i].own = {own[i].frames(), ours.views_drawn, ours.bytes};
            times.rows[i].other = {other[i].frames(), theirs.views_drawn, theirs.bytes};
        }
    }
    return times;
}

std::string frames_against_table(const FramesAgainst& times) {
    std::string text = "scene   " + times.scene + "\ndevice  " + times.device + "\nlights  " +
                       words_of(times.settings) + "\nagainst " + words_of(times.other_settings) + "\n\n";
    for (const FramesAgainst::Row& row : times.rows) {
        char line[kLineLength];
        const TimedFrames& own = row.own.frames;
        std::snprintf(
            line, sizeof line,
            "%-28s %8.2f ms against %8.2f: x %.2f (%.2f-%.2f); views drawn %u : %u, MB %.1f : %.1f\n"
            "%-28s %8.2f ms against %8.2f: x %.2f (%.2f-%.2f)\n",
            row.words, own.us.median / kUsPerMs, row.other.frames.us.median / kUsPerMs, own.ratio.median, own.ratio.min,
            own.ratio.max, row.own.views_drawn, row.other.views_drawn, static_cast<double>(row.own.bytes) / kBytesPerMb,
            static_cast<double>(row.other.bytes) / kBytesPerMb, "  processor", own.cpu_us.median / kUsPerMs,
            row.other.frames.cpu_us.median / kUsPerMs, own.cpu_ratio.median, own.cpu_ratio.min, own.cpu_ratio.max);
        text += line;
    }
    return text + "\nWhat the columns mean: bench frame --help\n";
}

std::string frames_against_json(const FramesAgainst& times) {
    nlohmann::ordered_json json;
    json["scene"] = times.scene;
    json["device"] = times.device;
    json["settings"] = times.settings;
    json["against"] = times.other_settings;
    for (const FramesAgainst::Row& row : times.rows)
        json[row.key] = {{"ratio", to_json(row.own.frames.ratio)},
                         {"cpu_ratio", to_json(row.own.frames.cpu_ratio)},
                         {"own", to_json(row.own)},
                         {"other", to_json(row.other)}};
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
