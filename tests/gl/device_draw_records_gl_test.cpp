#include <gmock/gmock.h>

#include "tests/gl/device_meshes_fixture.h"

// Draws that one command makes, by records of a buffer.
namespace gnomon {
namespace {

TEST_F(DeviceMeshes, DrawsByRecordsAreThoseDrawsInTheirOrder) {
    // {cell, value}; cells 2 and 5 are drawn twice, and no depth is tested: the later draw stays.
    const auto items =
        fixed_buffer(std::vector<std::array<std::uint32_t, 2>>{{0, 11}, {2, 22}, {5, 33}, {5, 44}, {2, 55}, {7, 66}});
    const auto records = keep(device().create_buffer({.label = "records", .size = 4 * sizeof(gl::MeshDrawRecord)}, {}));
    const std::array<gl::MeshDrawRecord, 4> values{
        {{6, 1, 3, 1, 0}, {6, 2, 3, 1, 1}, {6, 1, 3, 1, 3}, {3, 1, 3, 1, 4}}};
    const auto drawn = [&](bool by_records) {
        gl::CommandList list;
        list.update(records, 0, std::span<const gl::MeshDrawRecord>{values});
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindMeshes{vertices, indices, items});
        const gl::DrawMeshesIndirect many{records, 1, 3, 9, 5};
        std::vector<gl::DrawMeshes> singles;
        gl::append_mesh_draws(list, list.commands.emplace_back(many), singles);
        EXPECT_EQ(singles.size(), 3u);
        if (!by_records) list.commands.pop_back();
        for (const gl::DrawMeshes& draw : singles)
            if (!by_records) list.add(draw);
        list.add(gl::EndPass{});
        run(list);
        return pixels();
    };
    const auto image = drawn(true);
    EXPECT_EQ(image, drawn(false));
    const std::array<int, 8> wanted{0, 0, 55, 0, 0, 44, 0, 0};
    for (std::uint32_t cell = 0; cell < 8; ++cell) EXPECT_EQ(at(image, cell * 2, 0)[0], wanted[cell]) << cell;
}

TEST_F(DeviceMeshes, DrawsByRecordsBeyondTheBuffersAreLeftOut) {
    const auto items = fixed_buffer(std::vector<std::array<std::uint32_t, 2>>{{0, 255}});
    const auto records = keep(device().create_buffer({.label = "records", .size = sizeof(gl::MeshDrawRecord)}, {}));
    const auto fixed = fixed_buffer(std::vector<gl::MeshDrawRecord>{{6, 1, 3, 1, 0}});
    const std::array<gl::MeshDrawRecord, 1> values{{{6, 1, 3, 1, 0}}};
    const auto drawn = [&](const gl::DrawMeshesIndirect& draw) {
        gl::CommandList list;
        list.update(records, 0, std::span<const gl::MeshDrawRecord>{values});
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindMeshes{vertices, indices, items});
        list.add(draw);
        list.add(gl::EndPass{});
        const gl::Failure failure = device().submit(list).failure;
        EXPECT_EQ(at(pixels(), 0, 0)[0] == 255, failure == gl::Failure::none);
        return failure;
    };
    EXPECT_EQ(drawn({records, 0, 1, 9, 1}), gl::Failure::none);
    EXPECT_EQ(drawn({records, 0, 2, 9, 1}), gl::Failure::invalid_value) << "records";
    EXPECT_EQ(drawn({records, 1, 1, 9, 1}), gl::Failure::invalid_value) << "records";
    EXPECT_EQ(drawn({records, 0, 1, 10, 1}), gl::Failure::invalid_value) << "indices";
    EXPECT_EQ(drawn({records, 0, 1, 9, 2}), gl::Failure::invalid_value) << "items";
    EXPECT_EQ(drawn({fixed, 0, 1, 9, 1}), gl::Failure::invalid_value) << "what a fixed buffer has was never checked";
    EXPECT_EQ(drawn({{}, 0, 1, 9, 1}), gl::Failure::invalid_value) << "no buffer";
}

}  // namespace
}  // namespace gnomon
