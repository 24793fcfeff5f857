#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/publish/publish_lights.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {
namespace {

class ScreenRectangle : public ::testing::Test {
protected:
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    glm::dvec3 direction() {
        glm::dvec3 d;
        do d = {number(-1, 1), number(-1, 1), number(-1, 1)};
        while (!(glm::dot(d, d) > 1e-3 && glm::dot(d, d) <= 1.0));
        return glm::normalize(d);
    }
    ConsumerItem camera(bool orthographic) {
        ConsumerItem c;
        c.position_ws_m = 100.0 * direction();
        c.rotation_ws = math::basis_from_back(direction());
        c.projection = orthographic ? CameraProjection::orthographic : CameraProjection::perspective;
        c.fov_y_rad = number(0.2, 2.5);
        c.half_height_m = number(0.5, 20.0);
        c.far_m = orthographic ? 1000.0 : 1e9;
        c.viewport_px = {static_cast<std::uint32_t>(number(1, 2000)), static_cast<std::uint32_t>(number(1, 2000))};
        return c;
    }
    /// Returns whether a ray meets a spot's cone: tried at the roots of its quadric, between and beyond them.
    static bool meets_cone(const LightItem& light, const glm::dvec3& start, const glm::dvec3& way) {
        const glm::dvec3 axis = -light.rotation_ws[2];
        const double k = std::pow(std::cos(light.outer_cone_rad), 2.0);
        const double s = glm::dot(start, axis), w = glm::dot(way, axis);
        const double a = w * w - k * glm::dot(way, way), b = s * w - k * glm::dot(start, way),
                     c = s * s - k * glm::dot(start, start);
        const auto is_inside = [&](double t) {
            const glm::dvec3 p = start + t * way;
            return t >= 0.0 && glm::dot(p, axis) > std::cos(light.outer_cone_rad) * glm::length(p);
        };
        const double root = std::sqrt(std::max(0.0, b * b - a * c));
        const double t0 = (-b - root) / a, t1 = (-b + root) / a;
        for (const double t : {0.0, 0.5 * (t0 + t1), std::min(t0, t1) - 1e-3, std::max(t0, t1) + 1e-3,
                               std::max(t0, t1) + 1.0, 1e7, 0.5 * std::max(t0, t1), 0.5 * std::min(t0, t1)})
            if (is_inside(t)) return true;
        return false;
    }
    std::mt19937_64 random{print_seed()};
};

TEST_F(ScreenRectangle, HoldsEveryVisiblePointOfTheRangeAndOfTheCone) {
    int visible = 0, partial = 0;
    for (int round = 0; round < 2000; ++round) {
        const ConsumerItem c = camera(round % 2 == 1);
        LightItem light;
        light.kind = round % 3 == 0 ? LightKind::spot : LightKind::point;
        light.position_ws_m = c.position_ws_m + number(0.0, 60.0) * direction();
        light.range_m = number(0.1, 20.0);
        light.rotation_ws = math::basis_from_back(direction());
        light.outer_cone_rad = number(0.05, 1.57);
        const gl::Rect rect = screen_rectangle(light, c);
        const float farthest = farthest_depth(light, c);
        const glm::mat4 clip_from_view(camera_record(c).clip_from_anchor);
        const bool flat = c.projection == CameraProjection::orthographic;
        const double half_y = flat ? c.half_height_m : std::tan(0.5 * c.fov_y_rad);
        if (rect.width > 0 && rect.width < static_cast<int>(c.viewport_px.x)) ++partial;
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 along = direction();
            if (light.kind == LightKind::spot && glm::dot(along, -light.rotation_ws[2]) < std::cos(light.outer_cone_rad)) continue;
            const glm::dvec3 p = (light.position_ws_m + light.range_m * std::cbrt(number(0, 1)) * along - c.position_ws_m) * c.rotation_ws;
            if (!(-p.z > c.near_m)) continue;
            const glm::dvec2 ndc = glm::dvec2(p) / (flat ? 1.0 : -p.z) / glm::dvec2(half_y * aspect(c), half_y);
            if (std::abs(ndc.x) > 1.0 || std::abs(ndc.y) > 1.0) continue;
            const glm::vec4 clip = clip_from_view * glm::vec4(glm::vec3(c.rotation_ws * p), 1.0f);
            EXPECT_GT(clip.z / clip.w, farthest) << "at " << -p.z << " m";
            const glm::dvec2 px = (ndc * 0.5 + 0.5) * glm::dvec2(c.viewport_px);
            ++visible;
            EXPECT_TRUE(px.x >= rect.x && px.y >= rect.y && px.x <= rect.x + rect.width && px.y <= rect.y + rect.height)
                << px.x << ',' << px.y << " outside " << rect.x << ',' << rect.y << ' ' << rect.width << 'x' << rect.height;
        }
        EXPECT_TRUE(rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= static_cast<int>(c.viewport_px.x) &&
                    rect.y + rect.height <= static_cast<int>(c.viewport_px.y));
    }
    EXPECT_GT(visible, 1000) << "the test must see something";
    EXPECT_GT(partial, 50) << "and not only whole pictures";
}

TEST_F(ScreenRectangle, HoldsEveryVisiblePointOfAnUnlimitedConeAndIsTightAroundThem) {
    int visible = 0, partial = 0, none = 0, tight = 0, checked = 0;
    for (int round = 0; round < 3000; ++round) {
        const ConsumerItem c = camera(round % 2 == 1);
        LightItem light;
        light.kind = LightKind::spot;
        light.position_ws_m = c.position_ws_m + number(0.0, 30.0) * direction();
        light.rotation_ws = math::basis_from_back(direction());
        light.outer_cone_rad = number(0.05, 1.57);
        const gl::Rect rect = screen_rectangle(light, c);
        const bool flat = c.projection == CameraProjection::orthographic;
        const glm::dvec2 half = (flat ? c.half_height_m : std::tan(0.5 * c.fov_y_rad)) * glm::dvec2(aspect(c), 1.0);
        const glm::dvec2 size(c.viewport_px);
        partial += rect.width > 0 && rect.width * rect.height < static_cast<int>(0.8 * size.x * size.y) ? 1 : 0;
        none += rect.width == 0 ? 1 : 0;
        glm::dvec2 low(1e9), high(-1e9);
        // Places of the picture, each at all distances.
        for (int i = 0; i < 400; ++i) {
            const glm::dvec2 at = i < 4 ? glm::dvec2(i % 2, i / 2) : glm::dvec2(number(0, 1), number(0, 1));
            const glm::dvec2 aside = (2.0 * at - 1.0) * half;
            const glm::dvec3 sideways = c.rotation_ws[0] * aside.x + c.rotation_ws[1] * aside.y;
            const glm::dvec3 start = c.position_ws_m + (flat ? sideways : glm::dvec3(0));
            const glm::dvec3 way = (flat ? glm::dvec3(0) : sideways) - c.rotation_ws[2];
            const bool seen = meets_cone(light, start - light.position_ws_m, way);
            if (!seen) continue;
            ++visible;
            const glm::dvec2 px = at * size;
            low = glm::min(low, px), high = glm::max(high, px);
            EXPECT_TRUE(px.x >= rect.x && px.y >= rect.y && px.x <= rect.x + rect.width && px.y <= rect.y + rect.height)
                << px.x << ',' << px.y << " outside " << rect.x << ',' << rect.y << ' ' << rect.width << 'x'
                << rect.height;
        }
        if (!(high.x - low.x > 0.2 * size.x && high.y - low.y > 0.2 * size.y && size.x > 50 && size.y > 50)) continue;
        if (light.outer_cone_rad > 1.3) continue;
        ++checked;
        tight += rect.width * rect.height < 1.5 * (high.x - low.x) * (high.y - low.y) ? 1 : 0;
    }
    EXPECT_GT(visible, 100000);
    EXPECT_GT(partial, 300);
    EXPECT_GT(none, 300) << "cones that shine away from the view";
    EXPECT_GT(tight, 0.8 * checked) << "of " << checked;
}

TEST_F(ScreenRectangle, GoesWithADepthThatLittleBeyondTheRangeHas) {
    for (int round = 0; round < 1000; ++round) {
        const ConsumerItem c = camera(round % 2 == 1);
        LightItem light;
        light.kind = LightKind::point;
        light.range_m = number(0.1, 20.0);
        light.position_ws_m = c.position_ws_m - number(0.0, 60.0) * c.rotation_ws[2];
        const double beyond_m = glm::dot(c.position_ws_m - light.position_ws_m, c.rotation_ws[2]) + light.range_m * 1.001 +
                                (round % 2 == 1 ? 1e-4 * c.far_m : 1e-4 * 60.0);
        const glm::vec4 clip = glm::mat4(camera_record(c).clip_from_anchor) *
                               glm::vec4(glm::vec3(-beyond_m * c.rotation_ws[2]), 1.0f);
        EXPECT_LT(clip.z / clip.w, farthest_depth(light, c));
        light.range_m = 0.0;
        EXPECT_EQ(farthest_depth(light, c), 0.0f) << "unlimited";
        light.range_m = 1.0;
        light.position_ws_m = c.position_ws_m + 2.0 * c.rotation_ws[2];
        EXPECT_EQ(farthest_depth(light, c), 1.0f) << "behind the camera";
        light.kind = LightKind::directional;
        EXPECT_EQ(farthest_depth(light, c), 0.0f);
    }
}

TEST_F(ScreenRectangle, IsEmptyBehindTheCameraAndWholeForTheUnlimited) {
    ConsumerItem c;
    c.viewport_px = {320, 200};
    LightItem light;
    light.range_m = 2.0;
    light.position_ws_m = {0, 0, 5};
    EXPECT_EQ(screen_rectangle(light, c).width, 0);
    light.range_m = 0.0;
    EXPECT_EQ(screen_rectangle(light, c), (gl::Rect{0, 0, 320, 200}));
    light.range_m = 2.0;
    light.kind = LightKind::directional;
    EXPECT_EQ(screen_rectangle(light, c), (gl::Rect{0, 0, 320, 200}));
}

TEST_F(ScreenRectangle, OfAFarLightIsSmall) {
    ConsumerItem c;
    c.viewport_px = {1000, 1000};
    LightItem light;
    light.range_m = 1.0;
    light.position_ws_m = {0, 0, -100};
    const gl::Rect rect = screen_rectangle(light, c);
    EXPECT_GT(rect.width, 0);
    EXPECT_LT(rect.width, 30);
}

TEST_F(ScreenRectangle, OfANarrowConeIsMuchSmallerThanThatOfItsRange) {
    ConsumerItem c;
    c.position_ws_m = {0, 0, 30};
    LightItem spot;
    spot.kind = LightKind::spot;
    spot.range_m = 10.0;
    spot.outer_cone_rad = 0.2;
    spot.rotation_ws = math::basis_from_back(glm::dvec3(-1, 0, 0));  // shines to the right
    LightItem point = spot;
    point.kind = LightKind::point;
    const gl::Rect narrow = screen_rectangle(spot, c), whole = screen_rectangle(point, c);
    EXPECT_LT(3 * narrow.width * narrow.height, whole.width * whole.height);
    EXPECT_GT(narrow.width, 0);
}

TEST_F(ScreenRectangle, BeyondTheFarPlaneThereIsNone) {
    ConsumerItem c;
    LightItem light;
    light.position_ws_m = {0, 0, -50};
    light.range_m = 10.0;
    c.far_m = 45.0;
    EXPECT_GT(screen_rectangle(light, c).width, 0);
    c.far_m = 39.0;
    EXPECT_EQ(screen_rectangle(light, c).width, 0);
}

}  // namespace
}  // namespace gnomon::shadow
