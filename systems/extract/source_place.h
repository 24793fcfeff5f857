#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "systems/extract/light_facts.h"

/// Places of area lights as receivers see them. Twin of shaders/shadow/lookup/source_place.glsl.
namespace gnomon {

/// Place of a source.
struct SourcePlace {
    glm::dvec3 way_m{0.0};  // from the receiver; it ends just before the source
    double weight = 0.0;    // share of the light that falls across the way to it; 0: it cannot be seen from there
};

/// Share of the way to a source at which a ray ends: what lies in the source's own plane, as a ceiling with a panel, is
/// not in its way.
inline constexpr double kBeforeSource = 1.0 - 0x1p-20;

/// Maps a place of the square from -1 to 1 onto a rectangle or a tube, or one of the unit disk onto a disc or a sphere.
/// The integral of weight times the receiver's cosine, with equal areas of the square or disk counted alike, is
/// proportional to what the light gives the receiver. Not for SourceShape::facing.
/// - Sphere: places are spread evenly over the directions in which it is seen.
/// - Tube: they are spread over the length and over the arc that is seen.
SourcePlace source_place(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec2& at);

/// Returns whether any of an area light can be seen from a place, over a plane with this normal through it.
bool sees_source(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec3& normal);

/// Maps the unit disk to the square from -1 to 1, equal areas to equal areas (Shirley and Chiu 1997, inverted). Circles
/// become squares.
glm::dvec2 disk_to_square(const glm::dvec2& disk);

}  // namespace gnomon
