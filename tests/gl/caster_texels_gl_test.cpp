#include <bit>
#include <random>

#include "shaders/bindings.h"
#include "systems/extract/gpu_scene.h"
#include "tests/gl/probe_fixture.h"
#include "tests/unit/math/random_seed.h"

// The C++ and the GLSL views of casters and instances agree. They are read as texels, which no interface of a program
// describes.
namespace gnomon {
namespace {

constexpr std::uint32_t kRecords = 5;
constexpr std::size_t kWords =
    (sizeof(CasterTriangle) + sizeof(InstanceRecord) + sizeof(glm::vec4)) / sizeof(std::uint32_t);

const std::string kProbe =
    "#include \"common/instances.glsl\"\n#include \"shadow/filters/triangles/triangle_buffer.glsl\"\n"
    "#include \"common/camera_block.glsl\"\n#include \"lighting/gbuffer/triangle_normals.glsl\"\n"
    R"(layout(local_size_x = 1) in;
layout(std430, binding = 1) buffer Out { uint words[]; };
void write(uint at, vec3 v, uint n) {
    for (int i = 0; i < 3; ++i) words[at + uint(i)] = floatBitsToUint(v[i]);
    words[at + 3u] = n;
}
void write(uint at, vec4 v) { write(at, v.xyz, floatBitsToUint(v.w)); }
void main() {
    uint i = gl_WorkGroupID.x, at = 32u * i;
    CasterTriangle t = caster_triangle(i);
    write(at, t.a, t.across_ab);
    write(at + 4u, t.b, t.across_bc);
    write(at + 8u, t.c, t.across_ca);
    InstanceRecord instance = instance_record(i);
    write(at + 12u, instance.basis_x);
    write(at + 16u, instance.basis_y);
    write(at + 20u, instance.basis_z);
    write(at + 24u, instance.low);
    write(at + 28u, triangle_normal(i));
}
)";

using CasterTexels = ProbeTest;

TEST_F(CasterTexels, ShadersReadWhatWasWritten) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<float> place(-100.0f, 100.0f);
    const auto number = [&] { return static_cast<std::uint32_t>(random()); };
    std::vector<CasterTriangle> triangles(kRecords);
    std::vector<InstanceRecord> instances(kRecords);
    std::vector<glm::vec4> normals(kRecords);
    std::vector<std::uint32_t> written;
    const auto append = [&](const float* v, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) written.push_back(std::bit_cast<std::uint32_t>(v[i]));
    };
    for (std::uint32_t i = 0; i < kRecords; ++i) {
        for (CasterTriangle::Corner& corner : triangles[i].corners) {
            corner = {{place(random), place(random), place(random)}, number()};
            append(&corner.position_ms.x, 3);
            written.push_back(corner.across);
        }
        InstanceRecord& r = instances[i];
        for (float* row : {r.basis_x_high_x, r.basis_y_high_y, r.basis_z_high_z, r.low_layers}) {
            for (int c = 0; c < 4; ++c) row[c] = place(random);
            append(row, 4);
        }
        normals[i] = {place(random), place(random), place(random), place(random)};
        append(&normals[i].x, 4);
    }
    ASSERT_EQ(written.size(), kRecords * kWords);

    gl::CommandList list;
    list.add(gl::BindTexels{9, texels_of(triangles)});
    list.add(gl::BindTexels{bindings::kInstanceUnit, texels_of(instances)});
    list.add(gl::BindTexels{bindings::kTriangleNormalUnit, texels_of(normals)});
    EXPECT_EQ(probed<std::uint32_t>(kProbe, kRecords, written.size(), std::move(list)), written);
}

}  // namespace
}  // namespace gnomon
