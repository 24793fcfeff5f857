#include <gtest/gtest.h>

#include <glm/ext/matrix_double4x4.hpp>

#include "tests/unit/core/core_scene.h"
#include "tests/unit/math/random_seed.h"

/// That offset_at() keeps a plane from shadowing itself, in maps as an API would store them, and that less does not.
namespace gnomon::core {
namespace {

const Convention kConventions[] = {kOpenGl, kVulkan, {.reversed_depth = false, .rows_down = true}};

/// Returns what a map stores at a texel's centre of the plane y = 0; NaN where the texel's ray meets none of it.
float stored(const View& view, const glm::dmat4& world_from_map, const glm::dvec2& uv) {
    const auto at = [&](double depth) {
        const glm::dvec4 p = world_from_map * glm::dvec4(uv, depth, 1.0);
        return glm::dvec3(p) / p.w;
    };
    const glm::dvec3 a = at(0.9), b = at(0.4);
    const double share = a.y / (a.y - b.y);
    return static_cast<float>(map_place(view, a + share * (b - a)).z);
}

struct Count {
    int looked_up = 0, dark = 0;
};

/// Looks up random points of the ground with a part of the offset, by every texel that the filter may read.
Count dark_points(const OwnScene& own, const Settings& settings, std::uint32_t light, double part, Random& random) {
    History history;
    Fits fits;
    fit_shadows(own.scene(), settings, history, fits);
    const bool reversed = settings.convention.reversed_depth;
    Count count;
    for (const View& view : fits.views_of(light)) {
        const double map_px = fits.lights()[light].map_px;
        const glm::dmat4 world_from_map = glm::inverse(view.map_from_world);
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 p(random.number(-8.0, 8.0), 0.0, random.number(-8.0, 8.0)), up(0.0, 1.0, 0.0);
            const glm::dvec3 own_place = map_place(view, p);
            if (!holds(own_place) || !reaches(own.lights[light], p)) continue;
            const Offset offset = offset_at(view, p, up);
            const glm::dvec3 place = map_place(view, p + up * (part * offset.along_normal_m));
            const double depth = place.z + (reversed ? 1.0 : -1.0) * part * offset.depth;
            const glm::dvec2 at_texel = glm::dvec2(place) * map_px;
            const double reach_texel = view.bias.reach_texel - 1.0 / 256.0;
            bool dark = false;
            const auto first = [&](double at) { return std::ceil(at - reach_texel - 0.5); };
            const auto last = [&](double at) { return std::floor(at + reach_texel - 0.5); };
            for (double y = first(at_texel.y); y <= last(at_texel.y); ++y)
                for (double x = first(at_texel.x); x <= last(at_texel.x); ++x) {
                    const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) / map_px;
                    if (uv.x < 0.0 || uv.y < 0.0 || uv.x > 1.0 || uv.y > 1.0) continue;
                    const auto there = static_cast<double>(stored(view, world_from_map, uv));
                    dark |= reversed ? static_cast<double>(static_cast<float>(depth)) < there
                                     : static_cast<double>(static_cast<float>(depth)) > there;
                }
            ++count.looked_up;
            count.dark += dark ? 1 : 0;
        }
    }
    return count;
}

class CoreBias : public ::testing::TestWithParam<LightKind> {};

TEST_P(CoreBias, KeepsAPlaneFromShadowingItself) {
    Random random(print_seed());
    const auto light = static_cast<std::uint32_t>(GetParam());
    for (const Filter filter : {Filter::hard, Filter::bilinear, Filter::grid, Filter::disk})
        for (const DepthFormat format : {DepthFormat::d32f, DepthFormat::d24})
            for (const Convention& convention : kConventions) {
                OwnScene own = courtyard();
                own.lights[light].shadow.filter = filter;
                own.lights[light].shadow.depth_format = format;
                own.lights[light].shadow.resolution_px = 512;
                const Settings settings{.convention = convention};
                const Count enough = dark_points(own, settings, light, 1.0, random);
                EXPECT_EQ(enough.dark, 0) << static_cast<int>(filter);
                EXPECT_GT(enough.looked_up, 100);
                const Count without = dark_points(own, settings, light, 0.0, random);
                EXPECT_GT(without.dark, without.looked_up / 4) << "no offset: acne";
            }
}

TEST_P(CoreBias, IsNoLargerThanItHasToBe) {
    Random random(print_seed());
    const auto light = static_cast<std::uint32_t>(GetParam());
    OwnScene own = courtyard();
    own.lights[light].shadow.filter = Filter::hard;
    own.lights[light].shadow.resolution_px = 512;
    int dark = 0;
    for (int round = 0; round < 40; ++round) dark += dark_points(own, {}, light, 0.9, random).dark;
    EXPECT_GT(dark, 0) << "with nine tenths of it acne returns";
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoreBias, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

}  // namespace
}  // namespace gnomon::core
