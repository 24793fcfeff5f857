#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// A budget is of a frame, what it shares out is an average over frames: where many views are due at once, because one
/// thing moved that all of them show, some wait for the next frames.
namespace gnomon::shadow {

/// A view that is to be drawn in this frame.
struct DueView {
    static constexpr double kMustNotWait = std::numeric_limits<double>::infinity();
    std::size_t view = 0;   // index into ShadowFrame::views
    double ns = 0.0;        // that drawing it takes
    double harm = 0.0;      // what is lost by leaving it as it is for now, or kMustNotWait
    std::uint64_t key = 0;  // of the view itself, wherever it stands in a list: decides between equals
};

/// No view waits for longer: every fourth frame is as slow as a budget makes any light (Grant::refresh_frames), slower
/// ones are seen to jump.
inline constexpr std::uint32_t kMostWait_frames = 3;

/// Moves those that wait to the front, and says how many they are. Those go first that lose least for what they free,
/// until the others take no more than `room_ns`, or than the largest of all: one view at least is drawn, since its
/// light's share is of an average frame. Then whoever still fits is let off, what would lose most first. None waits for
/// nothing: where all fit, none does. The order in which they are given decides nothing.
std::size_t choose_waiting(double room_ns, std::vector<DueView>& due);

}  // namespace gnomon::shadow
