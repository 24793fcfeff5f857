#include "systems/truth/error_tints.h"

#include <algorithm>
#include <cmath>

#include "systems/truth/error_colours.h"

namespace gnomon::truth {
namespace {

constexpr std::uint8_t kVeil = 110, kHeavy = 200, kHalo = 120, kFaint = 60, kOpaque = 255;
constexpr float kHalf = 0.5f;
constexpr Colour kDarker{0, 0, 0, kVeil};

/// Error of the worst light at a pixel; ambiguous lights do not count.
struct Worst {
    float off = 0.0f;
    bool wrong = false, ambiguous = false;
    Colour colour = kDarker;
};

/// Returns whether the pixel is off by more than a half. A half in place of none counts as that, too.
bool is_wrong(const ComparedPixel& pixel) {
    if (!(pixel.measured >= 0.0f)) return true;
    return pixel.measured - pixel.truth >= kHalf || pixel.truth - pixel.measured > kHalf;
}

Worst worst_of(std::span<const DrawnLight> lights, std::size_t i) {
    Worst worst;
    for (const DrawnLight& light : lights) {
        if (light.truth->scored[i] == 0) continue;
        if (light.truth->ambiguous[i] != 0) {
            worst.ambiguous = true;
            continue;
        }
        const ComparedPixel pixel{light.truth->visibility[i], light.measured[i], true, false};
        const bool covered = pixel.measured >= 0.0f;
        bool wrong = is_wrong(pixel);
        float off = covered ? pixel.measured - pixel.truth : -1.0f;
        if (!light.tint_off.empty() && std::abs(light.tint_off[i]) > std::abs(off)) {
            off = light.tint_off[i];
            wrong = std::abs(off) > kHalf;
        }
        if (!(std::abs(off) > worst.off)) continue;
        worst.off = std::abs(off);
        worst.wrong = wrong;
        const bool bright = off > 0.0f;
        worst.colour =
            error_colour(covered ? ComparedPixel{bright ? 0.0f : 1.0f, bright ? 1.0f : 0.0f, true, false} : pixel);
    }
    return worst;
}

std::uint8_t scaled(int byte, float share) {
    return static_cast<std::uint8_t>(std::lround(static_cast<float>(byte) * share));
}

Colour tint_of(const Worst& worst) {
    Colour tint = worst.colour;
    if (worst.wrong) {
        tint[3] = kOpaque;
    } else if (worst.ambiguous && !(worst.off > 0.0f)) {
        tint = {kOpaque, kOpaque, kOpaque, kFaint};
    } else if (worst.off > 0.0f) {
        const float share = std::min(worst.off / kHalf, 1.0f);
        for (std::uint8_t& channel : tint) channel = scaled(channel, share);
        tint[3] = static_cast<std::uint8_t>(kVeil + scaled(kHeavy - kVeil, share));
    }
    return tint;
}

class Canvas {
public:
    Canvas(glm::uvec2 size_px, std::vector<std::uint8_t>& rgba)
        : width_(static_cast<int>(size_px.x)), height_(static_cast<int>(size_px.y)), rgba_(rgba) {
        rgba_.resize(std::size_t{4} * size_px.x * size_px.y);
    }
    void put(std::size_t pixel, const Colour& colour) {
        std::copy(colour.begin(), colour.end(), rgba_.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
    }
    void put_halo(std::size_t pixel, Colour colour) {
        colour[3] = kHalo;
        const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
        for (int row = std::max(y - kHalo_px, 0); row <= std::min(y + kHalo_px, height_ - 1); ++row)
            for (int column = std::max(x - kHalo_px, 0); column <= std::min(x + kHalo_px, width_ - 1); ++column)
                put(static_cast<std::size_t>(row * width_ + column), colour);
    }

private:
    int width_, height_;
    std::vector<std::uint8_t>& rgba_;
};

}  // namespace

void tint_errors(glm::uvec2 size_px, std::span<const DrawnLight> lights, std::vector<std::uint8_t>& rgba) {
    Canvas canvas(size_px, rgba);
    const std::size_t pixels = std::size_t{size_px.x} * size_px.y;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < pixels; ++i) {
        const Worst worst = worst_of(lights, i);
        if (worst.wrong) wrong.push_back(i);
        canvas.put(i, tint_of(worst));
    }
    for (const std::size_t i : wrong) canvas.put_halo(i, worst_of(lights, i).colour);
    for (const std::size_t i : wrong) canvas.put(i, tint_of(worst_of(lights, i)));
}

}  // namespace gnomon::truth
