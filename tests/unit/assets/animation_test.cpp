// Keys as functions of time, against formulas written out here.
#include "gnomon/assets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace gnomon::assets {
namespace {

AnimationChannel steps_to(Interpolation interpolation) {
    return {.node = 0,
            .interpolation = interpolation,
            .times_s = {1.0f, 2.0f, 4.0f},
            .values = {0, 10, 0, 4, 20, 0, 8, -20, 0}};
}

std::array<double, 3> at(const AnimationChannel& channel, double time_s) {
    std::array<double, 3> out{};
    sample(channel, time_s, out);
    return out;
}

glm::dquat turned_at(const AnimationChannel& channel, double time_s) {
    std::array<double, 4> v{};
    sample(channel, time_s, v);
    return {v[3], v[0], v[1], v[2]};
}

/// Turns about y by these angles, as x, y, z, w.
AnimationChannel turns(const std::vector<double>& angles_rad, float sign_of_last = 1.0f) {
    AnimationChannel channel{
        .node = 0, .property = AnimatedProperty::rotation, .width = 4, .times_s = {}, .values = {}};
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
        const float sign = i + 1 == angles_rad.size() ? sign_of_last : 1.0f;
        channel.times_s.push_back(static_cast<float>(i));
        channel.values.insert(channel.values.end(), {0.0f, sign * static_cast<float>(std::sin(angles_rad[i] / 2.0)),
                                                     0.0f, sign * static_cast<float>(std::cos(angles_rad[i] / 2.0))});
    }
    return channel;
}

TEST(Sampling, HoldsTheFirstKeyBeforeItAndTheLastOneAfterIt) {
    for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
        const AnimationChannel channel = steps_to(interpolation);
        for (const double time_s : {-1e9, 0.0, 1.0}) EXPECT_EQ(at(channel, time_s), (std::array{0.0, 10.0, 0.0}));
        for (const double time_s : {4.0, 4.0001, 1e9}) EXPECT_EQ(at(channel, time_s), (std::array{8.0, -20.0, 0.0}));
    }
}

TEST(Sampling, StepsKeepTheKeyBeforeUntilTheNextBegins) {
    const AnimationChannel channel = steps_to(Interpolation::step);
    EXPECT_EQ(at(channel, std::nextafter(2.0, 0.0)), (std::array{0.0, 10.0, 0.0}));
    EXPECT_EQ(at(channel, 2.0), (std::array{4.0, 20.0, 0.0}));
    EXPECT_EQ(at(channel, 3.999), (std::array{4.0, 20.0, 0.0}));
}

TEST(Sampling, LinearKeysAreMixedByTheShareOfTheirOwnSpan) {
    const AnimationChannel channel = steps_to(Interpolation::linear);
    EXPECT_EQ(at(channel, 1.25), (std::array{1.0, 12.5, 0.0}));
    EXPECT_EQ(at(channel, 2.0), (std::array{4.0, 20.0, 0.0}));
    EXPECT_EQ(at(channel, 3.5), (std::array{7.0, -10.0, 0.0}));
}

TEST(Sampling, ASingleKeyIsAlwaysItself) {
    AnimationChannel channel = steps_to(Interpolation::linear);
    channel.times_s.resize(1);
    for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
        channel.interpolation = interpolation;
        for (const double time_s : {-5.0, 1.0, 5.0}) EXPECT_EQ(at(channel, time_s), (std::array{0.0, 10.0, 0.0}));
    }
    channel.interpolation = Interpolation::cubic;  // tangents around the value
    channel.values = {9, 9, 9, 0, 10, 0, 7, 7, 7};
    for (const double time_s : {-5.0, 1.0, 5.0}) EXPECT_EQ(at(channel, time_s), (std::array{0.0, 10.0, 0.0}));
}

TEST(Sampling, KeysOfOneTimeMakeAJumpAndNoDivisionByZero) {
    AnimationChannel channel = steps_to(Interpolation::linear);
    channel.times_s = {1.0f, 2.0f, 2.0f};
    EXPECT_EQ(at(channel, 2.0), (std::array{8.0, -20.0, 0.0}));
    EXPECT_NEAR(at(channel, std::nextafter(2.0, 0.0))[0], 4.0, 1e-12);
}

/// Checks that a cubic with the tangents of a cubic polynomial is that polynomial.
TEST(Sampling, CubicKeysFollowAPolynomialOfTheThirdDegreeExactly) {
    const auto f = [](double t) { return 2.0 * t * t * t - 3.0 * t * t + 0.5 * t - 1.0; };
    const auto slope = [](double t) { return 6.0 * t * t - 6.0 * t + 0.5; };
    AnimationChannel channel{
        .node = 0, .interpolation = Interpolation::cubic, .times_s = {0.5f, 1.0f, 3.0f}, .values = {}};
    for (const float time : channel.times_s) {
        const auto d = static_cast<float>(slope(static_cast<double>(time)));
        const auto v = static_cast<float>(f(static_cast<double>(time)));
        channel.values.insert(channel.values.end(), {d, 0, 0, v, 1, 0, d, 0, 0});
    }
    for (double t = 0.5; t < 3.0; t += 0.0625) {
        EXPECT_NEAR(at(channel, t)[0], f(t), 1e-12 + 1e-6 * std::abs(f(t))) << t;
        EXPECT_NEAR(at(channel, t)[1], 1.0, 1e-12);
    }
    channel.values[6] += 1.0f;  // another tangent out of the first key
    EXPECT_GT(std::abs(at(channel, 0.75)[0] - f(0.75)), 0.05);
}

TEST(Sampling, RotationsGoTheShortWayAtAConstantSpeedWhicheverSignTheirKeysHave) {
    for (const float sign : {1.0f, -1.0f}) {
        const AnimationChannel channel = turns({0.2, 2.4}, sign);
        for (const double share : {0.0, 0.1, 0.5, 0.75, 1.0}) {
            const glm::dquat wanted = glm::angleAxis(0.2 + share * 2.2, glm::dvec3(0.0, 1.0, 0.0));
            const glm::dquat found = turned_at(channel, share);
            EXPECT_NEAR(std::abs(glm::dot(wanted, found)), 1.0, 1e-12) << sign << ", " << share;
            EXPECT_NEAR(glm::length(found), 1.0, 1e-12);
        }
    }
    const AnimationChannel over_half = turns({0.0, 1.5 * glm::pi<double>()});  // so that it goes back by a quarter
    const glm::dquat wanted = glm::angleAxis(-0.25 * glm::pi<double>(), glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_NEAR(std::abs(glm::dot(wanted, turned_at(over_half, 0.5))), 1.0, 1e-7);
}

TEST(Sampling, RotationsAreOfUnitLengthWhateverTheKeysLengthAndTangents) {
    AnimationChannel channel = turns({0.3, 1.1});
    for (float& v : channel.values) v *= 7.0f;
    for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
        channel.interpolation = interpolation;
        for (const double t : {-1.0, 0.0, 0.4, 1.0, 2.0}) EXPECT_NEAR(glm::length(turned_at(channel, t)), 1.0, 1e-12);
    }
    channel.interpolation = Interpolation::cubic;
    channel.values = {0, 0, 0, 0, 0, 0, 0, 1, 3, 2, 1, 0, 0, 5, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) EXPECT_NEAR(glm::length(turned_at(channel, t)), 1.0, 1e-12);
    channel.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0};
    EXPECT_EQ(turned_at(channel, 0.5), glm::dquat(1.0, 0.0, 0.0, 0.0)) << "both keys cancel: no direction is left";
}

TEST(Sampling, WeightsOfAnyNumberAreSampledTogether) {
    const AnimationChannel channel{
        .node = 0, .property = AnimatedProperty::weights, .width = 2, .times_s = {0.0f, 1.0f}, .values = {0, 1, 1, -1}};
    std::array<double, 2> out{};
    sample(channel, 0.25, out);
    EXPECT_EQ(out, (std::array{0.25, 0.5}));
}

TEST(Looping, BeginsAnewAfterTheLastKeyAlsoBeforeTimeZero) {
    EXPECT_EQ(looped_s(0.0, 2.0), 0.0);
    EXPECT_EQ(looped_s(1.5, 2.0), 1.5);
    EXPECT_EQ(looped_s(2.0, 2.0), 0.0);
    EXPECT_EQ(looped_s(9.5, 2.0), 1.5);
    EXPECT_EQ(looped_s(-0.5, 2.0), 1.5);
    EXPECT_EQ(looped_s(-4.0, 2.0), 0.0);
    EXPECT_LT(looped_s(-1e-300, 2.0), 2.0);
    for (const double length : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(looped_s(3.0, length), 0.0);
    EXPECT_EQ(looped_s(std::numeric_limits<double>::infinity(), 2.0), 0.0);
    EXPECT_EQ(looped_s(std::numeric_limits<double>::quiet_NaN(), 2.0), 0.0);
}

TEST(Looping, AnAnimationLastsUntilTheLastKeyOfAnyChannel) {
    Animation animation;
    EXPECT_EQ(duration_s(animation), 0.0);
    animation.channels = {steps_to(Interpolation::step), turns({0.0, 1.0})};
    EXPECT_EQ(duration_s(animation), 4.0);
}

}  // namespace
}  // namespace gnomon::assets
