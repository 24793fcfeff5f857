#pragma once
#include <cstdint>

namespace gnomon::shadow {

/// What of a light's filter settings holds: what is absurd is left out, what its map cannot bear is cut.
struct FilterDemand {
    std::uint32_t size = 3, taps = 16;
    /// E without the spread: what a program is compiled with.
    float reach_texel = 0.5f;
    /// In metres where above 0, else in texels; 0 of a filter that has none. Never more than most_spread_texel.
    float spread_m = 0.0f, spread_texel = 0.0f, most_spread_texel = 0.0f;
    float doubles_m = 0.0f;
    float cell_m = 1.0f;
    /// Size of the source: metres, and the tangent of a sun's angular radius. Both 0 of a filter that does not ask.
    float source_radius_m = 0.0f, sun_radius_tan = 0.0f;
    /// Bound on E: what a map's border leaves room for.
    float widest_texel = 0.5f;
    /// What of E cannot move an edge.
    float still_texel = 0.0f;
    /// What a map's border is made for, twice over: for what is read beside a point and for what the bias moves it. Of
    /// a penumbra the first alone, hence half.
    float border_texel = 0.5f;
    bool cut = false;  // not all is as asked for
};

}  // namespace gnomon::shadow
