#include "systems/extract/volumes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

TEST(Volumes, AspectIsWidthOverHeight) {
    ConsumerItem c;
    c.viewport_px = {200, 50};
    EXPECT_EQ(aspect(c), 4.0);
}

TEST(Volumes, APixelsFootprintCoversThePictureHeight) {
    ConsumerItem c;
    c.viewport_px = {100, 50};
    c.fov_y_rad = 1.0;
    EXPECT_DOUBLE_EQ(pixel_footprint(c) * 50.0, 2.0 * std::tan(0.5));
    c.projection = CameraProjection::orthographic;
    c.half_height_m = 3.0;
    EXPECT_DOUBLE_EQ(pixel_footprint(c) * 50.0, 6.0);
}

TEST(Volumes, TheFrustumHoldsWhatTheCameraSeesAndNothingElse) {
    ConsumerItem c;
    c.viewport_px = {200, 100};
    c.fov_y_rad = 2.0 * std::atan(1.0);  // 45 degrees to each side, twice as wide
    c.far_m = 10.0;
    const auto sees = [&](const glm::dvec3& p) {
        const glm::dvec3 reach(1e-6);
        return math::may_overlap(consumer_frustum(c), {p - reach, p + reach});
    };
    EXPECT_TRUE(sees({9.9, 0, -5}) && sees({0, 4.9, -5}) && sees({0, 0, -9.9}));
    EXPECT_FALSE(sees({10.1, 0, -5}) || sees({0, 5.1, -5}) || sees({0, 0, -10.1}) || sees({0, 0, 1}) ||
                 sees({0, 0, -0.01}));
    c.projection = CameraProjection::orthographic;
    c.half_height_m = 2.0;
    EXPECT_TRUE(sees({3.9, 1.9, -5}));
    EXPECT_FALSE(sees({4.1, 0, -5}) || sees({0, 2.1, -5}));
}

}  // namespace
}  // namespace gnomon
