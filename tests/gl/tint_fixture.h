#pragma once
#include <string>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/oracle/tint_truth.h"

namespace gnomon {

/// Translucent panes above a ground, judged by rays.
class TintTest : public TracedFrameTest {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        add_material({.name = "matt", .metallic = 0.0f});
    }
    static assets::Material glass(const glm::vec3& transmission, const std::string& name = "glass") {
        assets::Material material{.name = name, .metallic = 0.0f, .double_sided = true};
        material.transmission = transmission;
        return material;
    }
    static assets::Material film(float alpha) {
        return {.name = "film",
                .base_colour = {1.0f, 1.0f, 1.0f, alpha},
                .metallic = 0.0f,
                .alpha_mode = assets::AlphaMode::blend,
                .double_sided = true};
    }
    /// Adds a horizontal square, `half_m` to each side. Unseen ones cast all the same.
    ecs::Entity add_pane(const assets::Material& material, const glm::dvec3& at_m, double half_m,
                         bool visible = false) {
        const std::uint32_t mesh =
            add_mesh(game::make_card(glm::dvec3(0.0), {2.0 * half_m, 0.0, 0.0}, {0.0, 0.0, -2.0 * half_m}),
                     add_material(material));
        const ecs::Entity pane = place(mesh, {.translation_m = at_m, .rotation = turn});
        world.patch<MeshRef>(pane, [&](MeshRef& m) { m.visible = visible; });
        return pane;
    }
    void add_ground() {
        place(add_mesh(game::make_card(glm::dvec3(0.0), {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}), 0), {}, false);
    }
    void look_down() {
        add_camera({.projection = CameraProjection::perspective, .fov_y_rad = 0.6f, .near_m = 0.1f, .far_m = 60.0f},
                   {0.3, 14.0, 3.0}, {0.0, -14.0, -3.0});
    }
    std::vector<glm::vec4> tint(std::uint32_t light = 0) {
        std::vector<glm::vec4> values;
        EXPECT_TRUE(frame().read_tint(light, values));
        return values;
    }
    /// Differences of the picture from rays, in 255ths, over pixels with a surface.
    struct Errors {
        double mean = 0.0, most = 0.0;
        std::size_t pixels = 0, tinted = 0;  // tinted: by rays
        std::size_t beyond = 0;              // off by more than 1/255
        glm::dvec3 darkest{1.0};             // by rays
    };
    Errors errors(std::uint32_t light = 0) {
        const SceneSnapshot& scene = frame().snapshot();
        const ConsumerItem& eye = scene.consumers.at(0);
        const oracle::ReferenceTracer tracer(scene, library, eye.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(eye);
        const auto truth = oracle::trace_tint(scene, library, eye.position_ws_m, hits, scene.lights.at(light));
        const oracle::TintMetrics m = oracle::compare_tint(hits, truth, tint(light));
        return {255.0 * m.mean_error, 255.0 * m.max_error, m.scored, m.tinted, m.beyond, m.darkest};
    }
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  // turn of panes that are added
};

}  // namespace gnomon
