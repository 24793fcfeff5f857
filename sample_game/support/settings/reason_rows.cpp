#include "sample_game/support/settings/reason_rows.h"

#include <cstddef>
#include <iterator>

namespace gnomon::game {
namespace {

constexpr ReasonRow kRows[] = {
    {Reason::none, "rendered", ""},
    {Reason::no_light_shadow, "skipped", "add a LightShadow"},
    {Reason::shadows_off, "skipped", "see LightShadow::enabled and FrameSettings::shadows"},
    {Reason::light_off, "skipped", ""},
    {Reason::no_visible_receiver, "skipped", "declare receivers; see the light's range, cone, direction and layers"},
    {Reason::no_caster, "skipped", "declare casters; see layers"},
    {Reason::below_display_step, "skipped", ""},
    {Reason::content_unchanged, "reused", "if the shadow is old: announce the change"},
    {Reason::refresh_held, "reused", "lower refresh_error_px, or raise the budget"},
    {Reason::map_too_coarse, "in filter",
     "raise max_error_px or narrowest_caster_px, or name a filter, if that costs too much"},
    {Reason::visibility_kept, "in kept", ""},
    {Reason::resolution_clamped, "degraded", "request 16 at least, and no more than the device has"},
    {Reason::over_budget, "skipped", "raise the budget, or use fewer lights"},
    {Reason::budget_shrunk, "degraded", "raise the budget, or use fewer lights"},
    {Reason::ray_budget, "degraded", "raise the budget's rays"},
    {Reason::rays_off, "degraded", "use gnomon::Frame with FrameSettings::rays"},
    {Reason::rays_cheaper, "rendered", ""},
    {Reason::map_shrunk, "degraded", "free memory, or set a budget"},
    {Reason::map_allocation_failed, "skipped, degraded", "free memory, or set a budget"},
    {Reason::target_incomplete, "skipped", "run ./gnomon check, and report it"},
    {Reason::depth_program_failed, "skipped", "run ./gnomon check, and report it"},
    {Reason::lighting_program_failed, "skipped, degraded", "run ./gnomon check, and report it"},
    {Reason::filter_program_failed, "degraded", "take another filter; run ./gnomon check, and report it"},
    {Reason::filter_program_waits, "degraded", ""},
    {Reason::buffer_failed, "skipped, degraded", "free memory, or set a budget"},
    {Reason::sampler_failed, "skipped", "run ./gnomon check, and report it"},
    {Reason::fit_degenerate, "skipped", "see the places and sizes of casters and receivers"},
    {Reason::projection_unsupported, "degraded", "set projection to automatic"},
    {Reason::eye_invalid, "degraded", "correct eye_distance_m and eye_angle_rad"},
    {Reason::range_invalid, "degraded", "correct near_m and far_m, or set them to 0"},
    {Reason::cascades_clamped, "degraded", "request 8 at most"},
    {Reason::warp_unsupported, "degraded", "set warp to 0"},
    {Reason::splits_invalid, "degraded", "correct split_m, split_lambda and cascade_blend"},
    {Reason::depths_unread, "degraded", "take other splits than sampled"},
    {Reason::filter_cut, "degraded", "see the ranges of the filter's settings"},
    {Reason::depth_coarse, "degraded", "take depth_format d32f, or a near plane farther from the light"},
    {Reason::tint_failed, "degraded", "free memory, or set a budget"},
};
static_assert(std::size(kRows) == static_cast<std::size_t>(Reason::count));

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < std::size(kRows); ++i)
        if (static_cast<std::size_t>(kRows[i].reason) != i) return false;
    return true;
}
static_assert(rows_are_in_order());

}  // namespace

std::span<const ReasonRow> reason_rows() { return kRows; }

}  // namespace gnomon::game
