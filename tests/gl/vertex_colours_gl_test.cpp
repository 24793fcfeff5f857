#include <cmath>

#include "tests/gl/traced_frame_fixture.h"

/// COLOR_0 of vertices: its alpha cuts masked casters out, its colour is the picture's. What is right follows from the
/// meshes alone; the tracer must find it as well.
namespace gnomon {
namespace {

constexpr double kCardSide_m = 8.0, kSeenHalf_m = 3.6;

class VertexColours : public TracedFrameTest, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    /// Adds a card with the colour `low` in vertices at its lowest z and `high` at its highest.
    std::uint32_t add_card(std::uint32_t material, const glm::vec4& low, const glm::vec4& high) {
        const std::uint32_t mesh =
            add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, kCardSide_m}, {kCardSide_m, 0.0, 0.0}), material);
        for (const assets::Vertex& vertex : library.meshes[mesh].vertices)
            library.meshes[mesh].colours.push_back(vertex.position_ms.z < 0.0f ? low : high);
        return mesh;
    }
    void add_ground_and_camera() {
        const assets::Material matt{.name = "matt", .metallic = 0.0f};
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}), add_material(matt)), {}, false);
        add_camera({.projection = CameraProjection::orthographic, .half_height_m = kSeenHalf_m, .near_m = 0.1, .far_m = 40.0},
                   {0.0, 20.0, 0.0}, {0.0, -1.0, 0.0});
    }
    double z_of(std::size_t pixel) const {
        const double width = settings.viewport_px.x, height = settings.viewport_px.y;
        const double u = (static_cast<double>(pixel % settings.viewport_px.x) + 0.5) / width * 2.0 - 1.0;
        return u * kSeenHalf_m * width / height;
    }
    /// Counts the pixels that are not dark for z from `begin` to `end`, or not lit elsewhere. It leaves out a pixel or
    /// two beside these ends.
    std::size_t wrong(const std::vector<float>& visibility, double begin, double end) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < visibility.size(); ++i) {
            const double z = z_of(i);
            if (std::abs(z - begin) < 0.06 || std::abs(z - end) < 0.06) continue;
            const float right = z > begin && z < end ? 0.0f : 1.0f;
            count += std::abs(visibility[i] - right) > 0.5f ? 1 : 0;
        }
        return count;
    }
};

INSTANTIATE_TEST_SUITE_P(Filters, VertexColours,
                         ::testing::Values(ShadowFilter::hard, ShadowFilter::triangles, ShadowFilter::exact),
                         [](const auto& test) { return std::to_string(static_cast<int>(test.param)); });

TEST_P(VertexColours, CutMaskedCastersOutWhereTheirAlphaIsBelowTheCutoff) {
    add_ground_and_camera();
    const std::uint32_t leaf = add_material({.name = "leaf", .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
    const ecs::Entity card = place(add_card(leaf, {1, 1, 1, 0}, {1, 1, 1, 1}), {.translation_m = {0.0, 1.0, 0.0}});
    world.patch<MeshRef>(card, [](MeshRef& m) { m.visible = false; });
    for (const LightKind kind : {LightKind::directional, LightKind::point})
        add_light({.kind = kind}, {0.0, 200.0, 0.0}, {0.0, -1.0, 0.0}, {.filter = GetParam(), .resolution_px = 2048});
    draw();
    for (const std::uint32_t light : {0u, 1u}) {
        const Judged judged = judge(light);
        EXPECT_EQ(wrong(judged.truth, 0.0, 0.5 * kCardSide_m), 0u) << "the tracer, light " << light;
        EXPECT_EQ(wrong(judged.measured, 0.0, 0.5 * kCardSide_m), 0u) << "light " << light;
    }
}

TEST_P(VertexColours, WithoutThemTheWholeCardCasts) {
    // Negative control.
    add_ground_and_camera();
    const std::uint32_t leaf = add_material({.name = "leaf", .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
    const std::uint32_t mesh = add_card(leaf, {1, 1, 1, 0}, {1, 1, 1, 1});
    library.meshes[mesh].colours.clear();
    const ecs::Entity card = place(mesh, {.translation_m = {0.0, 1.0, 0.0}});
    world.patch<MeshRef>(card, [](MeshRef& m) { m.visible = false; });
    add_light({.kind = LightKind::directional}, {}, {0.0, -1.0, 0.0}, {.filter = GetParam(), .resolution_px = 2048});
    draw();
    const Judged judged = judge();
    EXPECT_EQ(wrong(judged.measured, -0.5 * kCardSide_m, 0.5 * kCardSide_m), 0u);
    EXPECT_GT(wrong(judged.measured, 0.0, 0.5 * kCardSide_m), judged.measured.size() / 4);
}

TEST_P(VertexColours, AreThePicturesColours) {
    add_ground_and_camera();
    const std::uint32_t matt = add_material({.name = "painted", .metallic = 0.0f});
    const std::uint32_t glass = add_material({.name = "glass", .metallic = 0.0f, .alpha_mode = assets::AlphaMode::blend});
    place(add_card(matt, {1, 0, 0, 1}, {0, 1, 0, 1}), {.translation_m = {0.0, 1.0, 0.0}});
    const ecs::Entity blended = place(add_card(glass, {0, 0, 1, 1}, {0, 0, 1, 0}), {.translation_m = {0.0, 2.0, 0.0}});
    add_light({.kind = LightKind::directional, .intensity = 2000.0f}, {}, {0.0, -1.0, 0.0},
              {.filter = GetParam(), .resolution_px = 512, .translucent_casters = false});
    const auto pixel_at = [&](double z) {
        const double u = z / (kSeenHalf_m * settings.viewport_px.x / settings.viewport_px.y);
        const auto x = static_cast<std::size_t>((0.5 * u + 0.5) * settings.viewport_px.x);
        const std::vector<std::uint8_t> rgba = picture();
        const std::size_t at = 4 * (std::size_t{settings.viewport_px.y / 2} * settings.viewport_px.x + x);
        return glm::ivec3(rgba[at], rgba[at + 1], rgba[at + 2]);
    };
    draw();
    EXPECT_GT(pixel_at(-3.9).b, 2 * pixel_at(-3.9).r) << "the glass is blue where it is dense";
    EXPECT_LT(2 * pixel_at(3.9).b, pixel_at(3.9).g) << "and lets the green through where it is not";
    world.patch<MeshRef>(blended, [](MeshRef& m) { m.visible = false; });
    draw();
    EXPECT_GT(pixel_at(-3.9).r, 2 * pixel_at(-3.9).g);
    EXPECT_GT(pixel_at(3.9).g, 2 * pixel_at(3.9).r);
    EXPECT_EQ(pixel_at(0.0).b, pixel_at(3.9).b);
}

}  // namespace
}  // namespace gnomon
