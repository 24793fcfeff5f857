#include <gtest/gtest.h>

#include <algorithm>

#include <glm/ext/matrix_double4x4.hpp>

#include "tests/unit/core/core_scene.h"
#include "tests/unit/math/random_seed.h"

/// That a map drawn by clip_from_anchor is found again by map_from_anchor, on every API.
namespace gnomon::core {
namespace {

struct Api {
    const char* name;
    Convention convention;
};
/// The constants of gnomon/core.h, and the same with the other depths.
const Api kApis[] = {{"OpenGL", kOpenGl},
                     {"OpenGL without glClipControl", {.reversed_depth = false, .zero_to_one = false}},
                     {"Vulkan", kVulkan},
                     {"Vulkan, near 0", {.reversed_depth = false, .clip_y_down = true, .rows_down = true}},
                     {"Direct3D", kDirect3D},
                     {"Metal", kMetal},
                     {"WebGPU, near 0", {.reversed_depth = false, .rows_down = true}}};

/// Computes where an API's own rules put a vertex: the texel's coordinates, and the depth that is stored.
glm::dvec3 rasterised(const Convention& api, const glm::dvec4& clip) {
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    const double from_top = api.clip_y_down ? 0.5 * (ndc.y + 1.0) : 0.5 * (1.0 - ndc.y);
    return {0.5 * (ndc.x + 1.0), api.rows_down ? from_top : 1.0 - from_top, api.zero_to_one ? ndc.z : 0.5 * (ndc.z + 1.0)};
}

class CoreConventions : public ::testing::Test {
protected:
    const View* some_view(const Fits& of, ViewKind kind) const {
        for (const View& view : of.views())
            if (view.kind == kind && view.casters.count > 0) return &view;
        return nullptr;
    }
    glm::dvec3 before(const View& view, Random& random) const {
        const glm::dvec3 at = random.inside({-0.9, -0.9, 0.1}, {0.9, 0.9, 0.9});
        const double z_m = view.near_m + at.z * (view.far_m - view.near_m);
        if (view.kind != ViewKind::orthographic)
            return view.eye_ws_m + z_m * (at.x * 0.4 * view.axis_u + at.y * 0.4 * view.axis_v - view.axis_back);
        const glm::dvec4 middle = glm::inverse(view.map_from_world) * glm::dvec4(0.5 + 0.4 * at.x, 0.5 + 0.4 * at.y, at.z, 1.0);
        return glm::dvec3(middle) / middle.w;
    }
    OwnScene own = courtyard();
    Fits fits, plain;
};

TEST_F(CoreConventions, FindWhatWasDrawn) {
    Random random(print_seed());
    for (const Api& api : kApis) {
        History history;
        fit_shadows(own.scene(), {.convention = api.convention}, history, fits);
        for (const ViewKind kind : {ViewKind::orthographic, ViewKind::perspective, ViewKind::cube_face}) {
            const View* view = some_view(fits, kind);
            ASSERT_NE(view, nullptr) << api.name;
            for (int i = 0; i < 100; ++i) {
                const glm::dvec3 p = before(*view, random);
                const glm::dvec4 near(p - view->anchor_ws_m, 1.0);
                const glm::dvec3 drawn = rasterised(api.convention, glm::dmat4(view->clip_from_anchor) * near);
                const glm::dvec3 found = map_place(*view, p);
                EXPECT_LT(glm::length(drawn - found), 3e-6) << api.name;
                const glm::dvec4 world(p, 1.0);
                const glm::dvec4 from_world = view->map_from_world * world;
                EXPECT_LT(glm::length(glm::dvec3(from_world) / from_world.w - found), 1e-9) << api.name;
                EXPECT_LT(glm::length(rasterised(api.convention, view->clip_from_world * world) - drawn), 1e-9) << api.name;
            }
        }
    }
}

TEST_F(CoreConventions, TurnDepthAndRowsAsTheySay) {
    Random random(print_seed());
    History first;
    fit_shadows(own.scene(), {}, first, plain);
    for (const Api& api : kApis) {
        History history;
        fit_shadows(own.scene(), {.convention = api.convention}, history, fits);
        ASSERT_EQ(fits.views().size(), plain.views().size());
        for (std::size_t v = 0; v < fits.views().size(); ++v) {
            const View &view = fits.views()[v], &own_view = plain.views()[v];
            const bool cube = view.kind == ViewKind::cube_face;
            EXPECT_EQ(view.mirrored, cube && api.convention.rows_down);
            const glm::dvec3 p = before(own_view, random), toward = view.kind == ViewKind::orthographic
                                                                        ? view.axis_back
                                                                        : glm::normalize(view.eye_ws_m - p);
            const glm::dvec3 here = map_place(view, p), usual = map_place(own_view, p);
            const double nearer = map_place(view, p + toward * 0.01).z;
            EXPECT_EQ(nearer > here.z, api.convention.reversed_depth) << api.name;
            EXPECT_NEAR(here.z, api.convention.reversed_depth ? usual.z : 1.0 - usual.z, 1e-6) << api.name;
            EXPECT_NEAR(here.y, api.convention.rows_down && !cube ? 1.0 - usual.y : usual.y, 1e-6) << api.name;
        }
    }
}

/// A cube's lookup as every API has it: the face of the largest coordinate, and (s, t) on it.
struct CubePlace {
    std::uint32_t face;
    glm::dvec2 st;
};
CubePlace cube_place(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z)
        return {d.x > 0.0 ? 0u : 1u, 0.5 * (glm::dvec2(d.x > 0.0 ? -d.z : d.z, -d.y) / a.x + 1.0)};
    if (a.y >= a.z) return {d.y > 0.0 ? 2u : 3u, 0.5 * (glm::dvec2(d.x, d.y > 0.0 ? d.z : -d.z) / a.y + 1.0)};
    return {d.z > 0.0 ? 4u : 5u, 0.5 * (glm::dvec2(d.z > 0.0 ? d.x : -d.x, -d.y) / a.z + 1.0)};
}

TEST_F(CoreConventions, LetACubeBeLookedUpByDirection) {
    Random random(print_seed());
    for (const Api& api : kApis) {
        History history;
        fit_shadows(own.scene(), {.convention = api.convention}, history, fits);
        const LightFit& fit = fits.lights()[2];
        ASSERT_TRUE(fit.cube);
        int found = 0, turned = 0;
        for (const View& view : fits.views_of(2))
            for (int i = 0; i < 50; ++i) {
                const glm::dvec3 p = before(view, random);
                const CubePlace place = cube_place(fit.cube_from_world * (p - view.eye_ws_m));
                EXPECT_EQ(place.face, view.layer) << api.name;
                EXPECT_LT(glm::length(place.st - glm::dvec2(map_place(view, p))), 1e-6) << api.name;
                ++found;
                turned += cube_place(p - view.eye_ws_m).face != view.layer ? 1 : 0;
            }
        EXPECT_GT(found, 100);
        EXPECT_GT(turned, 0) << "without cube_from_world it is another face";
    }
}

/// Checks that the float matrix finds points as well, wherever in the world the scene lies.
TEST_F(CoreConventions, KeepTheirPrecisionFarFromTheOrigin) {
    Random random(print_seed());
    for (const double away_m : {0.0, 1.0e6, 1.0e8}) {
        OwnScene moved = own;
        moved.move({away_m, 0.0, -away_m});
        History history;
        fit_shadows(moved.scene(), {}, history, fits);
        for (const View& view : fits.views()) {
            const double map_px = fits.lights()[view.light].map_px;
            for (int i = 0; i < 20; ++i) {
                const glm::dvec3 p = before(view, random);
                const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p - view.anchor_ws_m), 1.0f);
                const glm::dvec3 found = glm::dvec3(q) / static_cast<double>(q.w);
                EXPECT_LT(glm::length(glm::dvec2(found - map_place(view, p))) * map_px, 0.02) << away_m;
            }
        }
        // What the anchor is for: without it a float knows no place out there.
        const View& view = fits.views().front();
        double off = 0.0;  // largest of some: one alone may lie on a step of floats
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = before(view, random);
            const glm::vec4 q = glm::mat4(view.map_from_world) * glm::vec4(glm::vec3(p), 1.0f);
            off = std::max(off, glm::length(glm::dvec2(glm::dvec3(q) / static_cast<double>(q.w) - map_place(view, p))));
        }
        EXPECT_EQ(off * fits.lights()[0].map_px > 1.0, away_m > 0.0) << away_m;
    }
}

}  // namespace
}  // namespace gnomon::core
