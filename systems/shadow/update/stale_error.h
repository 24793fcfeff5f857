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

/// How far off shadows are in a map that is kept although casters moved since it was drawn.
///
/// Let no point of any caster have moved by more than D metres, and by no more than A across the light. Seen along the
/// light, a shadow is then the old one with each of its points moved by at most A: its edges lie within A of where they
/// should be (a continuous map that moves no point by A or more reaches the middle of every ball of radius A). On a
/// receiver that is as much longer as a texel is (error_bound.h).
///
/// A caster that moved receives as well, where it stands now, and the map shows it where it stood. Around a point of it
/// it lay on one side of its plane there, as far as the bias takes a receiver to be a plane; so it stood within D of
/// that side: the receiver is at most D off the plane that the map shows, however it turned. That is what
/// bias/automatic.glsl takes as error_m. Where a caster touches its receiver, such an offset moves the contact by D
/// times the tangent of the angle between normal and light: by no more than 2 D where receivers are stated for, as an
/// edge by 2 A.
namespace gnomon::shadow {

/// `casters`: those of the view that move (ShadowView::still_casters are left out).
void remember(const SceneSnapshot& scene, std::span<const std::uint32_t> casters, std::uint64_t still_content,
              ShownCasters& shown);

/// How far the points of a caster moved: D, in metres, and A: across the light in metres, or of a perspective view in
/// tangents. Infinite where it cannot be told.
struct CasterShift {
    double any_m = 0.0, across = 0.0;
};
CasterShift caster_shift(const ShadowView& view, const ShownCaster& then, const InstanceItem& now,
                         const PoseItem* pose);

inline constexpr Staleness kUnknownStaleness{std::numeric_limits<double>::infinity(),
                                             std::numeric_limits<double>::infinity()};

/// What a view whose layer shows `shown` would be off by if it were kept, its own matrices being the same. `casters`:
/// all of the view now. Infinite where others are there now, still ones changed, or what a metre is in the picture is
/// not known (a warped map, a view that nobody sees).
Staleness staleness(const SceneSnapshot& scene, const ShadowView& view, const ShownCasters& shown,
                    std::uint64_t still_content, std::span<const std::uint32_t> casters);

}  // namespace gnomon::shadow
