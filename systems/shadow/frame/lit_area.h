#pragma once
#include "engine/gl/commands.h"

namespace gnomon::shadow {

/// Part of a camera's picture that a light can light, shadowed or not. Conservative.
struct LitArea {
    gl::Rect reach{};  // pixels within the light's range; empty: none
    /// Lower bound on the reversed depths, in [0,1], of surfaces in `reach`, of undeclared surfaces, too. 0: no bound;
    /// the sky has 0, too.
    float reach_depth = 0.0f;
    gl::Rect screen{};            // pixels of the scene's instances within its range and cone; empty: none
    float farthest_depth = 0.0f;  // the same bound for these instances
};

}  // namespace gnomon::shadow
