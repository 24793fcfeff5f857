#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

/// Through which openings a local light looks at the scene: receivers are sought, and views fitted, one for each.
namespace gnomon::shadow {

struct LightOpening {
    glm::dmat3 axes{1.0};             // columns u, v, toward the light
    glm::dvec2 low{-1.0}, high{1.0};  // tangents along u and v
    std::uint32_t layer = 0;          // of the map; opening i of a light is of layer i
    std::uint32_t held_as = 0;        // index into HeldLight::views
};

struct LightOpenings {
    std::array<LightOpening, 6> items;
    std::uint32_t count = 0;
    std::span<const LightOpening> span() const& { return {items.data(), count}; }
    std::span<const LightOpening> span() const&& = delete;  // it would outlive what it shows
};

/// Point: the six faces of its cube, in the order of OpenGL's table, turned by cube_turn(), each with the border that a
/// filter reads beyond its seams. Spot: one around its cone,
/// or a cube's five faces in its own axes, limited to what the cone can light, or these and then that
/// (spot_cube_transition.h). A single opening holds no more than kWidestMap_rad to each side. A lamp that is aimed has
/// one (far_lamp_aim.h), a sun none.
/// Adds a light kind's light frusta, except that of an aimed lamp.
using FrustaFunction = void (*)(const LightItem& light, const ShadowRequest& request, LightOpenings& openings);
void add_spot_frusta(const LightItem& light, const ShadowRequest& request, LightOpenings& openings);
void add_cube_frusta(const LightItem& light, const ShadowRequest& request, LightOpenings& openings);

}  // namespace gnomon::shadow
