#include <array>
#include <span>
#include <vector>

#include "tests/unit/gl/recording_fixture.h"

// Draws that one command makes, by records of a buffer.
namespace gnomon::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using DrawRecords = RecordingTest;

TEST_F(DrawRecords, StayInTheirBuffers) {
    const BufferHandle records =
        device.create_buffer({.label = "records", .size = 2 * sizeof(MeshDrawRecord)}, {}).handle;
    const auto drawn = [&](const std::array<MeshDrawRecord, 2>& values, const DrawMeshesIndirect& draw) {
        CommandList list;
        list.update(records, 0, std::span<const MeshDrawRecord>(values));
        begin(list);
        pipeline(list);
        meshes(list);
        list.add(draw);
        list.add(EndPass{});
        return misuses_of(list);
    };
    const std::array right{MeshDrawRecord{3, 2, 0, 0, 0}, MeshDrawRecord{3, 1, 3, 0, 1}};
    EXPECT_THAT(drawn(right, {records, 0, 2, 6, 2}), IsEmpty());
    EXPECT_THAT(drawn(right, {records, 1, 1, 6, 2}), IsEmpty());
    EXPECT_THAT(drawn(right, {records, 1, 2, 6, 2}), ElementsAre(Misuse::draw_out_of_range)) << "no third record";
    EXPECT_THAT(drawn(right, {records, 0, 2, 5, 2}), ElementsAre(Misuse::draw_out_of_range)) << "beyond end_index";
    EXPECT_THAT(drawn(right, {records, 0, 2, 6, 1}), ElementsAre(Misuse::draw_out_of_range)) << "beyond end_item";
    EXPECT_THAT(drawn(right, {{999}, 0, 2, 6, 2}), ElementsAre(Misuse::unknown_handle));
    EXPECT_THAT(drawn(right, {indices, 0, 1, 6, 2}), ElementsAre(Misuse::draw_out_of_range)) << "never updated";
    std::array wrong = right;
    wrong[1].first_index = 4;
    EXPECT_THAT(drawn(wrong, {records, 0, 2, 7, 2}), ElementsAre(Misuse::draw_out_of_range)) << "indices";
    wrong = right;
    wrong[1].item_count = 2;
    EXPECT_THAT(drawn(wrong, {records, 0, 2, 6, 3}), ElementsAre(Misuse::draw_out_of_range)) << "items";
    wrong = right;
    wrong[1].base_vertex = 2;
    EXPECT_THAT(drawn(wrong, {records, 0, 2, 6, 2}), ElementsAre(Misuse::draw_out_of_range)) << "vertices";
    CommandList without_meshes;
    begin(without_meshes);
    pipeline(without_meshes);
    without_meshes.add(DrawMeshesIndirect{records, 0, 1, 6, 2});
    without_meshes.add(EndPass{});
    EXPECT_THAT(misuses_of(without_meshes), ElementsAre(Misuse::draw_without_meshes));
}

TEST(MeshDraws, ComeFromWhatTheListUploadedLast) {
    const BufferHandle records{5};
    const std::array first{MeshDrawRecord{3, 1, 0, 0, 0}, MeshDrawRecord{6, 2, 3, -4, 1}};
    const std::array second{MeshDrawRecord{9, 4, 12, 7, 3}};
    CommandList list;
    list.update(records, 0, std::span<const MeshDrawRecord>(first));
    list.update(BufferHandle{6}, 0, std::span<const MeshDrawRecord>(second));
    list.add(DrawMeshesIndirect{records, 0, 2, 9, 3});
    list.add(DrawMeshesIndirect{records, 1, 1, 9, 3});
    list.add(DrawMeshes{1, 2, 3, 4, 5});
    list.add(DrawTriangle{});
    list.add(DrawMeshesIndirect{records, 1, 2, 9, 3});  // beyond what was uploaded
    list.update(records, sizeof(MeshDrawRecord), std::span<const MeshDrawRecord>(second));
    list.add(DrawMeshesIndirect{records, 1, 1, 21, 7});
    std::vector<DrawMeshes> draws;
    for (const Command& command : list.commands) append_mesh_draws(list, command, draws);
    EXPECT_THAT(draws, ElementsAre(DrawMeshes{0, 3, 0, 0, 1}, DrawMeshes{3, 6, -4, 1, 2}, DrawMeshes{3, 6, -4, 1, 2},
                                   DrawMeshes{1, 2, 3, 4, 5}, DrawMeshes{12, 9, 7, 3, 4}));
}

}  // namespace
}  // namespace gnomon::gl
