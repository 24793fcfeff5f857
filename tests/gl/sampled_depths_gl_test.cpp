#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "systems/lighting/depth_sampler.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "tests/gl/box_fixture.h"

// The counts of pixels by view distance against the processor's own.
namespace gnomon {
namespace {

class DepthSamplerTest : public GlTest {
protected:
    static constexpr std::uint32_t kWidth = 203, kHeight = 131;  // no multiple of a tile

    SampledDepths counted(const std::vector<float>& depths, const shadow::CameraRecord& record) {
        const auto texture = keep(
            device().create_texture({.label = "depth", .format = gl::Format::d32f, .width = kWidth, .height = kHeight},
                                    std::as_bytes(std::span(depths))));
        const auto sampler = keep(device().create_sampler({.label = "point"}));
        const auto uniforms =
            keep(device().create_buffer({.label = "camera", .size = sizeof record, .use = gl::BufferUse::fixed},
                                        std::as_bytes(std::span(&record, 1))));
        lighting::DepthSampler depth_sampler(device());
        SampledDepths result;
        for (int round = 0; round < 2; ++round) {  // the second must not add to the first
            gl::CommandList list;
            depth_sampler.record({kCamera, texture, sampler, uniforms, {kWidth, kHeight}}, list);
            run(list);
            device().finish();
            depth_sampler.collect(result);
        }
        return result;
    }

    static constexpr ecs::Entity kCamera{5, 2};
};

/// The processor's counts, and how many pixels lie so near an edge that rounding may put them on either side.
struct Counts {
    std::array<std::uint32_t, kDepthBins> sure{}, either{};
};
void count(double distance_m, Counts& counts) {
    constexpr double kRounding = 1e-6;  // steps that a few float operations may be off by
    const double at = 4.0 * std::log2(distance_m) - kFirstDepthStep;
    const auto low = static_cast<std::size_t>(std::clamp(std::floor(at - kRounding), 0.0, kDepthBins - 1.0));
    const auto high = static_cast<std::size_t>(std::clamp(std::floor(at + kRounding), 0.0, kDepthBins - 1.0));
    if (low == high) ++counts.sure[low];
    if (low != high) ++counts.either[low], ++counts.either[high];
}

void expect_counts(const SampledDepths& measured, const Counts& counts) {
    for (std::size_t bin = 0; bin < kDepthBins; ++bin) {
        EXPECT_GE(measured.pixels[bin], counts.sure[bin]) << bin;
        EXPECT_LE(measured.pixels[bin], counts.sure[bin] + counts.either[bin]) << bin;
    }
}

TEST_F(DepthSamplerTest, CountsEveryPixelOfAPerspectiveViewWhereItLies) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> octave(-12.0, 18.0);
    const float near_m = 1.0e-4f;
    shadow::CameraRecord record;
    record.unproject = {0.0f, near_m, kWidth, kHeight};  // infinite far: depth = near / distance
    std::vector<float> depths(std::size_t{kWidth} * kHeight);
    Counts counts;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        depths[i] = i % 7 == 0 ? 0.0f : static_cast<float>(static_cast<double>(near_m) / std::exp2(octave(random)));
        if (depths[i] > 0.0f) count(static_cast<double>(near_m) / static_cast<double>(depths[i]), counts);
    }
    const SampledDepths measured = counted(depths, record);
    EXPECT_EQ(measured.camera, kCamera);
    EXPECT_FALSE(measured.failed);
    expect_counts(measured, counts);
}

TEST_F(DepthSamplerTest, CountsDistancesOfAFlatView) {
    shadow::CameraRecord record;
    record.back.w = 1.0f;
    record.unproject = {64.0f, 63.0f, kWidth, kHeight};  // depth 1 at 1 m, 0 at 64 m
    std::vector<float> depths(std::size_t{kWidth} * kHeight);
    Counts counts;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        depths[i] = static_cast<float>(i + 1) / static_cast<float>(depths.size());
        count(64.0 - 63.0 * static_cast<double>(depths[i]), counts);
    }
    expect_counts(counted(depths, record), counts);
}

TEST_F(DepthSamplerTest, PutsPowersOfTwoIntoTheBinsThatTheyBegin) {
    shadow::CameraRecord record;
    record.unproject = {0.0f, std::exp2(-30.0f), kWidth, kHeight};
    std::vector<float> depths(std::size_t{kWidth} * kHeight, 0.0f);
    for (int k = -30; k <= 45; ++k)  // at 2^k m
        depths[static_cast<std::size_t>(k + 30) * 97] = std::exp2(static_cast<float>(-30 - k));
    const SampledDepths measured = counted(depths, record);
    for (int bin = 0; bin < static_cast<int>(kDepthBins); ++bin) {
        // What lies before the first bin or behind the last is counted there: 2^-30 to 2^-24, 2^40 to 2^45.
        const std::uint32_t expected = bin == 0 ? 7u : bin == 255 ? 6u : bin % 4 == 0 ? 1u : 0u;
        EXPECT_EQ(measured.pixels[static_cast<std::size_t>(bin)], expected) << bin;
    }
}

TEST_F(DepthSamplerTest, CountsNothingInASky) {
    shadow::CameraRecord record;
    record.unproject = {0.0f, 1.0f, kWidth, kHeight};
    const SampledDepths measured = counted(std::vector<float>(std::size_t{kWidth} * kHeight, 0.0f), record);
    EXPECT_THAT(measured.pixels, ::testing::Each(0u));
    EXPECT_EQ(measured.camera, kCamera);
}

class SampledPicture : public BoxTest {};

TEST_F(SampledPicture, CountsAsManyPixelsAsShowSurfacesAndWhereTheyStand) {
    settings.repeatable = true;
    add_box({-1.0, -1.0, -9.0}, {1.0, 1.0, -8.0});
    add_box({-300.0, -300.0, -101.0}, {300.0, 300.0, -100.0});
    add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, {-0.5, -1.0, -0.3}, {.resolution_px = 256},
              {.cascades = {.splits = CascadeSplits::sampled}});
    add_camera({.fov_y_rad = 0.9f, .near_m = 0.1}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    draw();
    EXPECT_EQ(frame().feedback().sampled_depths.camera, ecs::kNull);
    draw();
    const SampledDepths& depths = frame().feedback().sampled_depths;
    EXPECT_EQ(depths.camera, frame().snapshot().consumers.front().entity);
    const std::uint32_t at_8m = depths.pixels[96 + 12], at_100m = depths.pixels[96 + 26];  // 4 log2: 12; 26.6
    EXPECT_GT(at_8m, 1000u);
    EXPECT_GT(at_100m, 10 * at_8m);
    EXPECT_EQ(at_8m + at_100m, settings.viewport_px.x * settings.viewport_px.y);
}

}  // namespace
}  // namespace gnomon
