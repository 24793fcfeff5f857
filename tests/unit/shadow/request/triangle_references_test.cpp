#include "systems/shadow/request/triangle_references.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {
namespace {

/// Computes what the fragment shader writes and the filters read (shaders/shadow/filters/triangles/gathered_ids.glsl).
std::uint32_t packed(std::uint32_t instance, std::uint32_t triangle, std::uint32_t bits) {
    return instance << bits | (triangle & ((1u << bits) - 1u));
}

/// Returns a number above 0, of any length alike.
std::uint32_t up_to_31_bits(std::mt19937& random) {
    const int shift = std::uniform_int_distribution<int>(1, 31)(random);
    return 1 + static_cast<std::uint32_t>(random() >> shift);
}

TEST(TriangleReferences, HoldEveryTriangleOfEveryInstance) {
    std::mt19937 random(3);
    std::size_t short_ones = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::uint32_t instances = up_to_31_bits(random), triangles = up_to_31_bits(random);
        const TriangleReferences chosen = choose_references(instances, triangles, {});
        if (chosen == TriangleReferences{}) continue;
        ++short_ones;
        const std::uint32_t bits = chosen.triangle_bits, none = (1u << bits) - 1u;
        ASSERT_GT(bits, 0u);
        ASSERT_EQ(chosen.format(), gl::Format::r32ui);
        ASSERT_LT(triangles - 1, none) << "the last triangle is not taken for none";
        ASSERT_EQ(static_cast<std::uint32_t>(static_cast<float>(none)), none) << "a clear holds it";
        const std::uint32_t last = packed(instances - 1, triangles - 1, bits);
        ASSERT_EQ(last >> bits, instances - 1);
        ASSERT_EQ(last & none, triangles - 1);
    }
    EXPECT_GT(short_ones, 5000u);
}

TEST(TriangleReferences, AreTwoNumbersWhereOneHasNoRoom) {
    EXPECT_EQ(choose_references(1u << 20, 1u << 20, {}), TriangleReferences{});
    EXPECT_EQ(choose_references(1, 1u << 24, {}), TriangleReferences{}) << "a clear's float has no more bits";
    EXPECT_EQ(choose_references(105'156, 6000, {}).format(), gl::Format::r32ui) << "a city";
    EXPECT_EQ(choose_references(0, 0, {}).format(), gl::Format::r32ui);
    EXPECT_EQ(choose_references(~0u, ~0u, {}), TriangleReferences{});
}

TEST(TriangleReferences, StayWhileTheyHaveRoom) {
    const TriangleReferences few = choose_references(100, 1000, {});
    EXPECT_EQ(choose_references(1, 1, few), few);
    EXPECT_EQ(choose_references(1000, 10'000, few), few) << "there is room to grow on both sides";
    const TriangleReferences more = choose_references(1u << 18, 1u << 10, few);
    EXPECT_NE(more, few);
    EXPECT_EQ(more.format(), gl::Format::r32ui) << "the bits are shared out again";
    const TriangleReferences two = choose_references(1u << 20, 1u << 14, more);
    EXPECT_EQ(two, TriangleReferences{});
    EXPECT_EQ(choose_references(1u << 18, 1u << 12, two), two) << "31 bits come and go";
    EXPECT_EQ(choose_references(1u << 17, 1u << 12, two).format(), gl::Format::r32ui);
}

TEST(TriangleReferences, TakeAThirdOfAMapsBytes) {
    LightItem light;
    light.kind = LightKind::spot;
    ShadowRequest request;
    request.map.filter = ShadowFilter::triangles;
    request.map.view_count = 1;
    set_resolution(light, 512, request);
    const std::uint64_t two = map_bytes(light, request);
    request.map.references = choose_references(100, 1000, {});
    EXPECT_EQ(3 * map_bytes(light, request), 2 * two);
    for (const ShadowFilter other : {ShadowFilter::hard, ShadowFilter::exact, ShadowFilter::vsm}) {
        request.map.filter = other;
        set_resolution(light, 512, request);
        const std::uint64_t with = map_bytes(light, request);
        request.map.references = {};
        EXPECT_EQ(map_bytes(light, request), with) << "only maps that are read for triangles change";
        request.map.references = choose_references(100, 1000, {});
    }
}

}  // namespace
}  // namespace gnomon::shadow
