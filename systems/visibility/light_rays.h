#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "systems/visibility/light_queries.h"

namespace gnomon::visibility {

/// Ray from a place to the light, which it reaches at t = LightRays::last().
struct LightRay {
    glm::dvec3 from_ws_m{0.0}, along{0.0};
    double weight = 1.0;  // share of the source's light that comes this way; 0: none does
};

/// Result for a sample of a place: no light, all light, or a ray must decide.
enum class Reach { none, all, ray };

/// Fills in `count` places with equal shares of the unit disk; does nothing if they are present.
void fill_disk(std::size_t count, std::vector<glm::dvec2>& disk);

/// Rays from places to one light. The light's size is a disk that faces the place, as in the filters for soft shadows.
/// Area lights have a surface instead (source_place.h).
/// The place's size is the half of its sphere that faces the light.
class LightRays {
public:
    /// Prepares rays. `disk`: places evenly spread in the unit disk, one per sample (fill_disk()); at least one.
    LightRays(const LightItem& light, std::span<const glm::dvec2> disk);

    /// Returns the number of rays for a place of this radius.
    std::size_t count(double radius_m) const { return sized_ || radius_m > 0.0 ? disk_.size() : 1; }
    double last() const { return last_; }
    /// Returns true if rays to the place have weights: the share of light is their weighted mean.
    bool weighted(const Place& place) const {
        return area_ || (sized_ && !(place.radius_m > 0.0) && place.normal_ws != glm::dvec3(0.0));
    }
    Reach ray(const Place& place, std::size_t sample, LightRay& ray) const;
    /// Returns true if the point lies within the light's range and cone.
    bool reaches(const glm::dvec3& point_ws_m) const;

private:
    Reach source_ray(const Place& place, const glm::dvec3& middle, const glm::dvec2& at, LightRay& ray) const;

    const LightItem& light_;
    double size_ = 0.0;  // source radius in metres, or tangent of a sun's angular radius
    double outer_cosine_ = -1.0, last_ = 1.0;
    bool sized_ = false, usable_ = false, area_ = false, square_ = false;
    std::span<const glm::dvec2> disk_;
    std::size_t partner_ = 1;  // step between the source disk's places of consecutive samples
};

}  // namespace gnomon::visibility
