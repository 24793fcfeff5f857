#pragma once
#include <cstdint>

namespace gnomon {

/// What a frame did for a light's shadow. rendered: a map was drawn. reused: earlier maps are valid. degraded: it has a
/// shadow, with less than was requested. skipped: it is unshadowed; Reason has the cause.
enum class LightState : std::uint8_t { rendered, reused, degraded, skipped };
/// Returns the state's name, as reports and files spell it.
const char* to_text(LightState state);

/// Why a light, or a view of it, has the state that it has. Codes are stable: new ones are added before `count`, none
/// changes its meaning within a major version.
enum class Reason : std::uint8_t {
    none,                 // the shadow is as requested
    no_light_shadow,      // the light has no LightShadow component
    shadows_off,          // LightShadow::enabled is false
    light_off,            // no intensity
    no_visible_receiver,  // no visible surface is within the light's range
    no_caster,            // nothing can darken a visible surface
    below_display_step,   // lit everywhere: it and similar lights change no pixel by more than half a step
    content_unchanged,    // the map of an earlier frame is still valid
    refresh_held,         // shows casters at an earlier place: within refresh_error_px, or deferred by a budget
    /// The default filter's maps miss max_error_px or narrowest_caster_px: the light has a filter that meets them.
    map_too_coarse,
    visibility_kept,     // visibility per pixel from an earlier frame is still valid
    resolution_clamped,  // the requested size is below 16 texels or above the device's limit
    over_budget,         // dropped by the budget in favour of more visible lights
    budget_shrunk,       // reduced by the budget
    ray_budget,          // the budget has no rays left for an exact light: it has a filtered map instead
    rays_off,            // rays are switched off, or the picture has no exact surfaces: a filtered map instead
    rays_cheaper,        // moving exact light: rays for all its pixels cost less than its map
    map_shrunk,          // the requested size could not be allocated, a smaller one could
    map_allocation_failed,
    target_incomplete,
    depth_program_failed,
    lighting_program_failed,
    filter_program_failed,  // the filter's program does not compile: the map is looked up with one tap
    filter_program_waits,   // not compiled yet (the limit of programs per frame): one tap for now
    buffer_failed,
    sampler_failed,
    fit_degenerate,          // no finite volume to render
    projection_unsupported,  // this kind of light has no such projection: its own is used
    eye_invalid,             // a sun's eye distance or angle is invalid: it stays orthographic
    range_invalid,           // near_m and far_m are no valid range: the fitted one is used
    cascades_clamped,        // more cascades than a light can have
    warp_unsupported,  // warp is invalid, or set for other than a tight sun with one camera and a fitted depth range
    splits_invalid,    // split_m, split_lambda or cascade_blend is invalid: the default is used
    depths_unread,     // the picture's depths were unavailable: splits use the receivers' bounds
    filter_cut,        // a setting of the filter is invalid, or beyond what its map allows
    depth_coarse,      // steps of the depth format are wider than the map's texels at receivers
    tint_failed,       // the device cannot hold or draw what translucent casters let through: they cast nothing
    count
};
/// Returns the code's name, as reports and files spell it.
const char* reason_code(Reason reason);
/// Returns one sentence for a person: what happened and, where there is something to do, what.
const char* reason_text(Reason reason);

}  // namespace gnomon
