#include "bench/flicker/camera_path.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gnomon::bench {
namespace {

ConsumerItem camera_of(CameraProjection projection) {
    ConsumerItem camera;
    camera.projection = projection;
    camera.position_ws_m = {3.0, 2.0, -1.0};
    camera.rotation_ws = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, 0.2))));
    camera.viewport_px = {200, 100};
    return camera;
}

TEST(CameraPath, ShowsAPointWhereTheRayThroughThatPlaceMeetsIt) {
    for (const CameraProjection projection : {CameraProjection::perspective, CameraProjection::orthographic}) {
        const ConsumerItem camera = camera_of(projection);
        for (const glm::dvec2& ndc : {glm::dvec2(0.0), glm::dvec2(-0.5, 0.9), glm::dvec2(0.99, -0.2)}) {
            const oracle::ExactRay ray = ray_through(camera, ndc, glm::dvec3(0.0));
            const glm::dvec2 at_px = place_px(camera, ray.origin + 7.0 * ray.direction);
            EXPECT_NEAR(at_px.x, (ndc.x + 1.0) * 100.0 - 0.5, 1e-9);
            EXPECT_NEAR(at_px.y, (ndc.y + 1.0) * 50.0 - 0.5, 1e-9);
        }
    }
}

TEST(CameraPath, APixelIsAsWideAsThePlacesOfItsNeighboursAreApart) {
    for (const CameraProjection projection : {CameraProjection::perspective, CameraProjection::orthographic}) {
        const ConsumerItem camera = camera_of(projection);
        const auto at = [&](double x_px) {
            const oracle::ExactRay ray = ray_through(camera, {(x_px + 0.5) / 100.0 - 1.0, 0.1}, glm::dvec3(0.0));
            return ray.origin + 7.0 * ray.direction;
        };
        EXPECT_NEAR(pixel_width_m(camera, at(30.0)), glm::length(at(31.0) - at(30.0)), 1e-9);
    }
}

TEST(CameraPath, WithoutANameIsEachAndAnUnknownOneIsAnError) {
    EXPECT_EQ(chosen_names({}, {"pan", "walk"}, "path").value().size(), 2u);
    EXPECT_EQ(chosen_names({"walk"}, {"pan", "walk"}, "path").value(), std::vector<std::string>{"walk"});
    const auto unknown = chosen_names({"fly"}, {"pan", "walk"}, "path");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().rule, "bench.path");
}

}  // namespace
}  // namespace gnomon::bench
