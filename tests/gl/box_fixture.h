#pragma once
#include "tests/gl/box_oracle.h"
#include "tests/gl/frame_fixture.h"

namespace gnomon {

inline constexpr std::size_t kSome = 300;  // pixels; a claim about fewer is none

/// Boxes above cards, in the world and in the oracle at once.
class BoxTest : public FrameTest {
protected:
    void add_card(const boxes::Card& card, const glm::dvec3& at = glm::dvec3(0.0)) {
        place(add_mesh(game::make_card(card.centre_m, 2.0 * card.half_u_m, 2.0 * card.half_v_m)), {.translation_m = at}, false);
        truth.cards.push_back({card.centre_m + at, card.half_u_m, card.half_v_m});
    }
    /// Adds the plane y = 0, `half_m` to each side of `at`, facing up.
    void add_ground(double half_m, const glm::dvec3& at = glm::dvec3(0.0)) {
        add_card({glm::dvec3(0.0), glm::dvec3(0.0, 0.0, half_m), glm::dvec3(half_m, 0.0, 0.0)}, at);
    }
    ecs::Entity add_box(const glm::dvec3& min, const glm::dvec3& max, const Transform& transform = {}) {
        const ecs::Entity entity = place(add_mesh(game::make_box(min, max)), transform);
        glm::dmat3 basis = glm::mat3_cast(glm::normalize(transform.rotation));
        for (int axis = 0; axis < 3; ++axis) basis[axis] *= transform.scale[axis];
        truth.boxes.push_back({{min, max}, basis, transform.translation_m});
        return entity;
    }
    void look_down(double half_height_m, const glm::dvec3& at = glm::dvec3(0.0)) {
        constexpr double kHeight_m = 20.0;
        add_camera({.projection = CameraProjection::orthographic, .half_height_m = half_height_m, .near_m = 0.1, .far_m = 40.0},
                   at + glm::dvec3(0.0, kHeight_m, 0.0), {0.0, -1.0, 0.0});
    }

    boxes::Verdict judged(std::uint32_t light = 0) {
        const SceneSnapshot& scene = frame().snapshot();
        if (scene.consumers.empty() || light >= scene.lights.size()) {
            ADD_FAILURE() << "no camera, or no light";
            return {};
        }
        return boxes::judge(truth, scene.consumers.front(), scene.lights[light], visibility(light));
    }
    /// Checks every claim of the oracle, and that it claims at least `least_dark` and `least_lit` pixels.
    void expect_true(std::size_t least_dark, std::size_t least_lit, std::uint32_t light = 0) {
        const boxes::Verdict verdict = judged(light);
        EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
        EXPECT_GE(verdict.dark, least_dark);
        EXPECT_GE(verdict.lit, least_lit);
    }

    boxes::Scene truth;
};

}  // namespace gnomon
