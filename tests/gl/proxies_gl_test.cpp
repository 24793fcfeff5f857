#include <algorithm>
#include <cstring>
#include <vector>

#include "tests/gl/frame_fixture.h"

/// Coarser meshes in place of dense casters: fewer triangles, and the shadows that rays to the casters' own triangles
/// find.
namespace gnomon {
namespace {

/// Share of pixels on the other side of a half than rays find that proxies may add.
constexpr double kMoreWrong = 0.0005;

/// Dense balls on a plane, at rising distances from the camera.
class ProxiesInMaps : public FrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 400.0}, {400.0, 0.0, 0.0})), {}, false);
        const std::uint32_t ball = add_mesh(game::make_sphere(1.0, 96, 64));
        assets::complete(library.meshes[ball]);
        for (int i = 0; i < 24; ++i)
            place(ball,
                  {.translation_m = {3.0 * (i % 3) - 3.0, 0.8, -12.0 - 6.0 * i}, .scale = glm::dvec3(1.0 + 0.1 * i)});
        add_camera({.fov_y_rad = 0.6}, {0.0, 8.0, 12.0}, {0.0, -0.14, -1.0});
        const bool sun = GetParam() == LightKind::directional;
        Light light{.kind = GetParam(), .intensity = sun ? 3.0f : 90000.0f};
        light.outer_cone_rad = 0.9f;
        light_ = add_light(light, {10.0, 60.0, -60.0}, {-0.3, -1.0, -0.35},
                           {.filter = ShadowFilter::triangles, .resolution_px = 1024}, {.reuse = {.economy = false}});
        ASSERT_GT(assets::add_proxies(library), 2u);
    }
    void set(ShadowFilter filter, bool proxies, float max_error_px = 0.0f) {
        world.patch<LightShadow>(light_, [&](LightShadow& s) {
            s.filter = filter;
            s.max_error_px = max_error_px;
        });
        world.patch<ShadowTuning>(light_, [&](ShadowTuning& t) { t.maps.proxies = proxies; });
    }
    std::vector<float> shown(ShadowFilter filter, bool proxies, float max_error_px = 0.0f) {
        set(filter, proxies, max_error_px);
        draw();
        return visibility();
    }
    LightCounts counts() { return frame().report().lights.at(0).counts; }

    ecs::Entity light_{};
};

std::size_t count_wrong(const std::vector<float>& shown, const std::vector<float>& rays) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) wrong += (shown[i] < 0.5f) != (rays[i] < 0.5f) ? 1 : 0;
    return wrong;
}

INSTANTIATE_TEST_SUITE_P(Lights, ProxiesInMaps,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

TEST_P(ProxiesInMaps, DrawFewerTrianglesAndShowWhatRaysFind) {
    const std::vector<float> rays = shown(ShadowFilter::exact, true);
    EXPECT_EQ(counts().triangles, counts().full_triangles) << "bounds are those of the casters themselves";
    EXPECT_GT(std::count(rays.begin(), rays.end(), 0.0f), 500);
    const std::vector<float> off = shown(ShadowFilter::triangles, false);
    EXPECT_EQ(counts().triangles, counts().full_triangles);
    const std::uint64_t full = counts().triangles;
    const std::vector<float> on = shown(ShadowFilter::triangles, true);
    EXPECT_EQ(counts().full_triangles, full);
    if (GetParam() == LightKind::directional) {
        EXPECT_LT(2 * counts().triangles, full);
    }
    EXPECT_LE(counts().triangles, full);
    const std::size_t wrong_off = count_wrong(off, rays), wrong_on = count_wrong(on, rays);
    RecordProperty("wrong_off", static_cast<int>(wrong_off));
    RecordProperty("wrong_on", static_cast<int>(wrong_on));
    EXPECT_LE(static_cast<double>(wrong_on),
              static_cast<double>(wrong_off) + kMoreWrong * static_cast<double>(rays.size()));
    const std::vector<float> again = shown(ShadowFilter::triangles, false);
    EXPECT_EQ(std::memcmp(again.data(), off.data(), off.size() * sizeof(float)), 0) << "no trace stays";
}

TEST_P(ProxiesInMaps, OfAHugeAllowanceAreTheCoarsest) {
    shown(ShadowFilter::triangles, true, 1e6f);
    const LightCounts most = counts();
    const auto& proxies = library.meshes[1].proxies;
    const std::uint64_t coarsest = library.meshes[proxies.back().mesh].indices.size() / 3;
    const std::uint64_t own = library.meshes[1].indices.size() / 3;
    EXPECT_EQ(most.full_triangles % own, 0u);
    EXPECT_EQ(most.triangles, most.full_triangles / own * coarsest);
}

// The control of the first test: what a bound of nothing lets through is seen.
TEST_P(ProxiesInMaps, WithAFalseBoundDarkenTheirOwnCasters) {
    const std::uint32_t larger = add_mesh(game::make_sphere(1.3, 24, 12));
    library.meshes[1].proxies = {{larger, 1e-12f}};
    const std::vector<float> rays = shown(ShadowFilter::exact, true);
    const std::vector<float> off = shown(ShadowFilter::triangles, false), on = shown(ShadowFilter::triangles, true);
    EXPECT_GT(static_cast<double>(count_wrong(on, rays)),
              static_cast<double>(count_wrong(off, rays)) + 4.0 * kMoreWrong * static_cast<double>(rays.size()));
}

}  // namespace
}  // namespace gnomon
