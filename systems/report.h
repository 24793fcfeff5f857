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

/// What a frame did for each light, and why. Every stage writes it, none reads it.
namespace gnomon {

enum class LightState : std::uint8_t { rendered, reused, degraded, skipped };
const char* to_text(LightState state);

/// Stable codes; their texts are part of the command-line contract.
enum class Reason : std::uint8_t {
    none,
    no_light_shadow,      // the light has no LightShadow component
    shadows_off,          // LightShadow::enabled is false
    light_off,            // no intensity
    no_visible_receiver,  // nothing that a camera sees is within the light's reach
    no_caster,            // nothing can darken what is seen
    below_display_step,   // lit everywhere, it and others like it change no pixel by more than half a step
    content_unchanged,    // the map of an earlier frame still holds
    refresh_held,         // it shows casters where they were: within refresh_error_px, or by a budget's turn
    map_too_coarse,       // no map of the usual filter keeps max_error_px: the light has one that does (FilterReport)
    visibility_kept,      // what its pixels saw of the light in an earlier frame still holds (KeptReport)
    resolution_clamped,   // the device's limit is below the wish
    over_budget,          // FrameSettings::shadow_budget does not hold it beside what is seen better
    budget_shrunk,        // the same leaves it less than it asks for
    ray_budget,           // the same has no rays left for an exact light: it has a filtered map instead
    rays_cheaper,         // of an exact light that moves: rays for all its pixels cost less than its map
    map_shrunk,           // the wished size could not be allocated, a smaller one could
    map_allocation_failed,
    target_incomplete,
    depth_program_failed,
    lighting_program_failed,
    filter_program_failed,  // what the filter needs does not compile: its map is read with one tap
    filter_program_waits,   // not compiled yet (FrameSettings::programs_per_frame): the same, for now
    buffer_failed,
    sampler_failed,
    fit_degenerate,          // no finite volume to render
    projection_unsupported,  // this kind of light has no such projection, its own is used
    eye_invalid,             // a sun's eye distance or angle is absurd, it stays orthographic
    range_invalid,           // near_m and far_m are no range, the fitted one is used
    cascades_clamped,        // more cascades than a light can have
    warp_unsupported,  // warp is absurd, or asked of other than a tight sun for one camera with a fitted depth range
    splits_invalid,    // split_m, split_lambda or cascade_blend is absurd, the default is used
    depths_unread,     // the picture's depths could not be had, splits go by the receivers' bounds
    filter_cut,        // a setting of the filter is absurd, or more than its map can bear
    depth_coarse,      // steps of the depth format are wider than the map's texels where receivers are
    count
};
const char* reason_code(Reason reason);

/// The numbers behind what a light, or one of its views, was given.
struct Why {
    std::uint32_t receivers = 0;    // that a camera sees and the light reaches, by their bounds
    std::uint32_t casters = 0;      // that may darken what is seen of those
    std::uint64_t bytes_saved = 0;  // of maps that were not made, or not written
    double stale_px = 0.0;          // how much farther off edges are because maps show casters where they were
    /// Of a light: the most that it can add to a pixel, in 8 bit steps of the picture; empty: exposure is not known, or
    /// it was not asked for.
    std::optional<double> display_steps;
    std::optional<double> saved_us;  // of drawing, by what it took when it was last measured; empty: never measured
};

/// One view that a light's map has room for: a cascade, a spot's view, a face of a cube.
struct ViewReport {
    std::uint32_t layer = 0;                  // cascade or face
    LightState state = LightState::rendered;  // or reused, or skipped: it is neither drawn nor looked up
    Reason reason = Reason::none;
    Why why;
};

/// What pixels saw of a light in an earlier frame, kept instead of looked up (docs/economy.md, "What pixels saw").
struct KeptReport {
    Reason reason = Reason::none;    // visibility_kept: this frame read it, in one picture or more
    std::uint64_t bytes = 0;         // of all pictures; part of LightReport::bytes
    std::optional<double> saved_us;  // of lighting on the GPU, by what looking it up took when it was last measured
};

/// What a budget left a light of what it asked for, and by what numbers.
struct BudgetReport {
    std::uint32_t wanted_px = 0, px = 0;        // edge of its maps
    std::uint32_t wanted_views = 0, views = 0;  // layers of its map
    std::uint32_t refresh_frames = 1;           // what moves is drawn in one frame of so many
    bool plain = false;                         // looked up with one tap, whatever its filter
    std::uint64_t wanted_bytes = 0, bytes = 0;  // of its map
    double wanted_us = 0.0, us = 0.0;           // of the GPU per frame, by the model
    double harm = 0.0;                          // share of the picture that is wrong for it, by the model
};

/// How a light is looked up, and why so.
struct FilterReport {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: it is skipped
    Reason reason = Reason::none;                   // map_too_coarse: the accuracy contract chose it
    std::optional<double> usual_error_px;           // and this is what maps of the usual filter would err by
};

struct LightReport {
    ecs::Entity entity;
    std::string name;
    LightKind kind = LightKind::point;
    LightState state = LightState::skipped;
    Reason reason = Reason::none;
    double predicted_error_px = 0.0;  // worst shadow-edge error over its views
    bool keeps_max_error = false;     // that is within LightShadow::max_error_px, beside the picture's own pixel
    std::uint32_t views = 0;          // rendered or reused
    std::uint32_t views_drawn = 0;    // drawn this frame
    std::uint64_t texels = 0;         // of the map
    std::uint64_t bytes = 0;          // everything the light holds
    std::uint32_t draws = 0, clears = 0;
    std::uint64_t triangles = 0;
    double cpu_us = 0.0;           // of the shadow stages, what this light alone took
    std::optional<double> gpu_us;  // shadow and lighting pass, of the newest frame measured; empty: not measured
    Why why;
    KeptReport kept;
    FilterReport filter;
    std::optional<BudgetReport> budget;            // empty: none is set, or it asked for no map
    std::uint32_t first_view = 0, view_count = 0;  // of FrameReport::views; none if it is skipped
};

/// Whether the light is lit everywhere on purpose, since nobody could see its shadow: pixels that it should darken are
/// no errors.
inline bool is_left_out(const LightReport& light) {
    return light.state == LightState::skipped &&
           (light.reason == Reason::light_off || light.reason == Reason::below_display_step);
}

/// What lights that ask by rays share (FilterStorage::sheets): trees over the casters, on the device and beside it, and
/// what pictures of them hold. All 0: no light asks.
struct RayReport {
    std::uint64_t bytes = 0, host_bytes = 0;              // of trees
    std::uint64_t list_bytes = 0;                         // of pixels that ask, and their answers (lighting/ray_list.h)
    std::uint64_t place_bytes = 0;                        // of where surfaces exactly are, per pixel
    std::uint64_t sheet_bytes = 0, sheet_host_bytes = 0;  // of what maps of sheets are drawn from
    std::uint64_t triangles = 0, instances = 0;
    std::uint32_t meshes_written = 0;  // in this frame: those that bent
    bool instances_written = false;    // in this frame: something moved
};

struct FrameReport {
    std::vector<LightReport> lights;  // one per LightItem, same order
    std::vector<ViewReport> views;    // of all lights, in their order
    std::vector<DroppedEntity> dropped;
    bool still = false;  // nothing that shadows follow from had changed: the stages' results of the last frame stand
    std::uint64_t programs_compiled = 0;  // in this frame, failures included
    double shadow_cpu_us = 0.0;
    double cpu_us = 0.0;
    std::optional<double> gpu_us, shadow_gpu_us;
    gl::Failure failure = gl::Failure::none;  // of what no picture can do without, or of the submission
    RayReport rays;
    std::span<const ViewReport> views_of(const LightReport& light) const {
        return std::span(views).subspan(light.first_view, light.view_count);
    }
    /// Forgets the last frame. Lights and dropped entities, whose names hold memory, are assigned over by the stages
    /// that find them.
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
