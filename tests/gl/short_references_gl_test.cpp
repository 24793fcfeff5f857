#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/mesh/mesh_topology.h"
#include "tests/gl/frame_fixture.h"

/// Maps that name triangles by one number a texel give the same depths, visibility and pictures, to the bit, as maps
/// with two numbers.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 128;

/// Bits of everything that a frame shows.
struct Shown {
    std::vector<float> visibility;
    std::vector<std::uint8_t> picture;
    LightCounts counts;
};

class ShortReferences : public FrameTest, public ::testing::WithParamInterface<bool> {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 16.0}, {16.0, 0.0, 0.0})), {}, false);
        for (int i = 0; i < 24; ++i) {
            const glm::dvec3 from(i % 6 - 3, 0.4, i / 6 - 2);
            const std::uint32_t mesh = add_mesh(game::make_box(from, from + glm::dvec3(0.8, 0.6, 0.7)));
            if (i % 2 == 0) library.meshes[mesh].topology = assets::analyse_topology(library.meshes[mesh]);
            place(mesh, {.rotation = glm::angleAxis(0.02 * i, glm::dvec3(0.0, 1.0, 0.0))});
            if (i % 7 == 0) place(mesh, {.translation_m = {0.0, 1.2, 0.0}});
        }
        add_masked();
        add_camera({.fov_y_rad = 0.9}, {0.0, 7.0, 8.0}, {0.0, -0.7, -0.8});
    }
    void add_masked() {
        assets::Texture texture;
        texture.name = "holes";
        texture.width = texture.height = 8;
        for (std::uint32_t i = 0; i < 64; ++i)
            texture.rgba.insert(texture.rgba.end(),
                                {200, 200, 200, static_cast<std::uint8_t>((i + i / 8) % 2 ? 255 : 0)});
        library.textures.push_back(texture);
        const std::uint32_t material = add_material({.name = "holes",
                                                     .base_colour_texture = 0,
                                                     .metallic = 0.0f,
                                                     .alpha_mode = assets::AlphaMode::mask,
                                                     .double_sided = true});
        place(add_mesh(game::make_card({1.0, 2.5, 0.0}, {0.0, 0.0, 3.0}, {1.8, 0.0, 0.0}), material));
    }
    ecs::Entity add(LightKind kind, CubeRoute route) {
        Light light{.kind = kind, .intensity = kind == LightKind::directional ? 3.0f : 2000.0f};
        light.outer_cone_rad = 1.0f;
        return add_light(light, {1.0, 6.0, 0.5}, {-0.15, -1.0, -0.1},
                         {.filter = ShadowFilter::triangles, .antialias = GetParam(), .resolution_px = kMap_px},
                         {.maps = {.cube_route = route}, .reuse = {.economy = false}});
    }
    Shown show(ecs::Entity light, bool are_short) {
        world.patch<ShadowTuning>(light, [&](ShadowTuning& t) { t.maps.short_references = are_short; });
        draw();
        return {visibility(), picture(), frame().report().lights.at(0).counts};
    }
};

INSTANTIATE_TEST_SUITE_P(Antialias, ShortReferences, ::testing::Bool());

TEST_P(ShortReferences, GiveTheSameBits) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point})
        for (const CubeRoute route : {CubeRoute::six_passes, CubeRoute::layered_vertex, CubeRoute::layered_geometry}) {
            if (route != CubeRoute::six_passes && kind != LightKind::point) continue;
            SCOPED_TRACE(static_cast<int>(kind) * 10 + static_cast<int>(route));
            const ecs::Entity light = add(kind, route);
            const Shown two = show(light, false), one = show(light, true), again = show(light, false);
            EXPECT_EQ(3 * one.counts.bytes, 2 * two.counts.bytes) << "depths and one number, or two";
            EXPECT_EQ(std::count(one.visibility.begin(), one.visibility.end(), 0.0f) > 100, true) << "it casts";
            for (const Shown* other : {&two, &again}) {
                EXPECT_EQ(
                    std::memcmp(one.visibility.data(), other->visibility.data(), one.visibility.size() * sizeof(float)),
                    0);
                EXPECT_EQ(one.picture, other->picture);
            }
            world.patch<LightShadow>(light, [](LightShadow& shadow) { shadow.filter = ShadowFilter::sharp_4x4; });
            EXPECT_NE(show(light, true).visibility, one.visibility) << "the triangles' numbers decide nothing here";
            world.destroy(light);
        }
}

}  // namespace
}  // namespace gnomon
