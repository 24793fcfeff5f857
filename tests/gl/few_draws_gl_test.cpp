#include <algorithm>
#include <cstring>
#include <set>

#include "engine/mesh/mesh_topology.h"
#include "tests/gl/frame_fixture.h"

/// Maps and pictures are the same to the bit whether one command draws many meshes, or one each.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 128;

/// Bits of everything that a frame shows, and of every map that it looks up.
struct Shown {
    std::vector<std::vector<std::byte>> maps;  // layers, in the order in which they are first bound
    std::vector<float> visibility;
    std::vector<std::uint8_t> picture;
    LightCounts counts;
};

class FewDraws : public FrameTest, public ::testing::WithParamInterface<ShadowFilter> {
protected:
    /// Boxes that touch, overlap and coincide, so that many depths are equal: solid, open, mirrored and masked ones.
    void SetUp() override {
        FrameTest::SetUp();
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 16.0}, {16.0, 0.0, 0.0})), {}, false);
        for (int i = 0; i < 24; ++i) {
            const glm::dvec3 from(i % 6 - 3, 0.4, i / 6 - 2);
            const bool turned = i % 5 == 0;
            const std::uint32_t mesh = add_mesh(game::make_box(from, from + glm::dvec3(1.0, 0.6, 1.0)));
            if (i % 2 == 0) library.meshes[mesh].topology = assets::analyse_topology(library.meshes[mesh]);
            if (turned) library.meshes[mesh].bounds_ms = math::extended(library.meshes[mesh].bounds_ms, -from);
            casters.push_back(place(mesh, {.scale = turned ? glm::dvec3(-1.0, 1.0, 1.0) : glm::dvec3(1.0)}));
            if (i % 7 == 0) casters.push_back(place(mesh));  // a second instance, of a place of its own or the same
        }
        add_masked();
        add_camera({.fov_y_rad = 0.9}, {0.0, 7.0, 8.0}, {0.0, -0.7, -0.8});
    }
    /// Adds three cards with holes: two of one masked material, one of another.
    void add_masked() {
        assets::Texture texture;
        texture.name = "holes";
        texture.width = texture.height = 8;
        for (std::uint32_t i = 0; i < 64; ++i)
            texture.rgba.insert(texture.rgba.end(),
                                {200, 200, 200, static_cast<std::uint8_t>((i + i / 8) % 2 ? 255 : 0)});
        library.textures.push_back(texture);
        for (int i = 0; i < 3; ++i) {
            if (i != 1)
                material = add_material({.name = "holes",
                                         .base_colour_texture = 0,
                                         .metallic = 0.0f,
                                         .alpha_mode = assets::AlphaMode::mask,
                                         .double_sided = true});
            const game::Shape card = game::make_card({2.0 * i - 2.0, 1.5, 0.0}, {0.0, 0.0, 3.0}, {1.8, 0.0, 0.0});
            casters.push_back(place(add_mesh(card, material)));
        }
    }
    ecs::Entity add(LightKind kind, CubeRoute route = CubeRoute::automatic) {
        Light light{.kind = kind, .intensity = kind == LightKind::directional ? 3.0f : 2000.0f};
        light.outer_cone_rad = 1.0f;
        return add_light(light, {1.0, 6.0, 0.5}, {-0.15, -1.0, -0.1}, {.filter = GetParam(), .resolution_px = kMap_px},
                         {.maps = {.cube_route = route}, .reuse = {.economy = false}});
    }
    Shown show(ecs::Entity light, bool multi_draw, bool short_references = true) {
        edit_light(world, light, [&](ShadowTuning& t) {
            t.maps.multi_draw = multi_draw, t.maps.short_references = short_references;
        });
        draw();
        Shown shown;
        std::set<std::uint32_t> seen;
        for (const gl::Command& command : frame().commands().commands) {
            const auto* bind = std::get_if<gl::BindTexture>(&command);
            if (!bind || !bind->texture || !seen.insert(bind->texture.id).second) continue;
            for (const std::size_t texel : {sizeof(float), 2 * sizeof(float)})
                for (std::uint32_t layer = 0; layer < 6; ++layer) {
                    std::vector<std::byte> bits(kMap_px * kMap_px * texel);
                    if (device().read_texture(bind->texture, layer, bits)) shown.maps.push_back(std::move(bits));
                }
        }
        shown.visibility = visibility();
        shown.picture = picture();
        shown.counts = frame().report().lights.at(0).counts;
        return shown;
    }
    static void expect_same(const Shown& a, const Shown& b) {
        EXPECT_FALSE(a.maps.empty());
        EXPECT_EQ(a.maps, b.maps);
        EXPECT_EQ(std::memcmp(a.visibility.data(), b.visibility.data(), a.visibility.size() * sizeof(float)), 0);
        EXPECT_EQ(a.picture, b.picture);
    }
    std::uint32_t material = 0;
    std::vector<ecs::Entity> casters;
};

INSTANTIATE_TEST_SUITE_P(Filters, FewDraws,
                         ::testing::Values(ShadowFilter::hardware_2x2, ShadowFilter::triangles, ShadowFilter::exact,
                                           ShadowFilter::vsm));

TEST_P(FewDraws, GiveTheSameBits) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        SCOPED_TRACE(static_cast<int>(kind));
        for (const CubeRoute route : {CubeRoute::six_passes, CubeRoute::layered_vertex, CubeRoute::layered_geometry}) {
            if (route != CubeRoute::six_passes && kind != LightKind::point) continue;
            SCOPED_TRACE(static_cast<int>(route));
            const ecs::Entity light = add(kind, route);
            const Shown off = show(light, false), on = show(light, true);
            expect_same(on, off);
            EXPECT_EQ(on.counts.draws, off.counts.draws);
            EXPECT_EQ(off.counts.draw_commands, off.counts.draws);
            EXPECT_LT(on.counts.draw_commands, off.counts.draws) << "or nothing was merged";
            world.destroy(light);
        }
    }
}

TEST_P(FewDraws, WithoutOneCasterGiveOthers) {
    const ecs::Entity light = add(LightKind::spot);
    const Shown all = show(light, true);
    world.destroy(casters[4]);  // the only one at its place
    const Shown less = show(light, true);
    EXPECT_NE(all.maps, less.maps);
    EXPECT_NE(all.visibility, less.visibility);
    EXPECT_NE(all.picture, less.picture);
}

TEST_P(FewDraws, ShowTheTriangleOfEachDrawAmongThoseOfAllMeshes) {
    if (GetParam() != ShadowFilter::triangles) GTEST_SKIP() << "the other maps name none";
    const Shown shown = show(add(LightKind::spot), true, false);
    std::set<std::uint32_t> triangles;
    for (const std::vector<std::byte>& map : shown.maps) {
        if (map.size() != std::size_t{8} * kMap_px * kMap_px) continue;
        for (std::size_t at = 0; at < map.size(); at += 8) {
            std::uint32_t texel[2];
            std::memcpy(texel, map.data() + at, sizeof texel);
            triangles.insert(texel[1]);
        }
    }
    std::size_t all = 0;
    for (const assets::Mesh& mesh : library.meshes) all += mesh.indices.size() / 3;
    ASSERT_GT(triangles.size(), casters.size()) << "most boxes show several";
    EXPECT_LT(*triangles.rbegin(), all) << "a number that ran on from draw to draw would pass it";
}

}  // namespace
}  // namespace gnomon
