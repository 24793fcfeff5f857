#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

/// Light frusta of a local light. Receivers are searched, and one view is fitted, for each of them.
namespace gnomon::shadow {

struct LightFrustum {
    glm::dmat3 axes{1.0};             // columns u, v, toward the light
    glm::dvec2 low{-1.0}, high{1.0};  // tangents along u and v
    std::uint32_t layer = 0;          // layer of the map; frustum i of a light has layer i
    std::uint32_t held_as = 0;        // index into LightFitHistory::views
};

struct LightFrusta {
    std::array<LightFrustum, 6> items;
    std::uint32_t count = 0;
    std::span<const LightFrustum> span() const& { return {items.data(), count}; }
    std::span<const LightFrustum> span() const&& = delete;  // it would outlive what it shows
};

/// Adds the light frusta of a light that is not aimed.
using FrustaFunction = void (*)(const LightItem& light, const ShadowRequest& request, LightFrusta& frusta);

/// Adds one frustum around the cone, at most kWidestMap_rad to each side. A wide spot has five cube faces along its own
/// axes instead, limited to the part that the cone can light. During a transition (spot_cube_transition.h) it has both,
/// the faces first.
void add_spot_frusta(const LightItem& light, const ShadowRequest& request, LightFrusta& frusta);

/// Adds the six faces of a cube, in the order of OpenGL's table, turned by cube_turn(). Each has a border for the
/// texels that a filter reads beyond its seams.
void add_cube_frusta(const LightItem& light, const ShadowRequest& request, LightFrusta& frusta);

}  // namespace gnomon::shadow
