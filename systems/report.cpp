#include "gnomon/frame.h"

namespace gnomon {

const char* to_text(LightState state) {
    switch (state) {
        case LightState::rendered:
            return "rendered";
        case LightState::reused:
            return "reused";
        case LightState::degraded:
            return "degraded";
        case LightState::skipped:
            return "skipped";
    }
    return "unknown";
}

const char* reason_code(Reason reason) {
    switch (reason) {
        case Reason::none:
            return "none";
        case Reason::no_light_shadow:
            return "no_light_shadow";
        case Reason::shadows_off:
            return "shadows_off";
        case Reason::light_off:
            return "light_off";
        case Reason::no_visible_receiver:
            return "no_visible_receiver";
        case Reason::no_caster:
            return "no_caster";
        case Reason::below_display_step:
            return "below_display_step";
        case Reason::content_unchanged:
            return "content_unchanged";
        case Reason::refresh_held:
            return "refresh_held";
        case Reason::map_too_coarse:
            return "map_too_coarse";
        case Reason::visibility_kept:
            return "visibility_kept";
        case Reason::resolution_clamped:
            return "resolution_clamped";
        case Reason::over_budget:
            return "over_budget";
        case Reason::ray_budget:
            return "ray_budget";
        case Reason::rays_off:
            return "rays_off";
        case Reason::rays_cheaper:
            return "rays_cheaper";
        case Reason::budget_shrunk:
            return "budget_shrunk";
        case Reason::map_shrunk:
            return "map_shrunk";
        case Reason::map_allocation_failed:
            return "map_allocation_failed";
        case Reason::target_incomplete:
            return "target_incomplete";
        case Reason::depth_program_failed:
            return "depth_program_failed";
        case Reason::lighting_program_failed:
            return "lighting_program_failed";
        case Reason::filter_program_failed:
            return "filter_program_failed";
        case Reason::filter_program_waits:
            return "filter_program_waits";
        case Reason::buffer_failed:
            return "buffer_failed";
        case Reason::sampler_failed:
            return "sampler_failed";
        case Reason::tint_failed:
            return "tint_failed";
        case Reason::fit_degenerate:
            return "fit_degenerate";
        case Reason::projection_unsupported:
            return "projection_unsupported";
        case Reason::eye_invalid:
            return "eye_invalid";
        case Reason::range_invalid:
            return "range_invalid";
        case Reason::cascades_clamped:
            return "cascades_clamped";
        case Reason::warp_unsupported:
            return "warp_unsupported";
        case Reason::splits_invalid:
            return "splits_invalid";
        case Reason::depths_unread:
            return "depths_unread";
        case Reason::filter_cut:
            return "filter_cut";
        case Reason::depth_coarse:
            return "depth_coarse";
        case Reason::count:
            break;
    }
    return "unknown";
}

const char* reason_text(Reason reason) {
    switch (reason) {
        case Reason::none:
            return "The shadow is as requested.";
        case Reason::no_light_shadow:
            return "The light was given no shadow settings.";
        case Reason::shadows_off:
            return "Shadows are switched off for this light, or for the frame.";
        case Reason::light_off:
            return "The light has no intensity or no colour.";
        case Reason::no_visible_receiver:
            return "No surface that a view sees is within the light's range.";
        case Reason::no_caster:
            return "No caster can darken anything that a view sees.";
        case Reason::below_display_step:
            return "The light is too dim to change any pixel by half a step of the display.";
        case Reason::content_unchanged:
            return "Nothing that the map shows has changed: an earlier frame's map is valid.";
        case Reason::refresh_held:
            return "The map shows casters at an earlier place, within the error allowed or deferred by the budget.";
        case Reason::map_too_coarse:
            return "No map of the default filter meets max_error_px and narrowest_caster_px, so that another filter was chosen.";
        case Reason::visibility_kept:
            return "Visibility per pixel of an earlier frame is valid and was read.";
        case Reason::resolution_clamped:
            return "The requested edge of a map is below 16 texels or above the device's limit: the nearest possible "
                   "one is used.";
        case Reason::over_budget:
            return "The budget went to more visible lights: raise the budget, or use fewer lights.";
        case Reason::budget_shrunk:
            return "The budget left a smaller or plainer map than requested.";
        case Reason::ray_budget:
            return "The budget has no rays left for this light: it has a filtered map instead.";
        case Reason::rays_off:
            return "Rays are switched off, or the picture has no exact surfaces: the light has a filtered map instead.";
        case Reason::rays_cheaper:
            return "The light moves, and rays for all its pixels cost less than its map.";
        case Reason::map_shrunk:
            return "The device had no memory for the requested map: a smaller one is used.";
        case Reason::map_allocation_failed:
            return "The device has no memory for the map; the light is repeated half a second later.";
        case Reason::target_incomplete:
            return "The device cannot draw into the map's format.";
        case Reason::depth_program_failed:
            return "The program that draws depth maps does not compile on this device.";
        case Reason::lighting_program_failed:
            return "No program that looks the light up compiles on this device.";
        case Reason::filter_program_failed:
            return "The filter's program does not compile: the map is looked up with one tap.";
        case Reason::filter_program_waits:
            return "The filter's program is not compiled yet: the map is looked up with one tap.";
        case Reason::buffer_failed:
            return "The device has no memory for a buffer that the light needs.";
        case Reason::sampler_failed:
            return "The device could not make a sampler.";
        case Reason::fit_degenerate:
            return "Casters and receivers leave no volume that could be drawn.";
        case Reason::projection_unsupported:
            return "This kind of light has no such projection: its own is used.";
        case Reason::eye_invalid:
            return "The sun's eye is no valid place: the sun stays orthographic.";
        case Reason::range_invalid:
            return "near_m and far_m are no valid range: the fitted range is used.";
        case Reason::cascades_clamped:
            return "More than 8 cascades were requested: the light has 8.";
        case Reason::warp_unsupported:
            return "Warp needs a tight sun with one view and a fitted depth range: none is used.";
        case Reason::splits_invalid:
            return "The cascades' splits are invalid: the default ones are used.";
        case Reason::depths_unread:
            return "The picture's depths were unavailable: splits follow the receivers' bounds.";
        case Reason::filter_cut:
            return "A setting of the filter is invalid, or beyond its limit (docs/reference/limits.md) or its map's: "
                   "it was cut.";
        case Reason::depth_coarse:
            return "The depth format's steps are wider than the map's texels: d32f is finer.";
        case Reason::tint_failed:
            return "The device cannot hold or draw what translucent casters let through: they cast nothing.";
        case Reason::count:
            break;
    }
    return "Unknown reason.";
}

const char* reason_code(DropReason reason) {
    switch (reason) {
        case DropReason::non_finite_transform:
            return "non_finite_transform";
        case DropReason::zero_rotation:
            return "zero_rotation";
        case DropReason::parent_missing:
            return "parent_missing";
        case DropReason::parent_cycle:
            return "parent_cycle";
        case DropReason::unknown_mesh:
            return "unknown_mesh";
        case DropReason::zero_scale:
            return "zero_scale";
        case DropReason::absurd_light:
            return "absurd_light";
        case DropReason::absurd_camera:
            return "absurd_camera";
        case DropReason::instances_full:
            return "instances_full";
        case DropReason::meshes_full:
            return "meshes_full";
        case DropReason::buffer_lost:
            return "buffer_lost";
        case DropReason::absurd_fog:
            return "absurd_fog";
    }
    return "unknown";
}

}  // namespace gnomon
