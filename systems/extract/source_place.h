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

/// Share of the way to a source at which a ray ends. A ceiling that lies in the plane of its panel is not in the
/// panel's way.
inline constexpr double kBeforeSource = 1.0 - 0x1p-20;

/// Maps a place of the square from -1 to 1 onto a rectangle or tube, or of the unit disk onto a disc or sphere.
/// What the light gives a receiver is proportional to the mean of weight times the receiver's cosine, over equal areas.
/// SourceShape::facing has no places.
/// - Sphere: places are spread evenly over the directions in which it is seen.
/// - Tube: they are spread over the length and over the arc that is seen.
SourcePlace source_place(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec2& at);

/// Returns whether any of an area light can be seen from a place, over a plane with this normal through it.
bool sees_source(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec3& normal);

/// Maps the unit disk to the square from -1 to 1, equal areas to equal areas (Shirley and Chiu 1997, inverted). Circles
/// become squares.
glm::dvec2 disk_to_square(const glm::dvec2& disk);

}  // namespace gnomon
