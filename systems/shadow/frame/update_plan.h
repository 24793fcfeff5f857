#pragma once
#include <cstdint>

#include "components/light_shadow.h"
#include "engine/gl/device.h"

namespace gnomon::shadow {

/// How a view that is drawn uses the copy of its static casters (update/static_caster_copy.h).
enum class StillUse : std::uint8_t {
    none,
    fill,  // static casters are drawn into the map and copied, before the others are drawn
    copy   // they are copied back instead of being drawn
};

/// Why a view whose casters moved keeps the map that it has.
enum class Hold : std::uint8_t {
    none,
    within_error,  // LightShadow::refresh_error_px
    by_turn        // a budget: others are drawn in this frame (Grant::refresh_frames, update_scheduler.h)
};

/// How far off shadows are in a map of casters as they were (stale_error.h). Infinite: unknown.
struct Staleness {
    double moved_m = 0.0;   // farthest that any point of a caster moved since
    double error_px = 0.0;  // how much farther off a shadow edge may be on screen
};

/// What is done with a view's map in this frame: drawn, kept, or left to rays.
struct UpdatePlan {
    bool left_to_rays = false;         // its map is not worth drawing: rays stand in
    bool reuse = false;                // the layer is kept
    Hold hold = Hold::none;            // although casters moved
    Staleness stale{};                 // what that means; else 0
    Staleness if_held{};               // what keeping the layer would mean
    bool changed = false;              // the layer shows other than what it should
    std::uint64_t content = 0;         // hash of what the layer holds after this frame
    std::uint64_t shown_content = 0;   // hash of what the layer held before it
    std::uint32_t waited_frames = 0;   // number of frames for which it was kept by turns
    bool convert = false;              // the prefiltered map is made anew
    std::uint64_t moment_content = 0;  // hash of what that is to hold
    StillUse still_use = StillUse::none;
    gl::TextureHandle still{}, still_triangles{};  // the copy of static casters, if used
    gl::TargetHandle whole{};  // all layers of the light's map, where one pass draws all of its views; else {0}
    CubeRoute route = CubeRoute::six_passes;
};

/// Keeps what the layer holds, for this frame.
inline void keep_layer(UpdatePlan& plan, Hold why) {
    plan.hold = why;
    plan.content = plan.shown_content;
    plan.stale = plan.if_held;
    plan.reuse = true;
}

}  // namespace gnomon::shadow
