#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "systems/visibility/light_queries.h"

namespace gnomon::visibility {

/// From a place to the light: reaches it at t = LightRays::last().
struct LightRay {
    glm::dvec3 from_ws_m{0.0}, along{0.0};
};

/// Whether a ray is needed to know how much of the light a sample of a place gets.
enum class Reach { none, all, ray };

/// `count` places of equal shares of the unit disk; nothing is done where they are there.
void fill_disk(std::size_t count, std::vector<glm::dvec2>& disk);

/// The rays from places to one light. The light's size is a disk that faces the place, as for the filters that soften
/// by it; the place's is the half of its sphere that faces the light.
class LightRays {
public:
    /// `disk`: evenly in the unit disk, one place per sample (fill_disk()); at least one.
    LightRays(const LightItem& light, std::span<const glm::dvec2> disk);

    /// Rays for a place of this radius.
    std::size_t count(double radius_m) const { return sized_ || radius_m > 0.0 ? disk_.size() : 1; }
    double last() const { return last_; }
    Reach ray(const Place& place, std::size_t sample, LightRay& ray) const;
    /// Whether the point lies within the light's range and cone.
    bool reaches(const glm::dvec3& point_ws_m) const;

private:
    const LightItem& light_;
    double size_ = 0.0;  // of the source: radius in metres, or the tangent of a sun's angular radius
    double outer_cosine_ = -1.0, last_ = 1.0;
    bool sized_ = false, usable_ = false;
    std::span<const glm::dvec2> disk_;
    std::size_t partner_ = 1;  // step from one sample's place on the source's disk to the next one's
};

}  // namespace gnomon::visibility
