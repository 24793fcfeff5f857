#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "systems/extract/light_facts.h"
#include "systems/lighting/ambient.h"
#include "tests/gl/traced_frame_fixture.h"

namespace gnomon {

inline constexpr glm::uvec2 kCatcher_px{192, 160};
/// Share of pixels of catchers: those at edges of hard shadows may be a texel off, nothing else.
inline constexpr double kMostWrongShares = 0.02;
inline constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722};  // Rec. 709
inline const LightShadow kHardMap{.filter = ShadowFilter::hard, .resolution_px = 1024};

inline double as_light(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
inline double encoded_of(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

/// Lays a premultiplied picture over an opaque one as docs/how-to/compositing.md has it: in light.
inline std::vector<std::uint8_t> composed(const std::vector<std::uint8_t>& over,
                                          const std::vector<std::uint8_t>& photograph) {
    std::vector<std::uint8_t> out(photograph.size(), 255);
    for (std::size_t i = 0; i < out.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c) {
            const double behind = as_light(photograph[c] / 255.0) * (1.0 - over[i + 3] / 255.0);
            out[c] = static_cast<std::uint8_t>(
                std::lround(255.0 * encoded_of(std::min(as_light(over[c] / 255.0) + behind, 1.0))));
        }
    return out;
}

/// Returns noise over gradients: any level of any channel.
inline std::vector<std::uint8_t> like_a_photograph(glm::uvec2 size_px) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-40.0, 40.0);
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t y = 0; y < size_px.y; ++y)
        for (std::uint32_t x = 0; x < size_px.x; ++x) {
            const double along[] = {double(x) / size_px.x, double(y) / size_px.y, 1.0 - double(x) / size_px.x};
            for (const double share : along)
                rgba.push_back(static_cast<std::uint8_t>(std::clamp(255.0 * share + noise(random), 0.0, 255.0)));
            rgba.push_back(255);
        }
    return rgba;
}

/// World with shadow catchers, drawn without a background. Rays give the alpha that it must have.
class ShadowCatcher : public TracedFrameTest {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        settings.viewport_px = kCatcher_px;
        settings.transparent = true;
        settings.rays = false;
    }
    ecs::Entity catcher(std::uint32_t mesh, const Transform& at = {}, bool casts = false) {
        const ecs::Entity entity = place(mesh, at, casts);
        world.patch<MeshRef>(entity, [](MeshRef& m) { m.shadow_catcher = true; });
        return entity;
    }
    std::uint32_t ground_mesh(std::optional<std::uint32_t> material = {}) {
        return add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0}), material);
    }
    std::uint32_t box_mesh() { return add_analysed(game::make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})); }
    void look(const glm::dvec3& from_m = {0.0, 6.0, 5.0}) { add_camera({.fov_y_rad = 1.0}, from_m, -from_m); }
    /// Makes a catching ground, a box above it, and a camera.
    void make_stage() {
        ground = catcher(ground_mesh());
        box = place(box_mesh(), {.translation_m = {0.3, 1.0, 0.2}});
        look();
    }
    /// Adds a lamp and a sun of other colours, with shadows that overlap in part.
    void add_coloured_lights() {
        add_light({.kind = LightKind::point, .colour = {1.0f, 0.2f, 0.1f}, .intensity = 900.0f}, {-2.0, 4.0, 1.0},
                  {0.0, -1.0, 0.0}, kHardMap);
        add_light({.kind = LightKind::directional, .colour = {0.1f, 0.3f, 1.0f}, .intensity = 40.0f}, {},
                  {-1.0, -2.0, -0.5}, kHardMap);
    }

    /// Returns the light on a surface without casters, lux per channel. 0: it faces away, or is out of the cone.
    static glm::dvec3 irradiance(const LightItem& light, const glm::dvec3& at_ws_m, const glm::dvec3& normal) {
        const bool parallel = light_facts(light.kind).parallel;
        const glm::dvec3 way = parallel ? light.rotation_ws[2] : light.position_ws_m - at_ws_m;
        const double distance_m = parallel ? 1.0 : glm::length(way);
        const double cosine = glm::dot(normal, way) / glm::length(way);
        double strength = static_cast<double>(light.intensity) / (distance_m * distance_m);
        if (light.kind == LightKind::spot) {
            const double inner = std::cos(light.inner_cone_rad), outer = std::cos(light.outer_cone_rad);
            const double share =
                glm::clamp((glm::dot(way, light.rotation_ws[2]) / distance_m - outer) / (inner - outer), 0.0, 1.0);
            strength *= share * share;
        }
        return glm::dvec3(light.colour) * (strength * std::max(cosine, 0.0));
    }

    struct Expected {
        std::vector<double> alpha;         // bottom row first; 0: no surface
        std::vector<std::uint8_t> scored;  // the answer is certain
        std::vector<std::uint8_t> catches, opaque;
    };
    /// Computes the picture's alpha by rays. Catchers are surfaces to them, and casters take light from these.
    /// `weights`: of the channels.
    Expected expected(const glm::dvec3& weights = kLuminance) {
        SceneSnapshot scene = frame().snapshot();
        std::vector<std::uint8_t> is_catcher;
        for (InstanceItem& item : scene.instances) is_catcher.push_back(std::exchange(item.shadow_catcher, false));
        const ConsumerItem& camera = scene.consumers.front();
        const oracle::ReferenceTracer tracer(scene, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        std::vector<oracle::LightTruth> truths;
        for (const LightItem& light : scene.lights) truths.push_back(tracer.trace_light(hits, light, true));
        lighting::MidstFinder finder;
        const lighting::AmbientRecord ambient =
            lighting::ambient_for(lighting::scene_light(frame().snapshot(), finder.find(frame().snapshot())));
        Expected e;
        for (std::size_t i = 0; i < hits.count(); ++i) {
            const oracle::PlacedTriangle seen =
                hits.triangle[i] == oracle::kNoTriangle ? oracle::PlacedTriangle{} : tracer.source_of(hits.triangle[i]);
            const bool catches = seen.exists() && is_catcher[seen.instance] != 0;
            e.catches.push_back(catches);
            e.opaque.push_back(seen.exists() && !catches);
            e.scored.push_back(1);
            e.alpha.push_back(seen.exists() && !catches ? 1.0 : 0.0);
            if (!catches) continue;
            const glm::dvec3& normal = hits.normal_ws[i];
            const glm::dvec3 at_ws_m = hits.position_rel_m[i] + camera.position_ws_m;
            double falls = glm::dot(weights, glm::mix(glm::dvec3(ambient.ground_lux), glm::dvec3(ambient.sky_lux),
                                                         0.5 + 0.5 * normal.y));
            double taken = 0.0;
            for (std::size_t l = 0; l < truths.size(); ++l) {
                const double of_light = glm::dot(weights, irradiance(scene.lights[l], at_ws_m, normal));
                falls += of_light;
                taken += of_light * (1.0 - static_cast<double>(truths[l].visibility[i]));
                if (truths[l].ambiguous[i]) e.scored.back() = 0;
            }
            if (falls > 0.0) e.alpha.back() = taken / falls;
        }
        return e;
    }

    /// Returns the picture's alpha, bottom row first as the tracer has it.
    std::vector<int> alphas() {
        const std::vector<std::uint8_t> rgba = picture();
        std::vector<int> out;
        for (std::uint32_t y = 0; y < settings.viewport_px.y; ++y)
            for (std::uint32_t x = 0; x < settings.viewport_px.x; ++x)
                out.push_back(rgba[((settings.viewport_px.y - 1 - y) * settings.viewport_px.x + x) * 4 + 3]);
        return out;
    }
    struct Compared {
        std::size_t catches = 0, dark = 0, wrong = 0, wrong_elsewhere = 0, coloured = 0;
        std::string text() const {
            return std::to_string(catches) + " pixels of catchers, " + std::to_string(dark) + " darkened, " +
                   std::to_string(wrong) + " wrong, elsewhere " + std::to_string(wrong_elsewhere);
        }
    };
    /// Compares with rays, to 1/255 beyond rounding.
    Compared compared() { return compared(expected()); }
    Compared compared(const Expected& truth) {
        const std::vector<int> drawn = alphas();
        const std::vector<std::uint8_t> rgba = picture();
        Compared c;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const bool is_wrong = std::abs(drawn[i] - 255.0 * truth.alpha[i]) > 1.5;
            if (!truth.catches[i]) {
                c.wrong_elsewhere += is_wrong;
                continue;
            }
            const std::size_t x = i % settings.viewport_px.x,
                              y = settings.viewport_px.y - 1 - i / settings.viewport_px.x;
            for (std::size_t k = 0; k < 3; ++k) c.coloured += rgba[(y * settings.viewport_px.x + x) * 4 + k] != 0;
            if (!truth.scored[i]) continue;
            ++c.catches;
            c.dark += truth.alpha[i] > 0.02;
            c.wrong += is_wrong;
        }
        return c;
    }
    void expect_rays(std::size_t least_dark, const char* what = "") {
        const Compared c = compared();
        EXPECT_GT(c.catches, 3000u) << what << ": " << c.text();
        EXPECT_GT(c.dark, least_dark) << what << ": " << c.text();
        EXPECT_LT(static_cast<double>(c.wrong), kMostWrongShares * static_cast<double>(c.catches))
            << what << ": " << c.text();
        EXPECT_LT(c.wrong_elsewhere, 60u) << what << ": " << c.text() << ": the rim of surfaces";
    }
    /// Draws the same without what stands on the ground.
    void take_caster_away() {
        world.destroy(box);
        draw();
    }

    ecs::Entity ground, box;
};

}  // namespace gnomon
