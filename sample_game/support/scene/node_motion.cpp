#include "sample_game/support/scene/node_motion.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace gnomon::game {

Transform moved(const Transform& rest, const assets::Node::Motion& motion, double time_s) {
    const double length = glm::length(motion.axis);
    const double turns = time_s / motion.period_s + motion.phase;
    const bool sane = length > 0.0 && std::isfinite(length) && motion.period_s > 0.0 && std::isfinite(turns) &&
                      std::isfinite(motion.amplitude);
    if (!sane) return rest;
    const glm::dvec3 axis = motion.axis / length;
    const double angle =
        2.0 * glm::pi<double>() * (turns - std::floor(turns));  // small, so that late frames stay exact
    Transform now = rest;
    if (motion.kind == "spin") now.rotation = rest.rotation * glm::angleAxis(angle, axis);
    if (motion.kind == "swing") now.rotation = rest.rotation * glm::angleAxis(motion.amplitude * std::sin(angle), axis);
    if (motion.kind == "slide")
        now.translation_m = rest.translation_m + rest.rotation * (axis * (motion.amplitude * std::sin(angle)));
    return now;
}

void apply_motion(const std::vector<MovingEntity>& moving, double time_s, ecs::Registry& registry) {
    for (const MovingEntity& m : moving)
        registry.patch<Transform>(m.entity, [&](Transform& transform) { transform = moved(m.rest, m.motion, time_s); });
}

}  // namespace gnomon::game
