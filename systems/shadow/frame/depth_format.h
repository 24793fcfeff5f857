#pragma once
#include "engine/gl/device.h"
#include "gnomon/shadow_tuning.h"

namespace gnomon::shadow {

/// Format of a depth texture and its precision.
struct DepthFormatRow {
    DepthFormat id;
    gl::Format texture;
    /// Distance between neighbouring stored values, as a share of the depth range. 0: floats. Their distance depends on
    /// the value, so that the lookup computes it (shaders/shadow/lookup/bias/automatic.glsl).
    double step;
};

inline constexpr DepthFormatRow kDepthFormats[] = {
    {DepthFormat::d32f, gl::Format::d32f, 0.0},
    {DepthFormat::d24, gl::Format::d24, 1.0 / 16777215.0},
    {DepthFormat::d16, gl::Format::d16, 1.0 / 65535.0},
};

/// Returns the row of a format; d32f's for a value outside the enumeration.
constexpr const DepthFormatRow& depth_format_row(DepthFormat format) {
    for (const DepthFormatRow& row : kDepthFormats)
        if (row.id == format) return row;
    return kDepthFormats[0];
}

}  // namespace gnomon::shadow
