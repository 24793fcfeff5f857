#include <algorithm>
#include <cstring>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "tests/gl/room_fixture.h"

// However a point light's faces are drawn, the maps are the same.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 128;
constexpr std::size_t kSomeOfRoute = 200;

class CubeRoutes : public RoomTest {
protected:
    void SetUp() override {
        RoomTest::SetUp();
        truth.margin_m = 0.15;
        add_room(4.0);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    if (std::abs(x) + std::abs(y) + std::abs(z) < 2) continue;
                    const glm::dvec3 at = 1.3 * glm::dvec3(x, y, z);
                    add_box(at - 0.22, at + 0.22);
                }
        for (const CubeRoute route : {CubeRoute::six_passes, CubeRoute::layered_vertex, CubeRoute::layered_geometry})
            add_light({.kind = LightKind::point, .intensity = 1000.0f}, glm::dvec3(0.1, -0.2, 0.15), {0.0, 0.0, -1.0},
                      {.filter = ShadowFilter::pcf_grid, .resolution_px = kMap_px},
                      {.maps = {.cube_route = route}, .reuse = {.economy = false}});
    }
    /// Returns the maps that the light passes bind, in the order of the lights.
    std::vector<gl::TextureHandle> maps() {
        constexpr std::uint32_t kMapUnit = 4;
        std::vector<gl::TextureHandle> found;
        for (const gl::Command& command : frame().commands().commands) {
            const auto* bind = std::get_if<gl::BindTexture>(&command);
            if (bind && bind->unit == kMapUnit && bind->texture &&
                std::find(found.begin(), found.end(), bind->texture) == found.end())
                found.push_back(bind->texture);
        }
        return found;
    }
    std::vector<float> face(gl::TextureHandle map, std::uint32_t layer) {
        std::vector<float> texels(kMap_px * kMap_px);
        EXPECT_TRUE(device().read_texture(map, layer, std::as_writable_bytes(std::span(texels))));
        return texels;
    }
    std::size_t passes_with(const char* text) const {
        return static_cast<std::size_t>(std::count_if(
            last_.commands.begin(), last_.commands.end(), [&](const gl::Command& command) {
                const auto* group = std::get_if<gl::BeginGroup>(&command);
                return group && group->label.text().find("shadow") == 0 && group->label.text().find(text) != std::string::npos;
            }));
    }
    void draw_and_keep() {
        draw();
        last_ = frame().commands();
    }
    gl::CommandList last_;
};

TEST_F(CubeRoutes, GiveTheSameBitsInEveryFace) {
    add_camera({.projection = CameraProjection::orthographic, .half_height_m = 6.0, .near_m = 0.1, .far_m = 40.0},
               {0.0, 20.0, 0.0}, {0.0, -1.0, 0.0});  // sees all walls, so that every face is a view
    draw_and_keep();
    ASSERT_EQ(maps().size(), 3u);
    for (const LightReport& light : frame().report().lights) EXPECT_EQ(light.counts.views_drawn, 6u);
    EXPECT_EQ(passes_with("faces"), device().info().vertex_layer ? 2u : 1u);
    std::size_t drawn = 0;
    for (std::uint32_t layer = 0; layer < 6; ++layer) {
        const std::vector<float> one_by_one = face(maps()[0], layer);
        drawn += static_cast<std::size_t>(std::count_if(one_by_one.begin(), one_by_one.end(), [](float d) { return d > 0.0f; }));
        for (const std::size_t other : {1u, 2u}) {
            const std::vector<float> layered = face(maps()[other], layer);
            EXPECT_EQ(std::memcmp(one_by_one.data(), layered.data(), layered.size() * sizeof(float)), 0)
                << "route " << other << ", face " << layer;
        }
    }
    EXPECT_GT(drawn, kSomeOfRoute);
    EXPECT_NE(face(maps()[0], 0), face(maps()[0], 1)) << "faces differ, or the comparison says little";
}

TEST_F(CubeRoutes, MaskedCastersHaveTheirProgramsToo) {
    const auto source = [](const char* file, bool by_vertex) {
        std::vector<std::string> defines{"MASKED 1", "LAYERED 1"};
        if (by_vertex) defines.emplace_back("LAYER_BY_VERTEX 1");
        return gl::expand_shader(shader_files(), file, defines).value();
    };
    for (const bool by_vertex : {false, true}) {
        if (by_vertex && !device().info().vertex_layer) continue;
        const auto made = device().create_program({"masked", source("shadow/passes/depth/depth.vert", by_vertex),
                                                   source("shadow/passes/depth/depth.frag", by_vertex),
                                                   by_vertex ? std::string() : source("shadow/passes/depth/layer.geom", false)});
        EXPECT_TRUE(made) << made.log;
        device().destroy(made.handle);
    }
}

TEST_F(CubeRoutes, LeaveFacesAloneThatAreNotDrawn) {
    add_camera({.fov_y_rad = 0.9}, {0.8, 0.3, 0.4}, {1.0, 0.8, 0.1});  // a wall, the ceiling, and the edge between
    draw_and_keep();
    const auto& lights = frame().report().lights;
    EXPECT_LT(lights[0].counts.views_drawn, 6u);
    EXPECT_GE(lights[0].counts.views_drawn, 2u);
    for (std::uint32_t light = 0; light < 3; ++light) {
        SCOPED_TRACE(light);
        EXPECT_EQ(lights[light].counts.views_drawn, lights[0].counts.views_drawn);
        EXPECT_EQ(lights[light].counts.clears, lights[0].counts.clears);
        EXPECT_EQ(lights[light].counts.triangles, lights[0].counts.triangles);
        expect_true(0, kSomeOfRoute, light);
        EXPECT_EQ(visibility(light), visibility(0));
    }
    EXPECT_LT(lights[2].counts.draws, lights[0].counts.draws) << "one draw per mesh serves every face";
}

}  // namespace
}  // namespace gnomon
