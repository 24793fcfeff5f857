#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/ecs/entity.h"

/// What the fits remember from frame to frame, so that a map that is still good enough stays where it is: hysteresis.
///
/// How a fit uses it: `FitInput::held` is what this light's last fit left (all `used` false the first time),
/// `FitInput::next` starts as a copy of it and goes to the next frame. For each view the fit computes what it needs
/// now; if the held values still hold that, and not too much more, it takes them unchanged (bit for bit, so that the
/// map's signature is unchanged); else it takes new ones. Either way it writes what it took into `next`. Held values
/// are a preference, never a premise: with any history, even a wrong one, a fit must contain all receivers.
/// systems/shadow/kinds/steps.h has the steps and the rule.
///
/// A light that is only out of sight keeps its entry; one that vanishes, or loses its LightShadow, loses it.
namespace gnomon::shadow {

/// One cascade, spot view or cube face as it was last fitted.
struct HeldView {
    bool used = false;          // the numbers below come from a fit
    glm::ivec2 extent_step{0};  // sides of the map: step_size() metres (sun) or tangents (local light)
    glm::dvec2 low{0.0};        // its lower corner, in the kind's own fixed axes: metres (sun) or tangents
    int near_step = 0;          // local light: near plane
    int far_step = 0;           // local light: far plane; sun: depth range
    double near_m = 0.0;        // sun: where the depth range starts, in the kind's own fixed axes
    bool operator==(const HeldView&) const = default;
};

/// Views are indexed by cascade or face, not by their order in this frame.
inline constexpr std::size_t kHeldViews = 8;

/// Which maps serve a spot: one perspective view, faces of a cube around it, or both while one fades into the other.
enum class ConeMap : std::uint8_t { one_view, both, faces };

struct HeldLight {
    ecs::Entity light = {};
    std::array<HeldView, kHeldViews> views;
    ConeMap cone_map = ConeMap::one_view;
    bool prefers_faces = false;       // spot: the side of the hysteresis its cone is on
    std::uint32_t faces_eighths = 0;  // spot: share of the faces in the fade, 0 to 8
    bool operator==(const HeldLight&) const = default;
};

struct History {
    std::vector<HeldLight> lights;  // in the order of the frame's lights
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
