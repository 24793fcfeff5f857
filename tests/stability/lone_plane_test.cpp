#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/stability/lone_plane.h"

/// Planes that random ones led to, reduced to what mattered.
namespace gnomon {
namespace {

using shadow::ShadowView;

constexpr std::uint32_t kSize_px = 64;
constexpr double kLight_m = 0.05;  // from the plane
constexpr double kCamera_m = 1000.0;

constexpr shadow::PerspectiveRange kRange{0.02, 1.0};

std::vector<ShadowView> spot() {
    return {shadow::perspective_view(glm::dvec3(0.0), glm::dmat3(1.0), {}, kRange, kSize_px)};
}

/// Makes a plane that rises toward the light by 1 along u and 1/2 along v. The receiver is in the low corner of a
/// texel, as far behind the plane as it may be. The plane is drawn as much too near as it may be.
LonePlane seen_from_afar(const ShadowView& view) {
    LonePlane plane;
    plane.normal = glm::normalize(view.pose.axis_back - view.pose.axis_u - 0.5 * view.pose.axis_v);
    plane.worst = true;
    plane.aside_texel = glm::dvec2(plane_bounds().snap_texel);
    plane.error_m = plane_bounds().rebuilt_relative * kCamera_m;
    constexpr double kBesideCorner_texel = 1e-6;
    const glm::dvec2 tangent = (glm::dvec2(40.0, 36.0) + kBesideCorner_texel) / (0.5 * kSize_px) - 1.0;
    const glm::dvec3 way = view.pose.axis_u * tangent.x + view.pose.axis_v * tangent.y - view.pose.axis_back;
    plane.receiver_m = way * (-(kLight_m + plane.error_m) / glm::dot(way, plane.normal));
    plane.at_m = plane.receiver_m + plane.normal * plane.error_m;
    plane.receiver_normal = plane.normal;
    return plane;
}

/// Proves that the bias in perspective, which is inverse to the light's distance from the plane, takes the plane's own.
/// The receiver's plane passes error_m farther from the light, here 0.16 mm of 50 mm. Divided by that distance, the
/// offset would be 0.3 % too small. Among 100 000 random planes of each combination four show this, with errors of 0.04
/// to 0.23 %. One of them is 4.503 mm from a point light of 64 x 64 texels per face. It is 2 um off and seen from
/// 12.5 m; its offset would be 0.02 % too small.
TEST(LonePlane, IsLitWhereTheReceiverSeemsFartherFromTheLightThanThePlaneIs) {
    for (const PlaneKind kind : {PlaneKind::point, PlaneKind::spot})
        for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf_grid}) {
            SCOPED_TRACE(plane_kind_name(kind) + (" " + std::string(shadow::filter_row(filter).name)));
            LonePlaneLookup lookup(kind, filter, DepthFormat::d32f);
            const std::vector<ShadowView> views =
                kind == PlaneKind::point ? cube_views(glm::dvec3(0.0), kRange, kSize_px) : spot();
            lookup.set_maps(views, kSize_px, glm::dvec3(0.0, 0.0, kCamera_m));
            const LonePlane plane = seen_from_afar(views.back());
            EXPECT_TRUE(lookup.look_up(plane, 1.0).lit);
            EXPECT_TRUE(lookup.look_up(plane, 1.0).looked_up);
            EXPECT_FALSE(lookup.look_up(plane, kLight_m / (kLight_m + plane.error_m)).lit) << "more than is needed";
        }
}

/// Proves that the offset contains a whole step of the depth format at every texel that a filter reads. Such a filter
/// carries the receiver's plane to the texels around it. Carried along as a share of the depth, the step's part of the
/// offset would shrink where the plane falls away from the light. That would darken 3 of 100 000 random planes in 16
/// bits, where a mask leaves the nearest texel to decide. Less bias is judged with sharp_4x4 alone. `triangles` would
/// hide what is missing: it takes depths within a twentieth of the slope for the receiver's own surface.
TEST(LonePlane, IsLiftedByAWholeStepOfTheFormatWhereItFallsAwayFromTheLight) {
    constexpr shadow::PerspectiveRange kCoarse{0.001, 1.0};  // a step of 16 bits is a 60th of the depth at half the range
    constexpr double kTangent = 7.0, kPlace_texel = 0.5 * kSize_px, kBesideCorner_texel = 1e-3, kLess = 0.9;
    constexpr int kDistances = 1000;
    const ShadowView spot = shadow::perspective_view(glm::dvec3(0.0), glm::dmat3(1.0), {}, kCoarse, kSize_px);
    for (const PlaneKind kind : {PlaneKind::point, PlaneKind::spot}) {
        SCOPED_TRACE(plane_kind_name(kind));
        const std::vector<ShadowView> views =
            kind == PlaneKind::point ? cube_views(glm::dvec3(0.0), kCoarse, kSize_px) : std::vector{spot};
        const ShadowView& view = views.back();
        LonePlaneLookup lookup(kind, ShadowFilter::sharp_4x4, DepthFormat::d16);
        LonePlaneLookup of_triangles(kind, ShadowFilter::triangles, DepthFormat::d16);
        of_triangles.set_maps(views, kSize_px, glm::dvec3(0.0));
        lookup.set_maps(views, kSize_px, glm::dvec3(0.0));
        LonePlane plane;
        plane.normal = plane.receiver_normal = glm::normalize(view.pose.axis_back + kTangent * glm::normalize(view.pose.axis_u + view.pose.axis_v));
        plane.worst = true;
        plane.aside_texel = glm::dvec2(plane_bounds().snap_texel);
        const double tangent = (kPlace_texel + kBesideCorner_texel) / (0.5 * kSize_px) - 1.0;
        int dark = 0, dark_with_less = 0;
        for (int i = 0; i < kDistances; ++i) {
            const double z_m = 0.3 + 0.5 * i / kDistances;
            plane.receiver_m = plane.at_m = z_m * (tangent * (view.pose.axis_u + view.pose.axis_v) - view.pose.axis_back);
            dark += !lookup.look_up(plane, 1.0).lit + !of_triangles.look_up(plane, 1.0).lit;
            dark_with_less += !lookup.look_up(plane, kLess).lit;
        }
        EXPECT_EQ(dark, 0);
        EXPECT_GT(dark_with_less, 0);
    }
}

/// Grazes a plane so that its normal's error may turn it by more than the lamp's distance from it. An offset for the
/// whole error would take the receiver past the lamp. The plane, carried to the next texel's middle, would then fall
/// the wrong way. Seeds 125 and 148 of RandomPlanes have one such plane each, at a cosine of 1/700, where no triangle
/// is known.
TEST(LonePlane, IsLitWhereItsNormalsErrorExceedsTheLampsDistanceFromIt) {
    constexpr double kCosine = 1.0 / 731.0, kDistance_m = 0.3;
    constexpr int kTurns = 360;
    const glm::dvec2 kPlace_texel(30.12, 13.00001);  // all but on the border of two texels
    const ShadowView spot = shadow::perspective_view(glm::dvec3(0.0), glm::dmat3(1.0), {}, kRange, kSize_px);
    for (const PlaneKind kind : {PlaneKind::point, PlaneKind::spot})
        for (const ShadowFilter filter : {ShadowFilter::triangles, ShadowFilter::sharp_4x4}) {
            SCOPED_TRACE(plane_kind_name(kind) + (" " + std::string(shadow::filter_row(filter).name)));
            const std::vector<ShadowView> views =
                kind == PlaneKind::point ? cube_views(glm::dvec3(0.0), kRange, kSize_px) : std::vector{spot};
            const ShadowView& view = views.back();
            LonePlaneLookup lookup(kind, filter, DepthFormat::d32f);
            lookup.set_maps(views, kSize_px, glm::dvec3(0.0));
            const glm::dvec2 tangent = kPlace_texel / (0.5 * kSize_px) - 1.0;
            const glm::dvec3 way =
                glm::normalize(view.pose.axis_u * tangent.x + view.pose.axis_v * tangent.y - view.pose.axis_back);
            int dark = 0, dark_behind_another = 0;
            for (int turn = 0; turn < kTurns; ++turn) {
                const double angle = 6.283185307179586 * turn / kTurns;
                const glm::dvec3 uphill = view.pose.axis_u * std::cos(angle) + view.pose.axis_v * std::sin(angle);
                LonePlane plane;
                plane.normal = glm::normalize(glm::normalize(uphill - way * glm::dot(uphill, way)) - way * kCosine);
                plane.receiver_normal = plane.normal;
                plane.receiver_m = plane.at_m = way * kDistance_m;
                dark += !lookup.look_up(plane, 1.0).lit;
                plane.normal = -way;
                plane.at_m *= 0.1;
                dark_behind_another += !lookup.look_up(plane, 1.0).lit;
            }
            EXPECT_EQ(dark, 0);
            EXPECT_GT(dark_behind_another, 0) << "it would be lit whatever the map previous";
        }
}

}  // namespace
}  // namespace gnomon
