#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/aabb.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/update_plan.h"
#include "systems/shadow/maps/shown_casters.h"

/// Error of shadows in a map that is kept although casters moved since it was drawn.
///
/// Let D be the farthest that any point of a caster moved, metres, and A the farthest across the light. Seen along the
/// light, the shadow is then the old one with each point moved by at most A. A continuous map that moves points by less
/// than A reaches the middle of every ball of radius A. So edges lie within A of their true places. On a receiver the
/// error grows as a texel does (error_bound.h).
///
/// A moved caster also receives shadows where it stands now, while the map shows it where it stood. Around each of its
/// points it lay on one side of its plane, as far as the bias takes a receiver to be a plane. So it stood within D of
/// that side, and the receiver is at most D off the plane in the map, however the caster turned. bias/automatic.glsl
/// takes that as error_m. Where a caster touches its receiver, the offset moves the contact by D times the tangent of
/// the angle between normal and light. That is at most 2 D on the receivers that the bound covers, as an edge moves by
/// 2 A.
namespace gnomon::shadow {

/// Records the view's moving casters as the layer shows them. `casters`: the moving ones alone.
void remember(const SceneSnapshot& scene, std::span<const std::uint32_t> casters, std::uint64_t static_content,
              ShownCasters& shown);

/// Movement of a caster's points: D, metres, and A across the light, metres (perspective views: tangents). Infinite:
/// unknown.
struct CasterShift {
    double any_m = 0.0, across = 0.0;
};
CasterShift caster_shift(const ShadowView& view, const ShownCaster& then, const InstanceItem& now,
                         const PoseItem* pose);

inline constexpr Staleness kUnknownStaleness{std::numeric_limits<double>::infinity(),
                                             std::numeric_limits<double>::infinity()};

/// Returns the error of a view that keeps the layer `shown`; its matrices must be unchanged. `casters`: all casters of
/// the view now. Infinite if casters came or went or static ones changed. Infinite also if the size of a metre on
/// screen is unknown: in a warped map, or a view that no camera sees.
Staleness staleness(const SceneSnapshot& scene, const ShadowView& view, const ShownCasters& shown,
                    std::uint64_t static_content, std::span<const std::uint32_t> casters);

}  // namespace gnomon::shadow
