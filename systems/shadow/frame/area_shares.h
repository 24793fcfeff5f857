#pragma once
#include <cstdint>

namespace gnomon::shadow {

/// Way of a filter to the lit share of a pixel's area (LightShadow::antialias).
/// - marked: pixels that an edge may cross are marked, and looked up once more (systems/lighting/edge_pass.h)
/// - spread: taps and rays to a source with a size begin all over the area
enum class AreaShares : std::uint8_t { none, marked, spread };

}  // namespace gnomon::shadow
