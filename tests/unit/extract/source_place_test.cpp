#include "systems/extract/source_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "systems/extract/usable.h"

namespace gnomon {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kPlacesAcross = 200;

/// Returns an area light that shines along -Z.
LightItem light_of(LightKind kind) {
    LightItem light;
    light.kind = kind;
    light.rotation_ws = glm::dmat3(glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
    light.intensity = 1.0f;
    light.source_radius_m = 0.5f;
    light.width_m = 1.2f;
    light.height_m = 0.8f;
    return light;
}

/// Integrates weight times cosine over the source's places, each counted by `measure`.
double received(const LightItem& light, const glm::dvec3& to_middle_m, const glm::dvec3& normal, double measure) {
    const bool round = light.kind == LightKind::disc || light.kind == LightKind::sphere;
    double sum = 0.0;
    for (int y = 0; y < kPlacesAcross; ++y)
        for (int x = 0; x < kPlacesAcross; ++x) {
            const glm::dvec2 square((x + 0.5) / kPlacesAcross, (y + 0.5) / kPlacesAcross);
            const glm::dvec2 disk = std::sqrt(square.x) * glm::dvec2(std::cos(2.0 * kPi * square.y), std::sin(2.0 * kPi * square.y));
            const SourcePlace place = source_place(light, to_middle_m, round ? disk : 2.0 * square - 1.0);
            if (place.weight > 0.0)
                sum += place.weight * std::max(glm::dot(glm::normalize(place.way_m), normal), 0.0);
        }
    return sum * measure / (kPlacesAcross * kPlacesAcross);
}

const glm::dvec3 kUp(0.0, 0.0, 1.0);

TEST(SourcePlace, OfADiscGivesWhatOneStraightAboveDoes) {
    const LightItem light = light_of(LightKind::disc);
    for (const double height_m : {0.3, 1.0, 10.0}) {
        const double radius_m = 0.5, wanted = kPi * radius_m * radius_m / (radius_m * radius_m + height_m * height_m);
        EXPECT_NEAR(received(light, kUp * height_m, kUp, kPi * radius_m * radius_m), wanted, 1e-3 * wanted);
    }
}

TEST(SourcePlace, OfASphereGivesWhatOneOfThatDistanceDoes) {
    const LightItem light = light_of(LightKind::sphere);
    for (const double distance_m : {0.6, 1.0, 10.0}) {
        const double sine = 0.5 / distance_m, angle = 2.0 * kPi * (1.0 - std::sqrt(1.0 - sine * sine));
        EXPECT_NEAR(received(light, kUp * distance_m, kUp, angle), kPi * sine * sine, 1e-3 * kPi * sine * sine);
    }
}

// Siegel and Howell, "Thermal Radiation Heat Transfer": a rectangle parallel to a small surface below its corner.
TEST(SourcePlace, OfARectangleGivesFourTimesWhatItsQuarterDoes) {
    const LightItem light = light_of(LightKind::rectangle);
    for (const double height_m : {0.1, 1.0, 10.0}) {
        const double x = 0.6 / height_m, y = 0.4 / height_m, u = std::sqrt(1.0 + x * x), v = std::sqrt(1.0 + y * y);
        const double quarter = (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / 2.0;
        EXPECT_NEAR(received(light, kUp * height_m, kUp, 1.2 * 0.8), 4.0 * quarter, 2e-3 * 4.0 * quarter);
    }
}

TEST(SourcePlace, OfATubeFarAwayGivesItsOutlinesAreaByTheSquareOfTheDistance) {
    LightItem light = light_of(LightKind::tube);
    light.source_radius_m = 0.05f;
    const double distance_m = 40.0, arc = std::acos(0.05 / distance_m), wanted = 1.2 * 0.1 / (distance_m * distance_m);
    EXPECT_NEAR(received(light, kUp * distance_m, kUp, 1.2 * 0.05 * 2.0 * arc), wanted, 1e-2 * wanted);
}

TEST(SourcePlace, IsSeenFromBeforeAPlaneAndFromOutsideOfABody) {
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc}) {
        EXPECT_GT(source_place(light_of(kind), kUp, {0.1, 0.1}).weight, 0.0);
        EXPECT_EQ(source_place(light_of(kind), -kUp, {0.1, 0.1}).weight, 0.0) << "behind it";
        EXPECT_EQ(source_place(light_of(kind), {1.0, 0.0, 0.0}, {0.1, 0.1}).weight, 0.0) << "in its plane";
        EXPECT_FALSE(sees_source(light_of(kind), -kUp, kUp));
    }
    for (const LightKind kind : {LightKind::sphere, LightKind::tube}) {
        EXPECT_GT(source_place(light_of(kind), kUp, {0.1, 0.1}).weight, 0.0);
        EXPECT_EQ(source_place(light_of(kind), 0.4 * kUp, {0.1, 0.1}).weight, 0.0) << "within it";
        EXPECT_FALSE(sees_source(light_of(kind), 0.4 * kUp, kUp));
    }
    EXPECT_EQ(source_place(light_of(LightKind::point), kUp, {0.0, 0.0}).weight, 0.0) << "the control";
}

TEST(SourcePlace, OfASourceAtTheHorizonIsSeenByItsUpperPart) {
    LightItem light = light_of(LightKind::sphere);
    EXPECT_TRUE(sees_source(light, {2.0, 0.0, -0.4}, kUp));
    EXPECT_FALSE(sees_source(light, {2.0, 0.0, -0.6}, kUp)) << "all of it is below";
    light = light_of(LightKind::tube);
    EXPECT_TRUE(sees_source(light, {0.0, 2.0, -0.4}, kUp));
    EXPECT_FALSE(sees_source(light, {0.0, 2.0, -0.6}, kUp));
}

TEST(SourcePlace, KeepsEqualAreasOfADiskEqualOnASquare) {
    // Counts of a fine spiral in the square's quarters and in its middle quarter.
    int corner = 0, middle = 0;
    constexpr int kCount = 40000;
    for (int i = 0; i < kCount; ++i) {
        const double radius = std::sqrt((i + 0.5) / kCount), angle_rad = 2.399963 * i;
        const glm::dvec2 at = disk_to_square(radius * glm::dvec2(std::cos(angle_rad), std::sin(angle_rad)));
        ASSERT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1.0);
        corner += at.x > 0.5 && at.y > 0.5;
        middle += std::abs(at.x) < 0.5 && std::abs(at.y) < 0.5;
    }
    EXPECT_NEAR(corner, kCount / 16, kCount / 400);
    EXPECT_NEAR(middle, kCount / 4, kCount / 400);
    EXPECT_EQ(disk_to_square({0.0, 0.0}), glm::dvec2(0.0));
}

TEST(SourceFacts, BoundWhatFallsAnywhereAtADistance) {
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube}) {
        const LightItem light = light_of(kind);
        EXPECT_NEAR(illuminance_lux(light, 0.0), kPi, 1e-6) << "a hemisphere of it";
        const double far_m = 100.0;
        EXPECT_NEAR(illuminance_lux(light, far_m * far_m), shown_area_m2(light) / (far_m * far_m), 0.02 * shown_area_m2(light) / (far_m * far_m));
    }
    EXPECT_EQ(illuminance_lux(light_of(LightKind::point), 4.0), 0.25) << "the control";
}

TEST(SourceFacts, RefuseSourcesWithoutASize) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube}) {
        const Light good{.kind = kind, .source_radius_m = 0.2f};
        EXPECT_TRUE(usable(good));
        for (const float bad : {0.0f, -1.0f, kNan, kInfinity, 1.0e6f}) {
            Light light = good;
            (kind == LightKind::rectangle ? light.height_m : light.source_radius_m) = bad;
            EXPECT_FALSE(usable(light));
            light = good;
            light.width_m = bad;
            EXPECT_EQ(usable(light), kind == LightKind::disc || kind == LightKind::sphere);
        }
    }
    Light point{.kind = LightKind::point, .source_radius_m = kNan};
    EXPECT_TRUE(usable(point)) << "the control: a point has no need of a size";
}

}  // namespace
}  // namespace gnomon
