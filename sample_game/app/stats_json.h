#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "gnomon/frame.h"
#include "gnomon/result.h"
#include "sample_game/game/rules.h"

/// The file of --stats; its keys are listed in docs/reference/statistics.md.
namespace gnomon::game {

/// Returns one entry of "frames".
nlohmann::ordered_json frame_stats(const FrameReport& report, std::uint64_t index, double time_s);

/// Frames are kept as they come and written at once.
class StatsFile {
public:
    explicit StatsFile(std::string device) : device_(std::move(device)) {}
    /// Adds a frame. `game`: null if none is played.
    void add(const FrameReport& report, std::uint64_t index, double time_s, const GameState* game);
    /// Sets the accuracy of the last frame: truth_stats().
    void set_truth(nlohmann::ordered_json truth) { truth_ = std::move(truth); }
    std::optional<Error> write(const std::filesystem::path& file) const;

private:
    std::string device_;
    nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json truth_;  // null: without --truth
};

}  // namespace gnomon::game
