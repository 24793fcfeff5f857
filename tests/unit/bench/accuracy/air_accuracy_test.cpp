#include "bench/accuracy/air_accuracy.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

// Where view rays run through boxes of fog.
namespace gnomon::bench {
namespace {

constexpr double kFar_m = std::numeric_limits<double>::infinity();
const glm::dvec3 kHalf_m(2.0, 1.0, 3.0);

InstanceItem box_at(const glm::dvec3& middle_m, const glm::dmat3& basis = glm::dmat3(1.0)) {
    InstanceItem box;
    box.mesh = kNoMesh;
    box.basis = basis;
    box.translation_ws_m = middle_m;
    return box;
}

void expect_span(const LineSpan& found, double from_m, double to_m) {
    EXPECT_NEAR(found.from_m, from_m, 1e-12);
    EXPECT_NEAR(found.to_m, to_m, 1e-12);
}
bool is_empty(const LineSpan& span) { return !(span.from_m < span.to_m); }

TEST(SpanInBox, IsWhatLiesBetweenEntryAndExit) {
    const InstanceItem box = box_at({10.0, 0.0, 0.0});
    expect_span(span_in_box(box, kHalf_m, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.1, kFar_m}), 8.0, 12.0);
    expect_span(span_in_box(box, kHalf_m, {10.0, 0.5, 0.0}, {0.0, -1.0, 0.0}, {0.1, kFar_m}), 0.1, 1.5);
}

TEST(SpanInBox, EndsAtTheSurfaceAndBeginsAtTheNearPlane) {
    const InstanceItem box = box_at({10.0, 0.0, 0.0});
    expect_span(span_in_box(box, kHalf_m, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {9.0, 11.0}), 9.0, 11.0);
    EXPECT_TRUE(is_empty(span_in_box(box, kHalf_m, glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.1, 7.5})));
}

TEST(SpanInBox, IsEmptyBesideTheBoxAndBehindTheEye) {
    const InstanceItem box = box_at({10.0, 0.0, 0.0});
    EXPECT_TRUE(is_empty(span_in_box(box, kHalf_m, {0.0, 1.5, 0.0}, {1.0, 0.0, 0.0}, {0.1, kFar_m})));
    EXPECT_TRUE(is_empty(span_in_box(box, kHalf_m, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.1, kFar_m})));
    EXPECT_TRUE(is_empty(span_in_box(box, kHalf_m, glm::dvec3(0.0), {-1.0, 0.0, 0.0}, {0.1, kFar_m})));
}

TEST(SpanInBox, FollowsATurnedAndScaledBox) {
    const glm::dmat3 turned = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))));
    const InstanceItem box = box_at({1.0, -4.0, 2.0}, glm::dmat3(2.0 * turned[0], turned[1], 0.5 * turned[2]));
    const glm::dvec3 along = turned[0], start_m = box.translation_ws_m - 9.0 * along;
    expect_span(span_in_box(box, kHalf_m, start_m, along, {0.0, kFar_m}), 5.0, 13.0);
    expect_span(span_in_box(box, kHalf_m, box.translation_ws_m, turned[2], {0.0, kFar_m}), 0.0, 1.5);
}

}  // namespace
}  // namespace gnomon::bench
