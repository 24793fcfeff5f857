#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Flicker of shadows' edges: how much a picture's visibility at fixed points of the world changes from frame to frame
/// that the truth does not. An error that stays is none.
namespace gnomon::oracle {

/// What the pixel that shows a point of the world has in one frame.
enum class WatchedState : std::uint8_t {
    outside,    // the point is not in the picture
    hidden,     // the pixel's centre shows another surface
    unreached,  // the light does not reach or face all of the pixel's area
    partial,    // the pixel shows another surface, too
    whole,      // its whole area is on the point's surface
};
inline constexpr std::size_t kWatchedStates = 5;

struct WatchedTruth {
    WatchedState state = WatchedState::outside;
    float lit = 0.0f;  // share of the pixel's area that the light reaches; of partial and whole pixels alone
    bool is_crossed() const { return state == WatchedState::whole && lit > 0.0f && lit < 1.0f; }
};

/// A pair is a point in two successive frames. It counts if the point's pixel is whole in both.
struct AreaFlicker {
    std::size_t pairs = 0;  // an edge crosses the pixel in either frame; the figures below are of these
    double mean = 0.0;      // |change of visibility - change of the lit share|
    double p99 = 0.0;
    double truth = 0.0;                             // mean |change of the lit share|
    std::size_t uncrossed = 0;                      // counted pairs that no edge crosses in either frame
    double uncrossed_mean = 0.0;                    // the same difference over these
    std::size_t left_out[kWatchedStates - 1] = {};  // pairs by the first state, other than whole, that one of them has
};

/// Compares changes along a path. Outer: frames; inner: points, as many in every frame. A visibility below 0, where the
/// picture has no surface, makes a difference of 1.
AreaFlicker compare_changes(std::span<const std::vector<WatchedTruth>> truth,
                            std::span<const std::vector<float>> visibility);

}  // namespace gnomon::oracle
