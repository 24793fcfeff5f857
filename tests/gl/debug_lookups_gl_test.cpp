#include <algorithm>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>

#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/debug_picture.h"

// What debug views of a light's lookups show, pixel by pixel, against what the scene and the labels say.
namespace gnomon {
namespace {

constexpr double kTint = 0.4, kOpaque = 0.9;  // shaders/debug/cascades.frag; bias.frag and penumbra.frag
constexpr std::size_t kMany = 3000;           // pixels; a claim about fewer is none

const Light kSun{.kind = LightKind::directional, .intensity = 10000.0f};
const Light kSpot{.kind = LightKind::spot, .intensity = 5000.0f, .inner_cone_rad = 0.4f, .outer_cone_rad = 0.6f};
const Light kPoint{.kind = LightKind::point, .intensity = 5000.0f};

class DebugLookups : public DebugPictureTest {
protected:
    void SetUp() override {
        DebugPictureTest::SetUp();
        truth.margin_m = 0.05;
        add_ground(40.0);
    }
    void add_post() { add_box({-0.3, 0.0, -4.3}, {0.3, 1.5, -3.7}); }
    /// Adds one post for each of a sun's cascades.
    void add_posts() {
        for (const double z : {0.5, -4.0, -9.0, -18.0, -32.0}) add_box({-0.6, 0.0, z - 0.3}, {-0.2, 1.2, z + 0.3});
    }
    void look_along() { add_camera({.fov_y_rad = 0.9, .near_m = 0.1}, {0.3, 2.2, 3.0}, {0.0, -0.35, -1.0}); }
    std::string light_name() { return frame().snapshot().lights.front().name; }

    /// Calls `check` for every pixel of the ground, except its rim, with the place that it sees. Returns how often that
    /// returned true.
    std::size_t for_ground(const std::function<bool(std::uint32_t, std::uint32_t, const glm::dvec3&)>& check) {
        std::size_t checked = 0;
        for (std::uint32_t y = 0; y < size_px().y; ++y)
            for (std::uint32_t x = 0; x < size_px().x; ++x) {
                const auto p = ground_at(x, y);
                const bool on_card = p && std::max(std::abs(p->x), std::abs(p->z)) < 39.0;
                if (on_card && check(x, y, *p)) ++checked;
            }
        return checked;
    }
    /// Reads the length after `words`, metres, as in "…, from 1.5 m to 3 m, …". Returns -1 if there is none.
    static double length_after(const std::string& text, const std::string& words) {
        double value = -1.0;
        char unit[8] = {};
        const std::size_t at = text.find(words);
        if (at == std::string::npos || std::sscanf(text.c_str() + at + words.size(), " %lf %7[a-z]", &value, unit) != 2)
            return -1.0;
        return std::string(unit) == "mm" ? value * 1e-3 : std::string(unit) == "km" ? value * 1e3 : value;
    }
    /// Returns the colour of a length on the scale that the labels show: between two by its logarithm, in linear light.
    glm::dvec3 on_scale(double length_m) {
        std::vector<std::pair<double, glm::dvec3>> stops;
        for (const debug::Label& label : labels())
            if (label.swatch) stops.emplace_back(length_after(label.text, ""), linear(*label.swatch));
        if (stops.empty()) return {};
        for (std::size_t i = 1; i < stops.size(); ++i) {
            if (length_m > stops[i].first) continue;
            const double least_m = stops[i - 1].first;
            const double share = std::log(std::max(length_m, least_m) / least_m) / std::log(stops[i].first / least_m);
            return glm::mix(stops[i - 1].second, stops[i].second, share);
        }
        return stops.back().second;
    }
    static Light light_of(LightKind kind) {
        return kind == LightKind::directional ? kSun : kind == LightKind::spot ? kSpot : kPoint;
    }
};

TEST_F(DebugLookups, EachPixelHasTheColourOfTheCascadeThatItsDistanceAlongTheViewChooses) {
    add_posts();
    add_light(kSun, {}, {-0.5, -1.0, -0.3}, {.resolution_px = 512},
              {.cascades = {.fit = ShadowFit::stable, .blend = 0.0f}});
    look_along();
    show_plain();
    show("cascades", light_name());
    ASSERT_GE(labels().size(), 4u) << "three cascades at least have a map";
    const auto cascade_of = [&](double distance_m) -> const debug::Label* {
        for (std::size_t i = 1; i < labels().size(); ++i) {
            const double from_m = length_after(labels()[i].text, "from"), to_m = length_after(labels()[i].text, "to");
            // Three digits are named.
            if (distance_m > 1.01 * from_m && distance_m < 0.99 * to_m) return &labels()[i];
        }
        return nullptr;
    };
    std::vector<std::size_t> seen(labels().size() - 1);
    std::size_t wrong = 0;
    const std::size_t checked = for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3& p) {
        const double distance_m = glm::dot(p - camera().position_ws_m, -camera().rotation_ws[2]);
        const debug::Label* label = cascade_of(distance_m);
        if (!label) return false;
        ++seen[static_cast<std::size_t>(label - &labels()[1])];
        wrong += near(shown_at(x, y), over(plain_at(x, y), *label, kTint)) ? 0 : 1;
        return true;
    });
    EXPECT_GT(checked, 10 * kMany);
    EXPECT_EQ(wrong, 0u);
    for (const std::size_t pixels : seen) EXPECT_GT(pixels, 300u);
}

TEST_F(DebugLookups, WhereOneCascadeFadesIntoTheNextTheColoursDoToo) {
    add_posts();
    add_light(kSun, {}, {-0.5, -1.0, -0.3}, {.resolution_px = 512},
              {.cascades = {.fit = ShadowFit::stable, .blend = 0.5f}});
    look_along();
    show_plain();
    show("cascades", light_name());
    std::size_t pure = 0, mixed = 0;
    for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
        const bool any = std::any_of(labels().begin() + 1, labels().end(), [&](const debug::Label& label) {
            return near(shown_at(x, y), over(plain_at(x, y), label, kTint));
        });
        ++(any ? pure : mixed);
        return true;
    });
    EXPECT_GT(pure, kMany);
    EXPECT_GT(mixed, kMany);
}

TEST_F(DebugLookups, OneMapAloneTintsWhatItServesAndLeavesTheRest) {
    add_posts();
    add_light(kSun, {}, {-0.5, -1.0, -0.3}, {.resolution_px = 512},
              {.cascades = {.fit = ShadowFit::stable, .blend = 0.0f}});
    look_along();
    show_plain();
    show("cascades", light_name(), 1);
    ASSERT_EQ(labels().size(), 2u);
    std::size_t tinted = 0, left = 0, other = 0;
    for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
        const bool in = near(shown_at(x, y), over(plain_at(x, y), labels()[1], kTint));
        const bool out = shown_at(x, y) == plain_at(x, y);
        ++(in ? tinted : out ? left : other);
        return true;
    });
    EXPECT_GT(tinted, 300u);
    EXPECT_GT(left, kMany);
    EXPECT_EQ(other, 0u);
}

TEST_F(DebugLookups, ACubesFacesMeetWhereTwoCoordinatesOfTheDirectionAreEqual) {
    add_post();
    add_light(kPoint, {0.4, 3.0, -5.0}, {0.0, -1.0, 0.0});
    look_along();
    show_plain();
    show("cascades", light_name());
    const glm::dvec3 light = frame().snapshot().lights.front().position_ws_m;
    const glm::dquat from_world = glm::conjugate(shadow::cube_turn());
    std::size_t wrong = 0;
    const std::size_t checked = for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3& p) {
        const glm::dvec3 d = from_world * (p - light), size = glm::abs(d);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        const double second = std::max(size[(axis + 1) % 3], size[(axis + 2) % 3]);
        if (second > 0.97 * size[axis]) return false;  // too close to a seam to say
        const std::string face = std::string("face ") + (d[axis] < 0.0 ? "-" : "+") + "XYZ"[axis];
        const auto label = std::find_if(labels().begin() + 1, labels().end(),
                                        [&](const debug::Label& l) { return l.text.starts_with(face); });
        const Srgb wanted = label == labels().end() ? plain_at(x, y) : over(plain_at(x, y), *label, kTint);
        wrong += near(shown_at(x, y), wanted) ? 0 : 1;
        return true;
    });
    EXPECT_GT(checked, 10 * kMany);
    EXPECT_EQ(wrong, 0u);
}

TEST_F(DebugLookups, TheGridIsAsWideAsTheTexelsThatTheLabelNames) {
    add_box({-0.3, 2.0, -4.3}, {0.3, 2.2, -3.7});
    add_light(kSun, {}, {0.0, -1.0, 0.0}, {.filter = ShadowFilter::hard, .resolution_px = 64, .cascades = 1},
              {.cascades = {.fit = ShadowFit::stable}});
    look_down(6.0, {0.0, 0.0, -4.0});
    show_plain();
    show("texels", light_name());
    ASSERT_EQ(labels().size(), 2u);
    const double diagonal_m = length_after(labels()[1].text, "up to");
    // A stable map is square, and the light stands straight above.
    const double texel_m = diagonal_m / std::sqrt(2.0);
    const double pixel_m = 12.0 / size_px().y;
    ASSERT_GT(texel_m, 4.0 * pixel_m) << "too fine to be drawn";
    // Brightness changes at every side of a texel. Rows cross the grid at its own angle, so that only their mean number
    // of changes per texel is bounded.
    std::size_t changes = 0, pixels = 0;
    for (std::uint32_t y = 20; y < size_px().y - 20; ++y)
        for (std::uint32_t x = 21; x < size_px().x - 20; ++x) {
            const int step = shown_at(x, y)[1] - shown_at(x - 1, y)[1];
            changes += std::abs(step) > 20 ? 1 : 0;
            ++pixels;
        }
    // A line that crosses a grid at the angle a meets |cos a| + |sin a| sides per texel. The stable map may be turned
    // by any angle: between 1 and sqrt 2.
    const double per_texel = static_cast<double>(changes) / static_cast<double>(pixels) * texel_m / pixel_m;
    EXPECT_GT(per_texel, 0.95);
    EXPECT_LT(per_texel, 1.05 * std::sqrt(2.0));
}

TEST_F(DebugLookups, TexelsTooFineForThePictureAreTheirMean) {
    constexpr double kStrength = 0.5, kMean = 0.5 * (1.0 + 0.25);  // shaders/debug/texels.frag
    add_post();
    add_light(kSun, {}, {-0.5, -1.0, -0.3}, {.resolution_px = 4096, .cascades = 1});
    look_along();
    show_plain();
    show("texels", light_name());
    std::size_t wrong = 0;
    const std::size_t checked = for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3& p) {
        if (glm::distance(p, camera().position_ws_m) < 15.0) return false;
        wrong += near(shown_at(x, y), over(plain_at(x, y), kMean * linear(*labels()[1].swatch), kStrength)) ? 0 : 1;
        return true;
    });
    EXPECT_GT(checked, kMany);
    EXPECT_EQ(wrong, 0u);
}

/// A bias that is known: ten millimetres along the light.
class DebugBias : public DebugLookups, public ::testing::WithParamInterface<LightKind> {};

TEST_P(DebugBias, AConstantOneHasItsColourOnTheScale) {
    constexpr double kBias_m = 0.01;
    add_post();
    add_light(light_of(GetParam()), {0.4, 6.0, -5.0}, {0.0, -1.0, 0.0},
              {.filter = ShadowFilter::hard, .resolution_px = 512},
              {.bias = {.mode = BiasMode::constant, .offset_m = static_cast<float>(kBias_m)},
               .cascades = {.blend = 0.0f}});  // into a cascade that nothing can darken it fades to the plain picture
    look_along();
    show_plain();
    show("bias", light_name());
    const glm::dvec3 light = frame().snapshot().lights.front().position_ws_m;
    std::size_t wrong = 0;
    const std::size_t checked = for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3& p) {
        if (shown_at(x, y) == plain_at(x, y)) return false;  // no map
        // A lamp's is counted along its map's axis: the way from the light is longer.
        const glm::dvec3 d =
            GetParam() == LightKind::point ? glm::conjugate(shadow::cube_turn()) * (p - light) : p - light;
        const double along =
            GetParam() == LightKind::point ? std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) : -d.y;
        const double offset_m = kBias_m * (GetParam() == LightKind::directional ? 1.0 : glm::length(d) / along);
        wrong += near(shown_at(x, y), over(plain_at(x, y), on_scale(offset_m), kOpaque), 3) ? 0 : 1;
        return true;
    });
    EXPECT_GT(checked, kMany);
    EXPECT_EQ(wrong, 0u);
}

TEST_P(DebugBias, ALargerOneIsFartherOnTheScaleAndTheAutomaticOneLiesOnIt) {
    add_post();
    const ecs::Entity entity =
        add_light(light_of(GetParam()), {0.4, 6.0, -5.0}, {0.1, -1.0, 0.0}, {.resolution_px = 512});
    look_along();
    show_plain();
    const auto covered = [&] {
        std::size_t pixels = 0;
        for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
            pixels += shown_at(x, y) == plain_at(x, y) ? 0 : 1;
            return true;
        });
        return pixels;
    };
    show("bias", light_name());
    const std::size_t automatic = covered();
    EXPECT_GT(automatic, kMany);
    const auto last_everywhere = [&](float bias_m) {
        edit_light(world, entity, [&](ShadowTuning& t) {
            t.bias.mode = BiasMode::constant;
            t.bias.offset_m = bias_m;
        });
        show_plain();
        show("bias", light_name());
        std::size_t last = 0;
        for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
            last += near(shown_at(x, y), over(plain_at(x, y), labels().back(), kOpaque)) ? 1 : 0;
            return true;
        });
        return last;
    };
    EXPECT_GT(last_everywhere(0.2f), kMany);
    EXPECT_EQ(last_everywhere(0.002f), 0u);
}

std::string kind_name(const ::testing::TestParamInfo<LightKind>& kind) {
    return kind.param == LightKind::directional ? "Sun" : kind.param == LightKind::spot ? "Spot" : "Point";
}

INSTANTIATE_TEST_SUITE_P(EachKind, DebugBias,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point), kind_name);

TEST_F(DebugLookups, AFilterThatSpreadsByMetresShowsThatWidthAndWhatItsTexelsAdd) {
    constexpr double kSpread_m = 0.15;
    add_post();
    add_light(kSun, {}, {0.0, -1.0, 0.0}, {.filter = ShadowFilter::poisson, .resolution_px = 2048, .cascades = 1},
              {.kernel = {.spread_m = static_cast<float>(kSpread_m)}, .cascades = {.fit = ShadowFit::stable}});
    look_along();
    show_plain();
    show("cascades", light_name());
    const double texel_m = length_after(labels().at(1).text, "up to") / std::sqrt(2.0);
    show_plain();
    show("penumbra", light_name());
    const double reach_texel = static_cast<double>(shadow::filter_row(ShadowFilter::poisson).reach_texel);
    const glm::dvec3 wanted = on_scale(2.0 * (kSpread_m + reach_texel * texel_m));
    std::size_t wrong = 0;
    const std::size_t shown = for_ground([&](std::uint32_t x, std::uint32_t y, const glm::dvec3&) {
        if (shown_at(x, y) == plain_at(x, y)) return false;  // no map
        wrong += near(shown_at(x, y), over(plain_at(x, y), wanted, kOpaque), 3) ? 0 : 1;
        return true;
    });
    EXPECT_GT(shown, kMany);
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace gnomon
