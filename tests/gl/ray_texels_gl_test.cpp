#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <random>

#include "engine/rays/bvh.h"
#include "engine/rays/mesh_bvh.h"
#include "systems/visibility/ray_records.h"
#include "tests/gl/probe_fixture.h"
#include "tests/unit/math/random_seed.h"

// The C++ and the GLSL views of what is read as texels: no interface of a program describes them. Shaders find in each
// member what C++ wrote into it.
namespace gnomon {
namespace {

using rays::BvhNode;
using rays::BvhTriangle;
using visibility::RayInstance;
using visibility::RayTop;

constexpr std::uint32_t kTexelRecords = 5;
/// Words of 32 bits, as the probe writes them. They are of a node, a triangle, the upper tree's head, a node of it and
/// a part of an instance.
constexpr std::size_t kTexelWords = 8 + 12 + 8 + 8 + 17;

const std::string kTexelProbe =
    "#include \"ray_tracing/bvh_buffers.glsl\"\n"
    R"(layout(local_size_x = 1) in;
layout(std430, binding = 1) buffer Out { uint words[]; };
void write(uint at, vec3 v, uint n) {
    for (int i = 0; i < 3; ++i) words[at + uint(i)] = floatBitsToUint(v[i]);
    words[at + 3u] = n;
}
void main() {
    uint i = gl_WorkGroupID.x, at = 53u * i;
    RayNode node = ray_node(i);
    write(at, node.low, node.skip);
    write(at + 4u, node.high, node.leaf);
    RayTriangle t = ray_triangle(i);
    write(at + 8u, t.a, t.triangle);
    write(at + 12u, t.b, t.mask);
    write(at + 16u, t.c, t.uvs);
    RayTop head = ray_top();
    write(at + 20u, head.anchor_high, head.nodes);
    write(at + 24u, head.anchor_low, floatBitsToUint(head.reach_m));
    RayNode top = ray_top_node(i);
    write(at + 28u, top.low, top.skip);
    write(at + 32u, top.high, top.leaf);
    RayInstance part = ray_instance(i);
    write(at + 36u, part.to_model_x, part.first_node);
    write(at + 40u, part.to_model_y, part.end_node);
    write(at + 44u, part.to_model_z, part.first_slot);
    words[at + 48u] = floatBitsToUint(part.slack_per_m);
    words[at + 49u] = floatBitsToUint(part.reach_m);
    words[at + 50u] = part.instance;
    words[at + 51u] = part.layers;
    words[at + 52u] = part.begin_node;
}
)";

void append(std::vector<std::uint32_t>& words, const glm::vec3& v, std::uint32_t n) {
    for (int i = 0; i < 3; ++i) words.push_back(std::bit_cast<std::uint32_t>(v[i]));
    words.push_back(n);
}

class RayTexels : public ProbeTest {
protected:
    struct Texels {
        gl::BufferHandle nodes, triangles, upper, parts;
    };
    std::vector<std::uint32_t> read_by_shader(const Texels& texels) {
        gl::CommandList list;
        list.add(gl::BindTexels{10, texels.nodes});
        list.add(gl::BindTexels{11, texels.triangles});
        list.add(gl::BindTexels{12, texels.upper});
        list.add(gl::BindTexels{13, texels.parts});
        return probed<std::uint32_t>(kTexelProbe, kTexelRecords, kTexelRecords * kTexelWords, std::move(list));
    }
};

TEST_F(RayTexels, ShadersReadWhatWasWritten) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<float> place(-100.0f, 100.0f);
    const auto any = [&] { return glm::vec3(place(random), place(random), place(random)); };
    const auto number = [&] { return static_cast<std::uint32_t>(random()); };
    std::vector<BvhNode> nodes;
    std::vector<BvhTriangle> triangles;
    // The upper tree: its head, as long as a node, and nodes.
    const RayTop head{any(), number(), any(), place(random)};
    std::vector<BvhNode> upper{std::bit_cast<BvhNode>(head)};
    std::vector<RayInstance> parts;
    std::vector<std::uint32_t> written;
    for (std::uint32_t i = 0; i < kTexelRecords; ++i) {
        const BvhNode& node = nodes.emplace_back(BvhNode{any(), number(), any(), number()});
        append(written, node.min, node.skip);
        append(written, node.max, node.leaf);
        const BvhTriangle& t =
            triangles.emplace_back(BvhTriangle{any(), number(), any(), rays::kOpaque, any(), number()});
        append(written, t.a, t.triangle);
        append(written, t.b, t.mask);
        append(written, t.c, t.spare);
        append(written, head.anchor_high, head.nodes);
        append(written, head.anchor_low, std::bit_cast<std::uint32_t>(head.reach_m));
        const BvhNode& top = upper.emplace_back(BvhNode{any(), number(), any(), number()});
        append(written, top.min, top.skip);
        append(written, top.max, top.leaf);
        const RayInstance& part =
            parts.emplace_back(RayInstance{any(), number(), any(), number(), any(), number(), place(random),
                                           place(random), number(), number(), number()});
        append(written, part.to_model_x, part.first_node);
        append(written, part.to_model_y, part.end_node);
        append(written, part.to_model_z, part.first_slot);
        for (const float v : {part.slack_per_m, part.reach_m}) written.push_back(std::bit_cast<std::uint32_t>(v));
        for (const std::uint32_t n : {part.instance, part.layers, part.begin_node}) written.push_back(n);
    }
    const Texels texels{texels_of(nodes), texels_of(triangles), texels_of(upper), texels_of(parts)};
    EXPECT_EQ(read_by_shader(texels), written);

    // A list writes to such a buffer as to any other, and what is read is what was written last.
    std::swap(nodes.front(), nodes.back());
    std::swap_ranges(written.begin(), written.begin() + 8, written.end() - kTexelWords);
    gl::CommandList list;
    list.update(texels.nodes, 0, std::span<const BvhNode>(nodes));
    run(list);
    EXPECT_EQ(read_by_shader(texels), written);
}

TEST_F(RayTexels, MoreThanTheDeviceCanAddressAreRefusedAndNothingIsLeft) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    const std::size_t live = gl::live_objects(device());
    const std::uint64_t over = (static_cast<std::uint64_t>(most) + 1) * gl::kTexelBytes;
    const auto made = device().create_buffer({.label = "far too many", .size = over, .texels = true}, {});
    EXPECT_EQ(made.failure, gl::Failure::out_of_memory);
    EXPECT_THAT(made.log, ::testing::HasSubstr("far too many"));
    EXPECT_EQ(device().create_buffer({.size = 24, .texels = true}, {}).failure, gl::Failure::invalid_value);
    EXPECT_EQ(gl::live_objects(device()), live);
    take_messages();
}

}  // namespace
}  // namespace gnomon
