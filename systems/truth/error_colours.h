#pragma once
#include <array>
#include <cstdint>

/// Colours of pictures of visibility and of its errors; bench/README.md has the legend.
namespace gnomon::truth {

using Colour = std::array<std::uint8_t, 4>;

/// Maps visibility to grey, black to white; pixels without a surface get a colour of their own.
Colour visibility_colour(float visibility);

/// Truth and measurement at a pixel.
struct ComparedPixel {
    float truth = -1.0f, measured = -1.0f;
    bool scored = false, ambiguous = false;
};
/// Compares with the truth about a point light: colours by the side of 1/2 on which each value lies.
Colour error_colour(const ComparedPixel& pixel);
/// Compares with the truth about an area light: truth in grey, red for missing light, blue for excess light.
Colour soft_error_colour(const ComparedPixel& pixel);

}  // namespace gnomon::truth
