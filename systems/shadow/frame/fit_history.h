#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "components/light_shadow.h"
#include "engine/ecs/entity.h"
#include "systems/shadow/frame/cascade_ends.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/shadow/frame/view_limits.h"

/// What the fits remember from frame to frame, so that a map that is still good enough stays where it is: hysteresis.
///
/// How a fit uses it: `FitInput::held` is what this light's last fit left (all `used` false the first time),
/// `FitInput::next` starts as a copy of it and goes to the next frame. For each view the fit computes what it needs
/// now; if the held values still hold that, and not too much more, it takes them unchanged (bit for bit, so that the
/// map's signature is unchanged); else it takes new ones. Either way it writes what it took into `next`. Held values
/// are a preference, never a premise: with any history, even a wrong one, a fit must contain all receivers.
/// systems/shadow/fitting/size_steps.h has the steps and the rule.
///
/// A light that is only out of sight keeps its entry; one that vanishes, or loses its LightShadow, loses it.
namespace gnomon::shadow {

/// One cascade, spot view or cube face as it was last fitted.
struct HeldView {
    bool used = false;          // the numbers below come from a fit
    glm::ivec2 extent_step{0};  // sun: sides of the map, step_size() metres
    glm::dvec2 low{0.0};        // lower corner of the map, in the kind's own fixed axes: metres (sun) or tangents
    glm::dvec2 high{0.0};       // local light: upper corner
    int near_step = 0;          // local light: near plane
    int far_step = 0;           // local light: far plane; sun: depth range
    double near_m = 0.0;        // sun: where the depth range starts, in the kind's own fixed axes
    bool too_large = false;     // sun: one of its sizes is kept for now, though much smaller ones would do
    bool operator==(const HeldView&) const = default;
};

/// Views are indexed by cascade or face, not by their order in this frame.
inline constexpr std::size_t kHeldViews = kMaxViews;

/// How a spot goes from one perspective view to faces of a cube around it and back: not at once.
struct ConeFade {
    bool used = false;
    bool prefers_faces = false;  // the side of the hysteresis that its cone is on
    int faces_eighths = 0;       // share of the faces in what is seen; 0 and 8: only one of the two exists
    bool operator==(const ConeFade&) const = default;
};

/// A ball around what is seen of what a far lamp lights, at which its one map looks (projection/far_lamp_aim.h).
struct LampAim {
    bool used = false;
    glm::dvec3 middle_ws_m{0.0};
    double radius_m = 0.0;
    bool operator==(const LampAim&) const = default;
};

/// Where a sun's cascades end along the view, on their way to where they should
/// (fitting/directional/split_transition.h).
struct HeldSplits {
    bool used = false;
    int near_step = 0, far_step = 0;  // the depths that are split
    std::uint32_t count = 0;          // of cascades; 0: what follows is not from a fit
    CascadeEnds at_m{}, from_m{}, to_m{};
    glm::dvec3 position_ws_m{0.0};  // of the camera that saw them there
    glm::dmat3 rotation_ws{1.0};
    bool operator==(const HeldSplits&) const = default;
};

/// Where a sun's cascades end by CascadeSplits::sampled, metres along the view.
struct HeldEnds {
    std::uint32_t count = 0;  // of cascades; 0: nothing is held
    std::array<double, kHeldViews + 1> ends_m{};
    bool operator==(const HeldEnds&) const = default;
};

/// Which filter a light's contract chose (filter_choice.h).
struct HeldFilter {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: none, or it is not the contract's to choose
    double wished_px = 0.0;                         // for this word
    double usual_px = 0.0;                          // that maps of the usual filter err by, when they were last fitted
    double seen_px = 0.0;      // the error of the last fit's own maps: the same, and what is seen has not changed
    std::uint32_t frames = 0;  // until maps of the usual filter are tried again; 0: when something changes
    std::uint32_t passed = 0;  // in how many frames in a row they did
    bool operator==(const HeldFilter&) const = default;
};

struct HeldLight {
    ecs::Entity light = {};
    HeldSplits splits;
    std::array<HeldView, kHeldViews> views;
    ConeFade cone;
    LampAim aim;
    HeldEnds sampled_ends;
    std::uint32_t large_frames = 0;  // for how many frames in a row some view was too large
    std::uint32_t tired_frames = 0;  // for so many frames from now no size becomes smaller, since some have changed
    std::uint32_t map_px = 0;        // edge of its maps, where they follow the contract (accuracy_target.h); else 0
    std::uint32_t spare_frames = 0;  // for how many frames half of it seems to have done
    std::uint32_t cascades = 0;      // that its contract chose; 0: none yet, or it leaves no choice
    std::uint32_t moves = 0;         // in how many frames its maps moved since another number was tried
    bool gave_way = false;           // ShadowRequest::gives_way
    std::uint64_t casters = 0;       // signature of what maps of sheets show, wherever those lie
    std::uint32_t quiet_frames =
        0;  // for how many frames it has stayed, of those whose pictures moved; at most kQuietFrames
    HeldFilter filter;
    Grant grant;                   // what a budget left it; BudgetStage's, as all that follows
    float activity = 0.0f;         // share of its views that changed per frame, of late
    std::uint32_t new_frames = 0;  // in so many frames from now its views change because its grant did
    bool operator==(const HeldLight&) const = default;
};

/// A sun whose casters have stayed for so many frames, half a second, while the camera moved, has its map drawn once
/// and asked in all frames to come: it then has twice the edge, which leaves a third fewer pixels to rays
/// (docs/exact.md, "What it costs"). A still picture asks no ray, and has nothing drawn anew for it; what is shared out
/// within a budget does not grow by itself.
inline constexpr std::uint32_t kQuietFrames = 30;
inline constexpr float kQuietEdges = 2.0f;
inline bool is_quiet(const HeldLight& held) { return held.quiet_frames >= kQuietFrames; }

struct History {
    std::vector<HeldLight> lights;  // in the order of the frame's lights
    std::uint64_t pictures = 0;     // signature of where the last frame's cameras stood
    std::uint32_t calm_frames = 0;  // since grants changed (settle_grants); 0 without a budget
    bool operator==(const History&) const = default;
};

/// The entry of `light`, or null. `guess`: index it probably has.
inline const HeldLight* find(const History& history, ecs::Entity light, std::size_t guess) {
    if (guess < history.lights.size() && history.lights[guess].light == light) return &history.lights[guess];
    for (const HeldLight& held : history.lights)
        if (held.light == light) return &held;
    return nullptr;
}

}  // namespace gnomon::shadow
