#pragma once
#include "components/shadow_tuning.h"
#include "engine/gl/device.h"

namespace gnomon::shadow {

/// A way to store depth, and what it costs in truth.
struct DepthFormatRow {
    DepthFormat id;
    gl::Format texture;
    /// Distance between two values that can be stored, as a share of the whole range. 0: floats, whose distance is a
    /// share of the value itself and is counted where values are (shaders/shadow/lookup/bias/automatic.glsl).
    double step;
};

inline constexpr DepthFormatRow kDepthFormats[] = {
    {DepthFormat::d32f, gl::Format::d32f, 0.0},
    {DepthFormat::d24, gl::Format::d24, 1.0 / 16777215.0},
    {DepthFormat::d16, gl::Format::d16, 1.0 / 65535.0},
};

/// Of a value outside the enumeration: d32f's.
constexpr const DepthFormatRow& depth_format_row(DepthFormat format) {
    for (const DepthFormatRow& row : kDepthFormats)
        if (row.id == format) return row;
    return kDepthFormats[0];
}

}  // namespace gnomon::shadow
