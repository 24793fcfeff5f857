#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// Deferral of views within a frame's budget. The budget's allocation is an average over frames. Many views are due at
/// once when one object moves that all of them show. Some of them are then drawn in later frames.
namespace gnomon::shadow {

/// View that is due in this frame.
struct DueView {
    static constexpr double kMustNotWait = std::numeric_limits<double>::infinity();
    std::size_t view = 0;   // index into FittedViews::views
    double ns = 0.0;        // time of drawing it
    double harm = 0.0;      // error cost of keeping it as it is for now, or kMustNotWait
    std::uint64_t key = 0;  // hash of the view itself, independent of its place in a list: decides between equals
};

/// Most frames for which a view is deferred. Every fourth frame is also the slowest refresh that a budget allows
/// (QualityLimits::refresh_frames). Slower updates are seen to jump.
inline constexpr std::uint32_t kMostWait_frames = 3;

/// Moves deferred views to the front of `due` and returns their number. Greedy: defers the view with the least error
/// cost per ns until the rest fits `room_ns`. At least the time of the largest view counts as room, so that one view is
/// always drawn. Then admits deferred views that still fit, the greatest error cost first. No view is deferred if all
/// fit. The result is independent of the input order.
std::size_t choose_waiting(double room_ns, std::vector<DueView>& due);

}  // namespace gnomon::shadow
