#pragma once
#include <array>
#include <cstdint>

/// How pictures of visibility and of its errors are coloured; bench/README.md has the legend.
namespace gnomon::truth {

using Colour = std::array<std::uint8_t, 4>;

/// Black to white; surfaces that are none have a colour of their own.
Colour visibility_colour(float visibility);

/// One pixel's truth and what was measured there.
struct ComparedPixel {
    float truth = -1.0f, measured = -1.0f;
    bool scored = false, ambiguous = false;
};
/// Against the truth about a point: on which side of 1/2 each lies.
Colour error_colour(const ComparedPixel& pixel);
/// Against the truth about a disk: the truth in grey, red as far as light is missing, blue as far as it is too much.
Colour soft_error_colour(const ComparedPixel& pixel);

}  // namespace gnomon::truth
