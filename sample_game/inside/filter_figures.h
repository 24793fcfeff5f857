#pragma once
#include <cstdint>

#include "gnomon/light.h"

/// Facts of Gnomon's tables of filters and light kinds, for --list and panels.
namespace gnomon::game {

enum class FilterRays : std::uint8_t { none, one, to_source };
/// Settings by which a footprint's width is chosen: none, ShadowTuning::Kernel::size_texel, the spreads, the source.
enum class FilterExtent : std::uint8_t { fixed, size, spread, source };

struct FilterFigures {
    std::uint32_t taps = 0, cube_taps = 0;  // fetches per lookup with default settings; for a point light's cube
    float widest_texel = 0.0f;              // half-width of its footprint, E, with default settings
    const char* sampler = "";               // content of its map, and how it is read
    FilterRays rays = FilterRays::none;
    FilterExtent extent = FilterExtent::fixed;
    bool prefiltered = false;                       // its maps are blurred moments
    bool has_exponent = false, has_second = false;  // moments of a warped distance; of a second warp, too
    bool keeps_depths = true;                       // false: its maps are bounds of depths
    bool antialiases = false;                       // LightShadow::antialias counts
    bool random = false;                            // its taps or rays differ by a seed
};

/// Returns the figures of a filter; of `automatic`, those of the filter that it usually is.
FilterFigures figures_of(ShadowFilter filter);

/// Returns the filter of such a light. For `automatic` that is its usual filter.
ShadowFilter filter_of(ShadowFilter wanted, LightKind kind);

/// Returns whether the rays of such lights are parallel, or go in all directions.
bool is_sun(LightKind kind);
bool is_point(LightKind kind);
/// Returns whether the source of such lights has a width, a height, a radius that it cannot be without.
bool has_width(LightKind kind);
bool has_height(LightKind kind);
bool has_radius(LightKind kind);

}  // namespace gnomon::game
