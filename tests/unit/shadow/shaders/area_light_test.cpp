#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "bench/glsl_on_cpu/glsl_types.h"
#include "systems/extract/source_place.h"
#include "systems/lighting/area_table.h"
#include "tests/long_run.h"

/// Shading by area lights without shadows, against samples of the source and of the surface's lobe.
namespace gnomon::bench::glsl {
namespace {

#define LIGHT_RECTANGLE 1
#define LIGHT_DISC 0
#define LIGHT_SPHERE 0
#define LIGHT_TUBE 0
namespace rectangle {
#include "tests/unit/shadow/shaders/area_light_shader.inc"
}  // namespace rectangle
#undef LIGHT_RECTANGLE
#define LIGHT_RECTANGLE 0
#undef LIGHT_DISC
#define LIGHT_DISC 1
namespace disc {
#include "tests/unit/shadow/shaders/area_light_shader.inc"
}  // namespace disc
#undef LIGHT_DISC
#define LIGHT_DISC 0
#undef LIGHT_SPHERE
#define LIGHT_SPHERE 1
namespace sphere {
#include "tests/unit/shadow/shaders/area_light_shader.inc"
}  // namespace sphere
#undef LIGHT_SPHERE
#define LIGHT_SPHERE 0
#undef LIGHT_TUBE
#define LIGHT_TUBE 1
namespace tube {
#include "tests/unit/shadow/shaders/area_light_shader.inc"
}  // namespace tube

constexpr double kPi = glm::pi<double>();

vec3 to_shader(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// A surface with its normal along z, and the source that shines on it from `to_middle_m`.
struct Case {
    LightItem light;
    glm::dvec3 to_middle_m{0.0}, to_viewer{0.0, 0.0, 1.0};
    double roughness = 0.5, metallic = 0.0;
    glm::dvec3 colour{0.8, 0.5, 0.3};
};

std::shared_ptr<const std::vector<vec4>> table() {
    static const auto kTable = [] {
        auto texels = std::make_shared<std::vector<vec4>>();
        for (const lighting::AreaLobes& lobes : lighting::area_lobes()) {
            for (const lighting::AreaLobe& l : {lobes.reflected, lobes.grazing})
                texels->push_back({l.lean, l.along, l.across, l.skew});
            texels->push_back({lobes.reflected.size, lobes.grazing.size, 0.0, 0.0});
        }
        return std::shared_ptr<const std::vector<vec4>>(texels);
    }();
    return kTable;
}

template <class Shader>
Shader shader_of(const Case& c) {
    Shader shader;
    shader.area_lobes.elements = table();
    const bool wide = c.light.kind == LightKind::rectangle || c.light.kind == LightKind::tube;
    const double radius_m = c.light.source_radius_m;
    auto& source = shader.light.views[Shader::kSourceView];
    source.axis_u = vec4(to_shader(c.light.rotation_ws[0]), wide ? 0.5 * c.light.width_m : radius_m);
    source.axis_v = vec4(to_shader(c.light.rotation_ws[1]),
                         c.light.kind == LightKind::rectangle ? 0.5 * c.light.height_m : radius_m);
    shader.light.to_light = vec4(to_shader(c.light.rotation_ws[2]), 0.0);
    return shader;
}

/// Returns what the shader gives.
template <class Shader>
glm::dvec3 shaded(const Case& c) {
    Shader shader = shader_of<Shader>(c);
    const auto source = shader.source_seen(to_shader(c.to_middle_m));
    if (!shader.is_shone_on(source)) return glm::dvec3(0.0);
    const vec3 found = shader.area_reflected(source, to_shader(c.colour), c.metallic, c.roughness, vec3(0.0, 0.0, 1.0),
                                             to_shader(c.to_viewer));
    return {found.x, found.y, found.z};
}

glm::dvec3 shaded(const Case& c) {
    switch (c.light.kind) {
        case LightKind::rectangle:
            return shaded<rectangle::Shader>(c);
        case LightKind::disc:
            return shaded<disc::Shader>(c);
        case LightKind::sphere:
            return shaded<sphere::Shader>(c);
        default:
            return shaded<tube::Shader>(c);
    }
}

/// Returns whether a way meets the source.
bool meets(const Case& c, const glm::dvec3& way) {
    const glm::dmat3& axes = c.light.rotation_ws;
    const glm::dvec3 d = way * axes, m = c.to_middle_m * axes;
    const double radius_m = c.light.source_radius_m;
    if (c.light.kind == LightKind::sphere) return glm::dot(d, m) > 0.0 && glm::length(glm::cross(d, m)) < radius_m;
    if (c.light.kind == LightKind::tube) {
        const double a = d.y * d.y + d.z * d.z, b = d.y * m.y + d.z * m.z, e = m.y * m.y + m.z * m.z - radius_m * radius_m;
        const double under = b * b - a * e;
        if (!(under > 0.0) || !(e > 0.0) || !(b > 0.0)) return false;
        return std::abs((b - std::sqrt(under)) / a * d.x - m.x) < 0.5 * c.light.width_m;
    }
    if (!(m.z > 0.0 && d.z > 0.0)) return false;
    const glm::dvec2 at = glm::dvec2(d) * (m.z / d.z) - glm::dvec2(m);
    if (c.light.kind == LightKind::disc) return glm::length(at) < radius_m;
    return std::abs(at.x) < 0.5 * c.light.width_m && std::abs(at.y) < 0.5 * c.light.height_m;
}

/// Returns the area that the weights of source_place() share; of a sphere, the angle around it.
double measure(const Case& c) {
    const double radius_m = c.light.source_radius_m, width_m = c.light.width_m;
    if (c.light.kind == LightKind::rectangle) return width_m * c.light.height_m;
    if (c.light.kind == LightKind::disc) return kPi * radius_m * radius_m;
    if (c.light.kind == LightKind::sphere) {
        const double sine = radius_m / glm::length(c.to_middle_m);
        return 2.0 * kPi * (1.0 - std::sqrt(std::max(1.0 - sine * sine, 0.0)));
    }
    const glm::dvec3& axis = c.light.rotation_ws[0];
    const double aside_m = glm::length(c.to_middle_m - axis * glm::dot(axis, c.to_middle_m));
    return width_m * 2.0 * radius_m * std::acos(std::min(radius_m / aside_m, 1.0));
}

constexpr int kSide = 96;  // places along a side: 9216

glm::dvec2 on_disk(const glm::dvec2& square) {
    const double radius = std::sqrt(square.x), angle_rad = 2.0 * kPi * square.y;
    return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)};
}

template <class Add>
void for_each_place(Add add) {
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) add(glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(kSide));
}

/// Returns the scattered part, by places of the source.
glm::dvec3 scattered(const Case& c) {
    const bool round = c.light.kind == LightKind::disc || c.light.kind == LightKind::sphere;
    glm::dvec3 sum(0.0);
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), c.colour, c.metallic);
    for_each_place([&](const glm::dvec2& square) {
        const SourcePlace place = source_place(c.light, c.to_middle_m, round ? on_disk(square) : 2.0 * square - 1.0);
        if (!(place.weight > 0.0)) return;
        const glm::dvec3 l = glm::normalize(place.way_m);
        if (!(l.z > 0.0)) return;
        const double grazing = std::pow(1.0 - glm::dot(c.to_viewer, glm::normalize(l + c.to_viewer)), 5.0);
        const glm::dvec3 fresnel = f0 + (1.0 - f0) * grazing;
        sum += (1.0 - fresnel) * (1.0 - c.metallic) * c.colour / kPi * (l.z * place.weight);
    });
    return sum * (measure(c) / (kSide * kSide));
}

/// Returns the mirrored part, by visible normals (Heitz 2018).
glm::dvec3 mirrored(const Case& c) {
    const double alpha = std::max(c.roughness * c.roughness, 1e-3), a2 = alpha * alpha;
    const glm::dvec3 v = c.to_viewer, f0 = glm::mix(glm::dvec3(0.04), c.colour, c.metallic);
    const auto smith = [&](double cosine) { return std::sqrt(cosine * cosine * (1.0 - a2) + a2); };
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double across = std::hypot(stretched.x, stretched.y);
    const glm::dvec3 first = across > 0.0 ? glm::dvec3(-stretched.y, stretched.x, 0.0) / across : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 second = glm::cross(stretched, first);
    glm::dvec3 sum(0.0);
    for_each_place([&](const glm::dvec2& square) {
        const glm::dvec2 disk = on_disk(square);
        const double share = 0.5 * (1.0 + stretched.z);
        const double y = (1.0 - share) * std::sqrt(1.0 - disk.x * disk.x) + share * disk.y;
        const glm::dvec3 found =
            first * disk.x + second * y + stretched * std::sqrt(std::max(1.0 - disk.x * disk.x - y * y, 0.0));
        const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * found.x, alpha * found.y, std::max(found.z, 0.0)));
        const glm::dvec3 l = 2.0 * glm::dot(v, half) * half - v;
        if (!(l.z > 0.0) || !meets(c, l)) return;
        const double weight = l.z * (v.z + smith(v.z)) / (l.z * smith(v.z) + v.z * smith(l.z));
        sum += (f0 + (1.0 - f0) * std::pow(1.0 - glm::dot(v, half), 5.0)) * weight;
    });
    return sum / static_cast<double>(kSide * kSide);
}

glm::dvec3 truth(const Case& c) { return scattered(c) + mirrored(c); }

LightItem lamp(LightKind kind, const glm::dvec3& toward) {
    LightItem light;
    light.kind = kind;
    light.width_m = kind == LightKind::tube ? 1.2f : 0.8f;
    light.height_m = 0.5f;
    light.source_radius_m = kind == LightKind::tube ? 0.05f : 0.3f;
    // It shines at the surface from half aside.
    const glm::dvec3 back = glm::normalize(glm::normalize(toward) + glm::dvec3(0.3, -0.2, 0.1));
    light.rotation_ws[2] = back;
    light.rotation_ws[0] = glm::normalize(glm::cross(glm::dvec3(0.2, 1.0, 0.1), back));
    light.rotation_ws[1] = glm::cross(back, light.rotation_ws[0]);
    return light;
}

constexpr std::array kKinds{LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube};

std::vector<Case> all_cases(LightKind kind, double metallic) {
    std::vector<Case> cases;
    for (const double roughness : {0.1, 0.2, 0.35, 0.5, 0.7, 1.0})
        for (const double view_deg : {0.0, 30.0, 60.0, 80.0})
            for (const double light_deg : {-80.0, -50.0, 0.0, 25.0, 50.0, 70.0, 88.0})
                for (const double distance_m : {0.6, 1.5, 5.0})
                    for (const double turn_deg : {0.0, 40.0}) {
                        const double view = glm::radians(view_deg), aside = glm::radians(light_deg), turn = glm::radians(turn_deg);
                        Case c;
                        c.to_viewer = {-std::sin(view), 0.0, std::cos(view)};
                        c.to_middle_m = distance_m * glm::dvec3(std::sin(aside) * std::cos(turn),
                                                                std::sin(aside) * std::sin(turn), std::cos(aside));
                        c.light = lamp(kind, c.to_middle_m);
                        c.roughness = roughness;
                        c.metallic = metallic;
                        cases.push_back(c);
                    }
    return cases;
}

/// Mean errors, by the mean of the truth.
struct MeanErrors {
    double all = 0.0, from_above = 0.0;
};
MeanErrors mean_errors(const std::vector<Case>& cases) {
    MeanErrors off, wanted;
    for (const Case& c : cases) {
        const double right = truth(c).x, error = std::abs(shaded(c).x - right);
        off.all += error;
        wanted.all += right;
        if (c.to_viewer.z < 0.8) continue;
        off.from_above += error;
        wanted.from_above += right;
    }
    return {off.all / wanted.all, off.from_above / wanted.from_above};
}

class AreaLight : public ::testing::TestWithParam<LightKind> {};

// A lobe of one transformed cosine is not that of brdf.glsl: most of what remains are metals at grazing angles.
TEST_P(AreaLight, ShadesAsSamplesOfItsSourceDo) {
    if (kSanitized) GTEST_SKIP() << "millions of samples take minutes; the tests below run the same text";
    const bool thin = GetParam() == LightKind::tube;
    EXPECT_LE(mean_errors(all_cases(GetParam(), 0.0)).all, thin ? 0.013 : 0.01) << "no metal";
    const MeanErrors metal = mean_errors(all_cases(GetParam(), 1.0));
    EXPECT_LE(metal.all, 0.04) << "metal";
    EXPECT_LE(metal.from_above, 0.02) << "metal seen from above";
}

TEST_P(AreaLight, GivesNothingFromBehindTheSurface) {
    Case c;
    c.to_middle_m = {0.1, 0.2, -2.0};
    c.light = lamp(GetParam(), c.to_middle_m);
    EXPECT_EQ(shaded(c), glm::dvec3(0.0));
    c.to_middle_m.z = 2.0;
    c.light = lamp(GetParam(), c.to_middle_m);
    EXPECT_GT(shaded(c).x, 0.0) << "the control";
}

TEST_P(AreaLight, IsFiniteAndNotNegativeAtAnyDistanceAndRoughness) {
    for (const double distance_m : {0.31, 0.5, 1.0, 100.0, 1.0e6})
        for (const double roughness : {0.0, 0.03, 1.0})
            for (const double z : {-0.2, 0.0, 1e-9, 1.0})
                for (const double view : {1e-9, 1.0}) {
                    Case c;
                    c.roughness = roughness;
                    c.to_viewer = glm::normalize(glm::dvec3(-1.0, 0.0, view));
                    c.to_middle_m = distance_m * glm::normalize(glm::dvec3(1.0, 0.1, z));
                    c.light = lamp(GetParam(), c.to_middle_m);
                    const glm::dvec3 found = shaded(c);
                    EXPECT_TRUE(found.x >= 0.0 && std::isfinite(found.x)) << distance_m << " " << roughness << " " << z;
                }
}

TEST_P(AreaLight, FadesWithTheSquareOfTheDistance) {
    const auto at = [](double distance_m) {
        Case c;
        c.roughness = 1.0;
        c.to_middle_m = distance_m * glm::dvec3(0.0, 0.6, 0.8);
        c.light = lamp(GetParam(), c.to_middle_m);
        return shaded(c).x * distance_m * distance_m;
    };
    EXPECT_NEAR(at(1.0e4) / at(100.0), 1.0, 1e-3) << "both are small outlines";
    EXPECT_NEAR(at(30.0) / at(100.0), 1.0, 5e-3) << "one is";
}

INSTANTIATE_TEST_SUITE_P(Kinds, AreaLight, ::testing::ValuesIn(kKinds), [](const auto& info) {
    return std::string(std::array{"rectangle", "disc", "sphere", "tube"}[static_cast<std::size_t>(info.param) - 3]);
});

}  // namespace
}  // namespace gnomon::bench::glsl
