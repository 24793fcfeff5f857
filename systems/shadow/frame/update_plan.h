#pragma once
#include <cstdint>

#include "engine/gl/device.h"
#include "gnomon/light.h"
#include "gnomon/shadow_tuning.h"

namespace gnomon::shadow {

/// How a drawn view uses the copy of its static casters (update/static_caster_copy.h).
enum class StaticCopyUse : std::uint8_t {
    none,
    fill,  // static casters are drawn into the map, which is then copied before dynamic casters are drawn
    copy   // static casters are copied into the map instead of being drawn
};

/// Copy of a view's static casters, and what becomes of it. Without use there are no textures.
struct StaticCopyPlan {
    StaticCopyUse use = StaticCopyUse::none;
    gl::TextureHandle texture{}, triangles{};
};

/// Reason to keep a stale map after its casters moved.
enum class Hold : std::uint8_t {
    none,
    within_error,  // within LightShadow::refresh_error_px
    by_turn        // deferred by a budget: other views are drawn (QualityLimits::refresh_frames, update_scheduler.h)
};

/// Error of a stale map (stale_error.h). Infinite: unknown.
struct Staleness {
    double moved_m = 0.0;   // largest movement of any point of a caster since the map was drawn
    double error_px = 0.0;  // additional error of a shadow edge on screen
};

/// Plan for a view's map in this frame: draw it, keep it, or skip it for rays.
struct UpdatePlan {
    /// The engine draws some of its casters: it is cleared and begun before the list (engine_draw.h).
    bool begun_by_engine = false;
    bool skipped_for_rays = false;     // rays replace the map, because drawing it costs more
    bool reuse = false;                // the layer is kept
    Hold hold = Hold::none;            // why it is kept although casters moved
    Staleness stale{};                 // error of the kept layer; else 0
    Staleness if_held{};               // error that keeping the layer would cause
    bool changed = false;              // the layer's content differs from the required one
    std::uint64_t content = 0;         // hash of the layer's content after this frame
    std::uint64_t shown_content = 0;   // hash of the layer's content at the frame's start
    std::uint32_t waited_frames = 0;   // consecutive frames for which its update was deferred
    bool convert = false;              // the prefiltered map is computed again
    std::uint64_t moment_content = 0;  // hash of the prefiltered map's content after that
    StaticCopyPlan copy;
    gl::TargetHandle whole{};  // all layers of the light's map, where one pass draws all of its views; else {0}
    CubeRoute route = CubeRoute::six_passes;
};

/// Keeps the layer's content for this frame.
inline void keep_layer(UpdatePlan& plan, Hold why) {
    plan.hold = why;
    plan.content = plan.shown_content;
    plan.stale = plan.if_held;
    plan.reuse = true;
}

}  // namespace gnomon::shadow
