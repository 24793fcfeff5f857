#include "systems/embed/picture_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "systems/extract/volumes.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::embed {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dmat4 reversed_infinite(double half_x, double half_y, double near_m) {
    glm::dmat4 m(0.0);
    m[0][0] = 1.0 / half_x;
    m[1][1] = 1.0 / half_y;
    m[2][3] = -1.0;
    m[3][2] = near_m;
    return m;
}

struct Projection {
    const char* name;
    glm::dmat4 clip_from_view;
    ClipDepth clip_depth;
    double near_m, far_m;
    bool reversed;
};

std::vector<Projection> projections() {
    glm::dmat4 reversed = glm::frustumRH_ZO(-0.03, 0.05, -0.02, 0.04, 0.1, 50.0);
    reversed[2][2] = -1.0 - reversed[2][2];  // 1 - d
    reversed[3][2] = -reversed[3][2];
    glm::dmat4 jittered = glm::perspectiveRH_NO(1.0, 1.5, 0.25, 400.0);
    jittered[2][0] += 0.4 / 320.0;
    return {
        {"usual", glm::perspectiveRH_NO(0.9, 1.25, 0.1, 100.0), ClipDepth::minus_one_to_one, 0.1, 100.0, false},
        {"from 0", glm::perspectiveRH_ZO(0.9, 1.25, 0.1, 100.0), ClipDepth::zero_to_one, 0.1, 100.0, false},
        {"infinite", glm::infinitePerspective(0.9, 1.25, 0.1), ClipDepth::minus_one_to_one, 0.1, kInfinity, false},
        {"reversed infinite", reversed_infinite(0.6, 0.5, 0.1), ClipDepth::zero_to_one, 0.1, kInfinity, true},
        {"reversed off-centre", reversed, ClipDepth::zero_to_one, 0.1, 50.0, true},
        {"jittered", jittered, ClipDepth::minus_one_to_one, 0.25, 400.0, false},
        {"off-centre", glm::frustumRH_NO(-0.1, 0.02, -0.05, 0.05, 0.1, 30.0), ClipDepth::minus_one_to_one, 0.1, 30.0, false},
        {"scaled by 3", 3.0 * glm::perspectiveRH_NO(0.9, 1.25, 0.1, 100.0), ClipDepth::minus_one_to_one, 0.1, 100.0, false},
        {"flat", glm::orthoRH_NO(-3.0, 5.0, -2.0, 2.0, 0.5, 20.0), ClipDepth::minus_one_to_one, 0.5, 20.0, false},
        {"flat from 0", glm::orthoRH_ZO(-3.0, 3.0, -2.0, 1.0, -4.0, 20.0), ClipDepth::zero_to_one, -4.0, 20.0, false},
    };
}

TEST(PictureLens, RebuildsEveryPlaceFromItsPixelAndDepth) {
    std::mt19937_64 dice(print_seed());
    std::uniform_real_distribution<double> ndc(-1.0, 1.0), along(0.01, 0.99);
    for (const Projection& p : projections()) {
        SCOPED_TRACE(p.name);
        const auto lens = lens_of(p.clip_from_view, p.clip_depth);
        ASSERT_TRUE(lens);
        EXPECT_EQ(lens->reversed, p.reversed);
        EXPECT_NEAR(lens->near_m, p.near_m, 1.0e-9 * std::abs(p.near_m));
        if (std::isinf(p.far_m))
            EXPECT_GT(lens->far_m, 1.0e6);
        else
            EXPECT_NEAR(lens->far_m, p.far_m, 1.0e-6 * p.far_m);
        for (int i = 0; i < 100; ++i) {
            const double farthest = std::isinf(p.far_m) ? 1.0e4 : p.far_m;
            const double distance_m = p.near_m + along(dice) * (farthest - p.near_m);
            const glm::dvec2 at(ndc(dice), ndc(dice));
            const glm::dvec2 place = (at + lens->shift) * lens->half * (lens->orthographic ? 1.0 : distance_m);
            const glm::dvec4 clip = p.clip_from_view * glm::dvec4(place, -distance_m, 1.0);
            EXPECT_NEAR(clip.x / clip.w, at.x, 1.0e-9);
            EXPECT_NEAR(clip.y / clip.w, at.y, 1.0e-9);
            const double z = clip.z / clip.w;
            const double depth = p.clip_depth == ClipDepth::zero_to_one ? z : 0.5 * z + 0.5;
            const double seen_m = lens->orthographic ? lens->scale * depth + lens->offset : lens->scale / (depth + lens->offset);
            EXPECT_NEAR(seen_m, distance_m, 1.0e-6 * distance_m * distance_m / std::abs(p.near_m));
        }
    }
}

TEST(PictureLens, RefusesWhatIsNoProjection) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dmat4 good = glm::perspectiveRH_NO(0.9, 1.25, 0.1, 100.0);
    EXPECT_TRUE(lens_of(good, ClipDepth::minus_one_to_one));
    EXPECT_FALSE(lens_of(glm::dmat4(0.0), ClipDepth::minus_one_to_one));
    for (const auto& [column, row, value] : {std::tuple(0, 0, nan), std::tuple(0, 0, -1.0), std::tuple(1, 1, 0.0),
                                             std::tuple(0, 1, 0.2), std::tuple(3, 0, 0.2), std::tuple(3, 2, 0.0), std::tuple(2, 3, 1.0)}) {
        glm::dmat4 bad = good;
        bad[column][row] = value;
        EXPECT_FALSE(lens_of(bad, ClipDepth::minus_one_to_one)) << column << ", " << row;
    }
}

TEST(PictureLens, TheConsumerSeesAllOfThePicture) {
    for (const Projection& p : projections()) {
        SCOPED_TRACE(p.name);
        auto lens = lens_of(p.clip_from_view, p.clip_depth);
        ASSERT_TRUE(lens);
        ConsumerItem consumer;
        const glm::dmat4 world_from_view = glm::inverse(glm::lookAt(glm::dvec3(3.0, 2.0, 1.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)));
        const glm::uvec2 size_px(640, 480);
        PictureReach reach;
        update_reach(*lens, size_px, reach);
        ASSERT_TRUE(put_view(world_from_view, reach, *lens, consumer));
        const math::Frustum frustum = consumer_frustum(consumer);
        const double farthest_m = std::isinf(lens->far_m) ? 100.0 : lens->far_m;
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                for (const double distance_m : {lens->near_m, farthest_m}) {
                    const glm::dvec2 place = (glm::dvec2(x, y) + lens->shift) * lens->half * (lens->orthographic ? 1.0 : distance_m);
                    const glm::dvec3 at = consumer.position_ws_m + consumer.rotation_ws * glm::dvec3(place, -distance_m);
                    EXPECT_TRUE(math::may_overlap(frustum, {at - 1.0e-6, at + 1.0e-6}));
                }
        // Pixels are as fine as the picture's.
        const double coarser = std::max(lens->half.x / size_px.x, lens->half.y / size_px.y);  // where they are not square
        EXPECT_LE(pixel_footprint(consumer), 2.0 * coarser * 1.01);
    }
}

/// Returns a lens with its axis off the picture's middle by `shift_px`.
lighting::PictureLens off_by(const glm::dvec2& shift_px, glm::uvec2 size_px, double half = 0.5) {
    lighting::PictureLens lens;
    lens.half = {half, half};
    lens.shift = 2.0 * shift_px / glm::dvec2(size_px);
    return lens;
}

TEST(PictureReach, IsTheShiftWithoutJitter) {
    const glm::uvec2 size_px(640, 480);
    PictureReach reach;
    for (const glm::dvec2& shift_px : {glm::dvec2(0.0), glm::dvec2(100.0, -30.5), glm::dvec2(0.0)})
        for (int i = 0; i < 3; ++i) {
            const lighting::PictureLens lens = off_by(shift_px, size_px);
            update_reach(lens, size_px, reach);
            EXPECT_EQ(reach.reach, glm::abs(lens.shift)) << shift_px.x;
        }
}

TEST(PictureReach, StaysUnderJitterAndHoldsThePicture) {
    std::mt19937_64 dice(print_seed());
    std::uniform_real_distribution<double> inside(-0.5, 0.5);
    const glm::uvec2 size_px(640, 480);
    for (const glm::dvec2& middle_px : {glm::dvec2(0.0), glm::dvec2(37.3, -120.0)}) {
        PictureReach reach;
        glm::dvec2 settled(0.0);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec2 at_px(i % 8 == 0 ? 0.0 : inside(dice), inside(dice));
            const lighting::PictureLens lens = off_by(middle_px + at_px, size_px);
            update_reach(lens, size_px, reach);
            EXPECT_GE(reach.reach.x, std::abs(lens.shift.x));
            EXPECT_GE(reach.reach.y, std::abs(lens.shift.y));
            EXPECT_LT(reach.reach.x - std::abs(lens.shift.x), 5.0 * 2.0 / size_px.x) << "it spares work";
            if (i == 8) settled = reach.reach;
            if (i > 8) {
                EXPECT_EQ(reach.reach, settled) << i;
            }
        }
    }
}

TEST(PictureReach, FollowsOtherPictures) {
    PictureReach reach;
    update_reach(off_by({0.3, 0.2}, {640, 480}), {640, 480}, reach);
    for (const auto& [lens, size_px] : {std::pair(off_by({90.0, 0.0}, {640, 480}), glm::uvec2(640, 480)),
                                        std::pair(off_by({90.0, 0.0}, {320, 240}), glm::uvec2(320, 240)),
                                        std::pair(off_by({45.0, 0.0}, {320, 240}, 0.4), glm::uvec2(320, 240))}) {
        update_reach(lens, size_px, reach);
        EXPECT_EQ(reach.reach, glm::abs(lens.shift));
    }
}

TEST(PictureLens, RefusesACameraThatScales) {
    auto lens = lens_of(glm::perspectiveRH_NO(0.9, 1.25, 0.1, 100.0), ClipDepth::minus_one_to_one);
    ConsumerItem consumer;
    const PictureReach reach{.size_px = {64, 64}};
    EXPECT_TRUE(put_view(glm::dmat4(1.0), reach, *lens, consumer));
    EXPECT_FALSE(put_view(glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)), reach, *lens, consumer));
    EXPECT_FALSE(put_view(glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0)), reach, *lens, consumer));
    EXPECT_FALSE(put_view(glm::dmat4(std::numeric_limits<double>::quiet_NaN()), reach, *lens, consumer));
}

}  // namespace
}  // namespace gnomon::embed
