#pragma once
#include <cstdint>

namespace gnomon {

/// Rows of the filter table (systems/shadow/filter_table.h), one per shaders/shadow/filters file.
enum class ShadowFilter : std::uint8_t { hard, hardware_2x2, pcf_3x3, count };

/// `automatic` derives the smallest offset that keeps a plane from shadowing itself;
/// `constant` adds bias_m along the light and nothing else (to compare with).
enum class BiasMode : std::uint8_t { automatic, constant };

/// Add this to a Light's entity and the light casts shadows; remove it and its map is freed.
struct LightShadow {
    bool enabled = true;
    ShadowFilter filter = ShadowFilter::hard;  // the row that measures best (docs/accuracy.md)
    std::uint32_t resolution_px = 0;   // edge of one map or cube face; 0: chosen by the system
    float max_error_px = 1.0f;         // how far a shadow edge may be off on screen; > 0
    BiasMode bias = BiasMode::automatic;
    float bias_m = 0.0f;               // used by BiasMode::constant; metres along the light, >= 0
    bool economy = true;               // false: redraw every view every frame, change nothing else
    bool operator==(const LightShadow&) const = default;
};

}  // namespace gnomon
