#include "tests/stability/hard_cases_pancakes.h"

#include <gtest/gtest.h>

#include <utility>
#include <variant>
#include <vector>

namespace gnomon::hard {
namespace {

// Long triangles from next to the receivers to far before the near plane.
constexpr glm::vec3 kLong[] = {{-1.0f, 0.3f, -0.5f}, {-0.2f, 0.3f, 0.5f}, {30.0f, 90.0f, 2.0f}};

void depth_is_clamped() {
    World w;
    pancakes(w);
    Stages stages(w);
    stages.run();
    ASSERT_GT(stages.passes(), 0u);
    // What lies before the near plane is flattened onto it: the draws of a depth pass clamp.
    bool clamps = false;
    for (const gl::Command& command : stages.commands().commands)
        if (const auto* draw = std::get_if<gl::SetPipeline>(&command)) clamps |= draw->state.depth_clamp;
    EXPECT_TRUE(clamps);
}
/// Points of a long triangle that a map holds, and those of them that lie before its near plane.
std::pair<std::size_t, std::size_t> held_and_before_near(std::vector<std::string> settings) {
    World w;
    w.settings = std::move(settings);
    pancakes(w);
    Stages stages(w);
    stages.run();
    std::size_t previous = 0, before = 0;
    constexpr int kSteps = 200;
    for (const shadow::ShadowView& view : stages.frame().fitted.views)
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; j + i <= kSteps; ++j) {
                const double a = i / double{kSteps}, b = j / double{kSteps};
                const glm::dvec3 p =
                    (1.0 - a - b) * glm::dvec3(kLong[0]) + a * glm::dvec3(kLong[1]) + b * glm::dvec3(kLong[2]);
                const glm::dvec3 q(glm::dmat4(view.map_from_anchor) * glm::dvec4(p - view.pose.anchor_ws_m, 1.0));
                if (q.x < 0.0 || q.y < 0.0 || q.x > 1.0 || q.y > 1.0) continue;
                ++previous;
                before += q.z > 1.0;
            }
    return {previous, before};
}

}  // namespace

void pancakes(World& w) {
    w.ground(4.0);
    w.place(w.triangles({kLong[0], kLong[1], kLong[2], kLong[0], kLong[2], kLong[1]}));
    w.box({10.0, 40.0, 10.0}, {14.0, 41.0, 16.0});
    w.sun({-0.4, -1.0, -0.3});
    w.camera({2.0, 5.0, 7.0}, kOrigin);
}
void pancakes_are_made_where_depths_are_compared_alone() {
    depth_is_clamped();
    const auto [previous, before] = held_and_before_near({});
    EXPECT_GT(before, previous / 2) << "near begins at the receivers";
    // Filters that look for how far away a caster is need it where it stands.
    for (const char* filter : {"filter=pcss", "filter=pcss_moments"}) {
        const auto [there, flattened] = held_and_before_near({filter, "sun_radius_deg=0.6"});
        EXPECT_GT(there, 0u) << filter;
        EXPECT_EQ(flattened, 0u) << filter;
    }
}

}  // namespace gnomon::hard
