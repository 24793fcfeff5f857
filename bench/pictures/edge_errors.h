#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "systems/frame_system.h"

/// Pictures of a still scene with one sample per pixel, smoothed, and with many samples. The last judges the others.
namespace gnomon::bench {

using Rgba = std::vector<std::uint8_t>;

struct EdgePictures {
    Rgba one, smooth, many;  // top row first
};

/// Mean squared differences to the picture of many samples, in steps of 1/255.
struct EdgeErrors {
    double one = 0.0, smooth = 0.0;          // over the pixels in which one sample differs visibly
    double one_all = 0.0, smooth_all = 0.0;  // over all
    double share = 0.0;                      // share of pixels that differ visibly
};

/// Differences above this are visible; others are rounding. Steps of 1/255.
inline constexpr int kVisibleSteps = 2;

/// Draws until the picture has all samples of `settings`. Empty: it never has, or cannot be read.
inline Rgba finished_picture(FrameSystem& frame, ecs::Registry& world, const FrameSettings& settings) {
    constexpr std::uint32_t kMostFrames = 120;
    for (std::uint32_t i = 0; i < settings.still_samples + kMostFrames; ++i) {
        frame.run(world, settings);
        if (i >= 2 && frame.report().samples == settings.still_samples) break;
    }
    Rgba rgba;
    if (frame.report().samples != settings.still_samples || !frame.read_picture(rgba)) rgba.clear();
    return rgba;
}

/// Draws all three. Empty: one cannot be drawn.
inline std::optional<EdgePictures> draw_edges(FrameSystem& frame, ecs::Registry& world, FrameSettings settings,
                                              std::uint32_t samples) {
    EdgePictures pictures;
    pictures.one = finished_picture(frame, world, settings);
    settings.smooth_edges = true;
    pictures.smooth = finished_picture(frame, world, settings);
    settings.still_samples = samples;
    pictures.many = finished_picture(frame, world, settings);
    if (pictures.one.empty() || pictures.smooth.empty() || pictures.many.empty()) return std::nullopt;
    return pictures;
}

inline EdgeErrors edge_errors(const EdgePictures& pictures) {
    EdgeErrors sum;
    const std::size_t pixels = pictures.many.size() / 4;
    std::size_t visible = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        double one = 0.0, smooth = 0.0;
        int most = 0;
        for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
            const int of_one = int{pictures.one[c]} - pictures.many[c];
            const int of_smooth = int{pictures.smooth[c]} - pictures.many[c];
            one += of_one * of_one / 3.0;
            smooth += of_smooth * of_smooth / 3.0;
            most = std::max(most, std::abs(of_one));
        }
        sum.one_all += one / static_cast<double>(pixels);
        sum.smooth_all += smooth / static_cast<double>(pixels);
        if (most <= kVisibleSteps) continue;
        ++visible;
        sum.one += one;
        sum.smooth += smooth;
    }
    sum.one /= static_cast<double>(std::max<std::size_t>(visible, 1));
    sum.smooth /= static_cast<double>(std::max<std::size_t>(visible, 1));
    sum.share = static_cast<double>(visible) / static_cast<double>(pixels);
    return sum;
}

}  // namespace gnomon::bench
