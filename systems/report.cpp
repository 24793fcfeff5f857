#include "systems/report.h"

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
    }
    return "unknown";
}

}  // namespace gnomon
