#include "tests/gl/box_fixture.h"

// Surfaces that let light through: cut-out casters and blended panes.
namespace gnomon {
namespace {

class ShadowBlending : public BoxTest {
protected:
    std::uint32_t glass(float alpha) {
        return add_material({.name = "pane", .base_colour = {0.2f, 0.9f, 0.4f, alpha}, .metallic = 0.0f, .roughness = 0.8f, .alpha_mode = assets::AlphaMode::blend});
    }
    /// Adds a masked material with a texture that is a hole on the left.
    std::uint32_t half_cut() {
        assets::Texture texture{.name = "half", .width = 64, .height = 64, .rgba = {}, .linear_filter = false};
        for (std::uint32_t i = 0; i < 64 * 64; ++i) {
            const std::uint8_t alpha = i % 64 < 32 ? 0 : 255;
            texture.rgba.insert(texture.rgba.end(), {255, 255, 255, alpha});
        }
        library.textures.push_back(texture);
        return add_material({.name = "cut", .base_colour_texture = 0, .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
    }
    static game::Shape level_card(double half_m, double y_m) {
        return game::make_card({0.0, y_m, 0.0}, {2.0 * half_m, 0.0, 0.0}, {0.0, 0.0, -2.0 * half_m});  // faces up
    }
    std::array<int, 3> pixel_at(const std::vector<std::uint8_t>& rgba, const glm::dvec3& p, double half_height_m) {
        const glm::dvec2 size(settings.viewport_px);
        const ConsumerItem& camera = frame().snapshot().consumers.front();
        const glm::dvec3 offset = p - camera.position_ws_m;
        const double metres_px = 2.0 * half_height_m / size.y;
        const auto x = static_cast<std::size_t>(size.x / 2 + glm::dot(offset, camera.rotation_ws[0]) / metres_px);
        const auto y = static_cast<std::size_t>(size.y / 2 - glm::dot(offset, camera.rotation_ws[1]) / metres_px);
        const std::size_t at = (y * settings.viewport_px.x + x) * 4;
        return {rgba[at], rgba[at + 1], rgba[at + 2]};
    }
};

TEST_F(ShadowBlending, TheHolesOfAMaskedCasterAreLitForEachKind) {
    add_material({.name = "matt", .metallic = 0.0f});
    const std::uint32_t cut = half_cut();
    add_ground(6.0);
    place(add_mesh(level_card(1.0, 1.0), cut));
    // The solid half only: u grows along x, so that x > 0 is solid.
    // As thick as the margin needs it to be, about the card.
    truth.boxes.push_back({{{0.0, 0.9, -1.0}, {1.0, 1.1, 1.0}}, glm::dmat3(1.0), {}});
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {0.9, -1.0, 0.4});
    add_light({.kind = LightKind::point, .intensity = 5000.0f}, {-2.5, 4.0, 0.5}, {0.0, -1.0, 0.0});
    add_light({.kind = LightKind::spot, .intensity = 5000.0f, .outer_cone_rad = 0.9f}, {-2.5, 4.0, 0.5}, {2.5, -4.0, 0.0});
    look_down(4.0);
    draw();
    truth.margin_m = 0.08;
    for (std::uint32_t light = 0; light < 3; ++light) {
        SCOPED_TRACE(light);
        expect_true(100, 1000, light);
    }
    // The whole card as a caster would be wrong where the hole is.
    truth.boxes.front().box_ms.min.x = -1.0;
    EXPECT_GT(judged(0).wrong, 100u);
}

TEST_F(ShadowBlending, APaneCastsNothingAndChangesNoVisibility) {
    add_material({.name = "matt", .metallic = 0.0f});
    const std::uint32_t pane = glass(0.5f);
    add_ground(6.0);
    add_box({-0.5, 2.0, -0.7}, {0.6, 3.0, 0.8});
    const std::uint32_t mesh = add_mesh(level_card(2.0, 0.5), pane);
    add_light({.kind = LightKind::directional, .intensity = 5000.0f}, {}, {1.0, -2.0, 0.5}, {.filter = ShadowFilter::hard, .resolution_px = 512});
    look_down(4.0);
    draw();
    expect_true(100, 1000);
    const auto without = picture();
    place(mesh);
    draw();
    EXPECT_NE(without, picture());
    expect_true(100, 1000);
}

TEST_F(ShadowBlending, APaneOverShadowedGroundAddsItsOwnShareOfLightAndShadow) {
    add_material({.name = "ground", .base_colour = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f), .metallic = 0.0f});
    const std::uint32_t clear = glass(0.0f), half = glass(0.5f);
    add_ground(6.0);
    add_box({-2.0, 3.0, -2.0}, {2.0, 3.5, 2.0});
    const std::uint32_t clear_mesh = add_mesh(level_card(3.8, 0.2), clear), half_mesh = add_mesh(level_card(3.8, 0.2), half);
    add_light({.kind = LightKind::directional, .intensity = 20000.0f}, {}, {1.0, -1.0, 0.0});
    look_down(5.0);
    settings.exposure_ev = 12.0f;
    draw();
    const glm::dvec3 dark_point(3.2, 0.0, 0.0), lit_point(-3.4, 0.0, 0.0);
    const auto bare = picture();
    const auto ground_dark = pixel_at(bare, dark_point, 5.0), ground_lit = pixel_at(bare, lit_point, 5.0);
    ASSERT_GT(ground_lit[1], ground_dark[1] + 30) << "the points are not in light and shadow";

    const ecs::Entity pane = place(clear_mesh);
    draw();
    EXPECT_EQ(bare, picture()) << "a pane of no opacity shows";
    world.patch<MeshRef>(pane, [&](MeshRef& m) { m.mesh = half_mesh; });
    draw();
    const auto covered = picture();
    const auto pane_dark = pixel_at(covered, dark_point, 5.0), pane_lit = pixel_at(covered, lit_point, 5.0);
    // The pane is green: in the light it is bright, in shadow only its ambient light is left, as dark as the ground.
    EXPECT_GT(pane_lit[1], pane_dark[1] + 30);
    EXPECT_GT(pane_lit[1], pane_lit[0] + 20);
    EXPECT_LT(pane_dark[0], ground_dark[0]);
    EXPECT_NEAR(pane_dark[1], ground_dark[1], 40);

    // Without its shadow the pane alone lights up there.
    world.patch<MeshRef>(pane, [](MeshRef& m) { m.receives_shadow = false; });
    draw();
    EXPECT_GT(pixel_at(picture(), dark_point, 5.0)[1], pane_dark[1] + 30);
    EXPECT_EQ(pixel_at(picture(), lit_point, 5.0), pane_lit);
}

}  // namespace
}  // namespace gnomon
