#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/light.h"
#include "components/light_shadow.h"
#include "engine/ecs/entity.h"
#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"

/// Work of a frame for each light, and the reasons. Every stage writes it, none reads it.
namespace gnomon {

enum class LightState : std::uint8_t { rendered, reused, degraded, skipped };
const char* to_text(LightState state);

/// Stable codes; their texts are part of the command-line interface.
enum class Reason : std::uint8_t {
    none,
    no_light_shadow,      // the light has no LightShadow component
    shadows_off,          // LightShadow::enabled is false
    light_off,            // no intensity
    no_visible_receiver,  // no visible surface is within the light's range
    no_caster,            // nothing can darken a visible surface
    below_display_step,   // lit everywhere: it and similar lights change no pixel by more than half a step
    content_unchanged,    // the map of an earlier frame is still valid
    refresh_held,         // shows casters at an earlier place: within refresh_error_px, or deferred by a budget
    /// The default filter's maps exceed max_error_px: the light has a filter that meets it (FilterReport).
    map_too_coarse,
    visibility_kept,     // visibility per pixel from an earlier frame is still valid (KeptReport)
    resolution_clamped,  // the device's limit is below the requested size
    over_budget,         // dropped by FrameSettings::shadow_budget in favour of more visible lights
    budget_shrunk,       // reduced by the budget
    ray_budget,          // the budget has no rays left for an exact light: it has a filtered map instead
    rays_cheaper,        // moving exact light: rays for all its pixels cost less than its map
    map_shrunk,          // the requested size could not be allocated, a smaller one could
    map_allocation_failed,
    target_incomplete,
    depth_program_failed,
    lighting_program_failed,
    filter_program_failed,  // the filter's program does not compile: the map is looked up with one tap
    filter_program_waits,   // not compiled yet (FrameSettings::programs_per_frame): one tap for now
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
    count
};
const char* reason_code(Reason reason);

/// Numbers behind the result of a light or one of its views.
struct Why {
    std::uint32_t receivers = 0;    // visible and in the light's range, by their bounds
    std::uint32_t casters = 0;      // able to darken those receivers' visible part
    std::uint64_t bytes_saved = 0;  // bytes of maps that were not made, or not written
    double stale_px = 0.0;          // additional error of edges because maps show casters at an earlier place
    /// Maximum contribution of the light to a pixel, in 8 bit steps of the picture. Empty: exposure unknown, or not
    /// computed.
    std::optional<double> display_steps;
    std::optional<double> saved_us;  // drawing time saved, by its last measurement; empty: never measured
};

/// View that a light's map has room for: a cascade, a spot's view, a face of a cube.
struct ViewReport {
    std::uint32_t layer = 0;                  // cascade or face
    LightState state = LightState::rendered;  // rendered; reused; or skipped: neither drawn nor looked up
    Reason reason = Reason::none;
    Why why;
};

/// Visibility of a light per pixel, kept from an earlier frame instead of looked up (docs/economy.md, "What pixels
/// saw").
struct KeptReport {
    Reason reason = Reason::none;    // visibility_kept: this frame read it, in at least one picture
    std::uint64_t bytes = 0;         // over all pictures; part of LightCounts::bytes
    std::optional<double> saved_us;  // lighting time saved on the GPU, by the last measurement of its lookup
};

/// Reduction of a light by a budget, and its numbers.
struct BudgetReport {
    std::uint32_t wanted_px = 0, px = 0;        // edge of its maps
    std::uint32_t wanted_views = 0, views = 0;  // layers of its map
    std::uint32_t refresh_frames = 1;           // moving content is drawn once in this number of frames
    bool plain = false;                         // looked up with one tap instead of its filter
    std::uint64_t wanted_bytes = 0, bytes = 0;  // bytes of its map
    double wanted_us = 0.0, us = 0.0;           // GPU time per frame, by the model
    double harm = 0.0;                          // share of the picture that is wrong because of it, by the model
};

/// Filter of a light, and the reason.
struct FilterReport {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: the light is skipped
    Reason reason = Reason::none;                   // map_too_coarse: chosen by the accuracy target
    std::optional<double> usual_error_px;           // error of the default filter's maps, in that case
};

/// Maps of a light, and the work on them in this frame.
struct LightCounts {
    std::uint32_t views = 0;        // rendered or reused
    std::uint32_t views_drawn = 0;  // drawn in this frame
    std::uint64_t texels = 0;       // size of its map
    std::uint64_t bytes = 0;        // its memory, kept visibility included
    std::uint32_t draws = 0, clears = 0;
    std::uint64_t triangles = 0;
};

/// Result of the shadow stages for one light.
struct LightReport {
    ecs::Entity entity;
    std::string name;
    LightKind kind = LightKind::point;
    LightState state = LightState::skipped;
    Reason reason = Reason::none;
    double predicted_error_px = 0.0;  // worst shadow-edge error over its views
    bool keeps_max_error = false;     // meets LightShadow::max_error_px, apart from the picture's own pixel
    LightCounts counts;
    double cpu_us = 0.0;           // time of the shadow stages for this light alone
    std::optional<double> gpu_us;  // shadow and lighting pass, from the newest measured frame; empty: not measured
    Why why;
    KeptReport kept;
    FilterReport filter;
    std::optional<BudgetReport> budget;            // empty: no budget is set, or the light needed no map
    std::uint32_t first_view = 0, view_count = 0;  // range in FrameReport::views; empty if skipped
};

/// Returns true if the light is lit everywhere on purpose, because its shadow would be invisible. Pixels that it should
/// darken are then no errors.
inline bool is_left_out(const LightReport& light) {
    return light.state == LightState::skipped &&
           (light.reason == Reason::light_off || light.reason == Reason::below_display_step);
}

/// Shared resources of lights with rays (FilterRow::rays): trees over the casters, on the device and on the host, and
/// data of pictures. All 0: no light uses rays.
struct RayReport {
    std::uint64_t bytes = 0, host_bytes = 0;              // trees over casters
    std::uint64_t list_bytes = 0;                         // undecided pixels and their results (lighting/ray_list.h)
    std::uint64_t place_bytes = 0;                        // exact surface positions, per pixel
    std::uint64_t sheet_bytes = 0, sheet_host_bytes = 0;  // vertex data for drawing maps of sheets
    std::uint64_t triangles = 0, instances = 0;
    std::uint32_t meshes_written = 0;  // deformed meshes in this frame
    bool instances_written = false;    // something moved in this frame
};

struct FrameReport {
    std::vector<LightReport> lights;  // one per LightItem, same order
    std::vector<ViewReport> views;    // views of all lights, in their order
    std::vector<DroppedEntity> dropped;
    bool still = false;  // no input of shadows changed: the stages' results of the last frame are valid
    std::uint64_t programs_compiled = 0;  // in this frame, failures included
    double shadow_cpu_us = 0.0;
    double cpu_us = 0.0;
    std::optional<double> gpu_us, shadow_gpu_us;
    gl::Failure failure = gl::Failure::none;  // failure of an essential resource, or of the submission
    RayReport rays;
    std::span<const ViewReport> views_of(const LightReport& light) const {
        return std::span(views).subspan(light.first_view, light.view_count);
    }
    /// Clears the last frame. Lights and dropped entities stay, because their names own memory; the stages overwrite
    /// them.
    void clear() {
        views.clear();
        still = false;
        programs_compiled = 0;
        shadow_cpu_us = cpu_us = 0.0;
        gpu_us.reset();
        shadow_gpu_us.reset();
        failure = gl::Failure::none;
        rays = {};
    }
};

}  // namespace gnomon
