#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "gnomon/reason.h"
#include "systems/extract/snapshot.h"

/// Work of a frame for each light, and the reasons. Every stage writes it, none reads it.
namespace gnomon {

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
    std::uint32_t by_depth = 0;  // casters without triangles, where its filter reads those of others
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
