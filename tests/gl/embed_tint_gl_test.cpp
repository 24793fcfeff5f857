#include <algorithm>
#include <cmath>

#include "tests/gl/embed_fixture.h"

// gnomon::Shadows hands over the colours of translucent casters: they are what Gnomon's own frame shows.
namespace gnomon {
namespace {

class EmbedTint : public EmbedTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Adds a pane that neither renderer shows.
    CasterId add_glass(const glm::vec3& transmittance, const glm::dvec3& at_m) {
        const game::Shape pane = game::make_card(at_m, {1.1, 0.0, 0.0}, {0.0, 0.0, -1.1});
        assets::Material glass{.name = "glass", .metallic = 0.0f, .double_sided = true};
        glass.transmission = transmittance;
        const ecs::Entity entity = place(add_mesh(pane, add_material(glass)));
        world.patch<MeshRef>(entity, [](MeshRef& m) { m.visible = false; });
        const auto mesh = shadows->add_mesh({.name = "glass",
                                             .positions_m = pane.positions,
                                             .indices = pane.indices,
                                             .two_sided = true,
                                             .transmittance = transmittance});
        EXPECT_TRUE(mesh) << to_line(mesh.error());
        return shadows->add_caster({.mesh = mesh.value()});
    }
    /// Returns the colours of the mask's first layer.
    static std::vector<std::uint8_t> tints_of(const Mask& mask) {
        std::vector<std::uint8_t> texels(std::size_t{4} * kWidth_px * kHeight_px);
        glGetTextureSubImage(mask.tint_texture, 0, 0, 0, 0, kWidth_px, kHeight_px, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                             static_cast<GLsizei>(texels.size()), texels.data());
        return texels;
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, EmbedTint,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(EmbedTint, IsWhatTheFrameShows) {
    make_engine(Depths::usual_float);
    add_room();
    add_shadowed(GetParam(), {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    view.normal_texture = engine->normals;
    draw_depths(view, *engine);
    // Without glass there is no texture.
    EXPECT_EQ(shadows->render(view).tint_texture, 0u);
    const CasterId red = add_glass({0.9f, 0.2f, 0.1f}, {0.2, 1.7, 0.1});
    const CasterId blue = add_glass({0.2f, 0.3f, 0.9f}, {0.7, 2.1, 0.4});
    const Mask mask = shadows->render(view);
    ASSERT_NE(mask.tint_texture, 0u);
    const std::vector<std::uint8_t> tints = tints_of(mask);
    draw();
    std::vector<glm::vec4> shown;
    ASSERT_TRUE(frame().read_tint(0, shown));
    std::size_t tinted = 0;
    double off = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        tinted += shown[i].g < 0.9f ? 1 : 0;
        for (int channel = 0; channel < 3; ++channel) {
            const float apart = std::abs(static_cast<float>(tints[4 * i + static_cast<std::size_t>(channel)]) - 255.0f * shown[i][channel]);
            off += static_cast<double>(apart) / 3.0;
        }
    }
    EXPECT_GT(tinted, 1000u);
    // Fits of the two may differ, and with them how wide edges are: a mean, of 255ths.
    std::printf("%s: %zu tinted, mean difference %.3f/255\n", kind_name(GetParam()), tinted, off / static_cast<double>(shown.size()));
    EXPECT_LT(off / static_cast<double>(shown.size()), 1.0);
    for (const CasterId pane : {red, blue}) shadows->remove(pane);
    EXPECT_EQ(shadows->render(view).tint_texture, 0u);
}

}  // namespace
}  // namespace gnomon
