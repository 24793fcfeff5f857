#include <array>
#include <set>

#include "engine/gl/gl45_shared_layers.h"
#include "tests/gl/gl_test_context.h"

/// Textures that are layers of shared arrays: each behaves as one of its own.
namespace gnomon {
namespace {

class SharedLayers : public GlTest {
protected:
    static constexpr std::uint32_t kEdge_px = 256;
    gl::TextureDesc desc(gl::TextureKind kind, std::uint32_t layers, std::uint32_t edge_px = kEdge_px) {
        return {.label = "shared", .kind = kind, .format = gl::Format::d32f, .width = edge_px, .height = edge_px, .layers = layers, .shared = true};
    }
    gl::TextureHandle make(gl::TextureKind kind, std::uint32_t layers, std::uint32_t edge_px = kEdge_px) {
        const auto made = device().create_texture(desc(kind, layers, edge_px), {});
        EXPECT_TRUE(made) << made.log;
        return made.handle;
    }
    /// Clears each layer to another depth, from `first` on in steps of 1/64.
    void fill(gl::TextureHandle texture, std::uint32_t layers, std::uint32_t first) {
        std::vector<gl::TargetHandle> targets;
        gl::CommandList list;
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            targets.push_back(device().create_target({"layer", {}, {texture, static_cast<std::int32_t>(layer)}}).handle);
            list.add(gl::BeginPass{.target = targets.back(), .viewport = {0, 0, 1, 1}, .clear_depth = true, .depth = static_cast<float>(first + layer) / 64.0f});
            list.add(gl::EndPass{});
        }
        run(list);
        for (const gl::TargetHandle target : targets) device().destroy(target);
    }
    float depth_of(gl::TextureHandle texture, std::uint32_t layer) {
        return read<float>(texture, std::size_t{kEdge_px} * kEdge_px, layer)[77] * 64.0f;
    }
};

TEST_F(SharedLayers, AreTheTexturesOwnAndTheArraysAlike) {
    const auto sun = make(gl::TextureKind::array, 4), lamp = make(gl::TextureKind::cube, 1), spot = make(gl::TextureKind::array, 1);
    const auto a = device().shared_layers(sun), b = device().shared_layers(lamp), c = device().shared_layers(spot);
    EXPECT_TRUE(a.array == b.array && b.array == c.array && a.array);
    EXPECT_EQ((std::array{a.first, b.first, c.first, a.width}), (std::array{0u, 4u, 10u, kEdge_px}));
    fill(spot, 1, 1);
    fill(lamp, 6, 10);
    fill(sun, 4, 20);
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(depth_of(lamp, i), static_cast<float>(10 + i));
        EXPECT_EQ(depth_of(a.array, b.first + i), static_cast<float>(10 + i)) << "a face is a layer, in OpenGL's order";
    }
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(depth_of(sun, i), static_cast<float>(20 + i));
    EXPECT_EQ(depth_of(spot, 0), 1.0f);
    // What is freed serves the next that fits; the others keep what they hold.
    device().destroy(lamp);
    const auto next = make(gl::TextureKind::array, 3), large = make(gl::TextureKind::array, 4);
    EXPECT_EQ(device().shared_layers(next).first, 4u);
    EXPECT_EQ(device().shared_layers(large).first, 11u);
    EXPECT_EQ(depth_of(spot, 0), 1.0f);
    EXPECT_EQ(depth_of(sun, 3), 23.0f);
    for (const auto texture : {sun, spot, next}) device().destroy(texture);
    EXPECT_EQ(gl::live_objects(device()), 2u) << "the last texture and its array";
    device().destroy(large);
    EXPECT_EQ(gl::live_objects(device()), 0u);
}

TEST_F(SharedLayers, OfOtherSizesFormatsOrWithoutRoomLieInOtherArrays) {
    const auto small = make(gl::TextureKind::array, 1), wide = make(gl::TextureKind::array, 2, 4096), second = make(gl::TextureKind::array, 1, 4096);
    gl::TextureDesc ids = desc(gl::TextureKind::array, 1);
    ids.format = gl::Format::rg32ui;
    const auto shown = device().create_texture(ids, {}).handle;
    const auto own = device().create_texture({.label = "own", .kind = gl::TextureKind::array, .format = gl::Format::d32f, .width = kEdge_px, .height = kEdge_px}, {}).handle;
    std::set<std::uint32_t> arrays;
    for (const auto texture : {small, wide, second, shown}) arrays.insert(device().shared_layers(texture).array.id);
    EXPECT_EQ(arrays.size(), 4u);
    EXPECT_FALSE(device().shared_layers(own).array);
    EXPECT_FALSE(device().shared_layers({}).array);
    for (const auto texture : {small, wide, second, shown, own}) device().destroy(texture);
}

TEST_F(SharedLayers, ThatCannotBeAreRefused) {
    gl::TextureDesc flat = desc(gl::TextureKind::flat, 1), mips = desc(gl::TextureKind::array, 1);
    mips.mips = 2;
    const std::vector<std::byte> pixels(std::size_t{kEdge_px} * kEdge_px * 4);
    EXPECT_EQ(device().create_texture(flat, {}).failure, gl::Failure::invalid_value);
    EXPECT_EQ(device().create_texture(mips, {}).failure, gl::Failure::invalid_value);
    EXPECT_EQ(device().create_texture(desc(gl::TextureKind::array, 1), pixels).failure, gl::Failure::invalid_value);
    EXPECT_EQ(gl::live_objects(device()), 0u);
}

TEST_F(SharedLayers, GrowBySizeAndBySteps) {
    const auto layers = [&](std::uint32_t edge_px, std::uint32_t count, std::uint32_t others) {
        return gl::shared_array_layers(desc(gl::TextureKind::array, count, edge_px), others, 2048);
    };
    EXPECT_EQ(layers(256, 1, 0), 256u);
    EXPECT_EQ(layers(2048, 1, 0), 4u);
    EXPECT_EQ(layers(8192, 3, 0), 3u) << "at least what is asked for";
    EXPECT_EQ(layers(256, 1, 256), 512u) << "twice the one that is full";
    EXPECT_EQ(layers(256, 1, 2048), 2048u) << "at most what the device has";
    const gl::SharedArray array{1, {true, false, false, true, false, false, false}};
    EXPECT_EQ(gl::find_layers(array, 2), 1u);
    EXPECT_EQ(gl::find_layers(array, 3), 4u);
    EXPECT_EQ(gl::find_layers(array, 4), 7u) << "none";
}

}  // namespace
}  // namespace gnomon
