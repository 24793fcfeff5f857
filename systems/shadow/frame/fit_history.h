#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gnomon/components.h"
#include "gnomon/light.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/cascade_ends.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/shadow/frame/triangle_references.h"
#include "systems/shadow/frame/view_limits.h"

/// History of the fits from frame to frame. Its hysteresis keeps a map in place while the map is still good enough.
///
/// How a fit uses it:
/// - `FitInput::previous`: result of this light's last fit; all `used` are false the first time.
/// - `FitInput::next`: starts as a copy of it, and goes to the next frame.
/// - For each view the fit computes the values that it needs now. If the old values contain these without much excess,
///   the fit takes the old ones bit for bit, so that the map's content hash stays. Otherwise it takes new ones.
/// - Either way it writes the values taken into `next`.
///
/// Old values are a preference, never a premise: with any history, even a wrong one, a fit must contain all receivers.
/// systems/shadow/fitting/size_steps.h has the steps and the rule.
///
/// A light out of sight keeps its entry. A light that is removed, or loses its LightShadow, loses it.
namespace gnomon::shadow {

/// Last fit of one cascade, spot view or cube face.
struct ViewFitHistory {
    bool used = false;          // the numbers below come from a fit
    glm::ivec2 extent_step{0};  // sun: sides of the map, step_size() metres
    glm::dvec2 low{0.0};        // lower corner of the map, in the kind's own fixed axes: metres (sun) or tangents
    glm::dvec2 high{0.0};       // local light: upper corner
    int near_step = 0;          // local light: near plane
    int far_step = 0;           // local light: far plane; sun: depth range
    double near_m = 0.0;        // sun: start of the depth range, in the kind's own fixed axes
    bool too_large = false;     // sun: one of its sizes is kept for now, although a much smaller one would suffice
    bool operator==(const ViewFitHistory&) const = default;
};

/// Number of views in the history of a light. They are indexed by cascade or face, not by their order in this frame.
inline constexpr std::size_t kHistoryViews = kMaxViews;

/// Gradual transition of a spot between one perspective view and the faces of a cube (spot_cube_transition.h).
struct SpotCubeTransition {
    bool used = false;
    bool prefers_faces = false;  // the side of the hysteresis that its cone is on
    int cube_blend_eighths = 0;  // share of the faces in the lookup, eighths; 0 and 8: only one of the two exists
    bool operator==(const SpotCubeTransition&) const = default;
};

/// Ball around the visible receivers of a far lamp, at which its one map looks (projection/far_lamp_aim.h).
struct FarLampAim {
    bool used = false;
    glm::dvec3 middle_ws_m{0.0};
    double radius_m = 0.0;
    bool operator==(const FarLampAim&) const = default;
};

/// Split distances of a sun's cascades during their transition (fitting/directional/split_transition.h).
struct SplitHistory {
    bool used = false;
    int near_step = 0, far_step = 0;                 // the depths that are split
    std::uint32_t count = 0;                         // number of cascades; 0: the members below are not from a fit
    CascadeSplitDistances at_m{}, from_m{}, to_m{};  // present splits, and the transition's start and goal
    glm::dvec3 position_ws_m{0.0};                   // pose of the camera that used the present splits
    glm::dmat3 rotation_ws{1.0};
    bool operator==(const SplitHistory&) const = default;
};

/// Split distances of CascadeSplits::sampled, metres along the view.
struct SampledSplitHistory {
    std::uint32_t count = 0;  // number of cascades; 0: no splits are stored
    std::array<double, kHistoryViews + 1> ends_m{};
    bool operator==(const SampledSplitHistory&) const = default;
};

/// What is stated of a light's maps, pixels. All 0: there are none.
struct MapAccuracy {
    double edge_px = 0.0;      // bound on the error of edges of casters that they resolve
    double grid_px = 0.0;      // part of it that the picture's pixel grid causes, whatever the maps
    double resolved_px = 0.0;  // width of a caster that they resolve
    bool operator==(const MapAccuracy&) const = default;
};

/// Targets of a light's maps, as LightShadow has them, pixels. 0: none.
struct AccuracyTargets {
    double error_px = 0.0;      // max_error_px
    double narrowest_px = 0.0;  // narrowest_caster_px
    bool operator==(const AccuracyTargets&) const = default;
};

/// Filter that a light's targets chose for it (filter_choice.h).
struct FilterHistory {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: no choice yet, or the targets do not choose it
    AccuracyTargets targets;                        // targets of the choice
    MapAccuracy usual;                              // accuracy of the default filter's maps when these were last fitted
    double seen_px = 0.0;      // error of the last fit's own maps; while it is equal, the visible scene is unchanged
    std::uint32_t frames = 0;  // frames until the default filter is fitted again; 0: not before seen_px changes
    std::uint32_t passed = 0;  // consecutive frames in which the default filter met the targets
    bool operator==(const FilterHistory&) const = default;
};

/// Sizes of a light's maps, and how long they have been otherwise than needed.
struct SizeHistory {
    std::uint32_t map_px = 0;           // edge of its maps where they follow the target (accuracy_target.h); else 0
    std::uint32_t downsize_frames = 0;  // consecutive frames in which half of that edge appeared to meet the target
    std::uint32_t oversize_frames = 0;  // consecutive frames in which some view was too large
    std::uint32_t shrink_cooldown = 0;  // frames until a size may become smaller again, after some have changed
    bool operator==(const SizeHistory&) const = default;
};

/// Number of a sun's cascades.
struct CountHistory {
    std::uint32_t cascades = 0;  // number that the target chose; 0: none yet, or the number is given
    std::uint32_t moves = 0;     // frames in which its maps moved since other numbers were last fitted
    bool operator==(const CountHistory&) const = default;
};

/// Direction of a sun.
struct TurnHistory {
    glm::dvec3 back_ws{0.0};  // toward the sun at its last fit; 0: there was none
    bool turned = false;      // it was another one at the fit before
    /// Returns true: while nothing changes, the maps of a sun that has turned serve as well as those of another one.
    bool operator==(const TurnHistory&) const { return true; }
};

/// Light that uses rays.
struct RayHistory {
    bool fell_back = false;           // RayUse::fell_back of the last frame
    std::uint64_t casters = 0;        // hash of the casters in its conservative maps, wherever those maps lie
    std::uint32_t static_frames = 0;  // frames with a moving camera since that hash changed, at most kStaticSunFrames
    bool operator==(const RayHistory&) const = default;
};

/// What a budget left of a light. BudgetStage alone writes it.
struct BudgetHistory {
    QualityLimits grant;
    float activity = 0.0f;         // share of its views that change per frame, smoothed
    std::uint32_t new_frames = 0;  // frames from now in which its views change because its limits did
    bool operator==(const BudgetHistory&) const = default;
};

/// What the fits remember of one light.
struct LightFitHistory {
    ecs::Entity light = {};
    SplitHistory splits;
    std::array<ViewFitHistory, kHistoryViews> views;
    SpotCubeTransition cone;
    FarLampAim aim;
    SampledSplitHistory sampled_splits;
    SizeHistory size;
    CountHistory count;
    FilterHistory filter;
    TurnHistory turn;
    RayHistory rays;
    BudgetHistory budget;
    bool operator==(const LightFitHistory&) const = default;
};

/// Frames, half a second, after which a sun with unchanged casters under a moving camera gets larger maps. Such a map
/// is drawn once and looked up in all later frames. An unchanged picture needs no rays, so that it does not count, and
/// maps within a budget do not grow by themselves.
inline constexpr std::uint32_t kStaticSunFrames = 30;
/// Growth of the map's edge: twice the edge leaves a third fewer pixels to rays (docs/results/exact.md).
inline constexpr float kStaticSunEdges = 2.0f;
inline bool is_static(const LightFitHistory& previous) { return previous.rays.static_frames >= kStaticSunFrames; }

struct History {
    std::vector<LightFitHistory> lights;    // in the order of the frame's lights
    std::uint64_t pictures = 0;             // hash of the poses of the last frame's cameras
    std::uint32_t frames_since_grants = 0;  // frames since grants changed (settle_limits); 0 without a budget
    TriangleReferences references = {};     // format of all maps with triangles
    bool short_of_bytes = false;            // the automatic limit on bytes binds (budget/automatic_limit.h)
    bool operator==(const History&) const = default;
};

/// Returns the entry of `light`, or null. `guess`: its probable index.
inline const LightFitHistory* find(const History& history, ecs::Entity light, std::size_t guess) {
    if (guess < history.lights.size() && history.lights[guess].light == light) return &history.lights[guess];
    for (const LightFitHistory& previous : history.lights)
        if (previous.light == light) return &previous;
    return nullptr;
}

/// Finds the entry of each light, in their order; null where a light has none. Searches only while lights came, went or
/// changed their order since the history was written.
inline void find_histories(std::span<const LightItem> lights, const History& history,
                           std::vector<const LightFitHistory*>& found) {
    found.assign(lights.size(), nullptr);
    std::size_t matched = 0;
    for (std::size_t i = 0; i < lights.size() && matched < history.lights.size(); ++i)
        if (history.lights[matched].light == lights[i].entity) found[i] = &history.lights[matched++];
    if (matched == history.lights.size()) return;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (!found[i]) found[i] = find(history, lights[i].entity, matched);
}

}  // namespace gnomon::shadow
