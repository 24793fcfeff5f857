#include <gmock/gmock.h>

#include "tests/system/scene_contents.h"
#include "tests/system/streamed_meshes.h"
#include "tests/unit/math/random_seed.h"

/// Meshes that come and go on the device (GpuScene): bytes, places, failures.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class StreamingScene : public ::testing::Test {
protected:
    void SetUp() override { start(); }
    void TearDown() override {
        gpu.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    void start() {
        auto made = GpuScene::create(device, library);
        ASSERT_TRUE(made) << to_line(made.error());
        gpu.emplace(std::move(made).value());
    }
    /// Follows the library as a frame does. The list stays to be looked at.
    void follow(bool executed = true) {
        list.clear();
        gpu->update_meshes(list);
        if (executed) device.submit(list);
        gpu->submitted(executed);
    }
    std::uint32_t add(assets::Mesh mesh) {
        const std::uint32_t m = library.add(std::move(mesh));
        follow();
        return m;
    }
    glm::vec4 colour_of(std::uint32_t material) const {
        glm::vec4 colour(-1.0f);
        std::memcpy(&colour, device.buffer_bytes(gpu->material_uniforms()).data() + gpu->material(material).uniform_offset, sizeof colour);
        return colour;
    }
    std::uint64_t uploaded_bytes() const {
        std::uint64_t bytes = 0;
        for (const gl::Command& c : list.commands)
            if (const auto* update = std::get_if<gl::UpdateBuffer>(&c)) bytes += update->size;
        return bytes;
    }

    gl::RecordingDevice device;
    assets::MeshLibrary library = test_library();
    std::optional<GpuScene> gpu;
    gl::CommandList list;
};

TEST_F(StreamingScene, ALibraryThatStaysIsFixedAndRecordsNothing) {
    ASSERT_TRUE(gpu->provide_caster_triangles());
    follow();
    EXPECT_THAT(list.commands, IsEmpty());
    for (const gl::BufferHandle buffer : {gpu->vertices(), gpu->indices(), gpu->triangle_normals(), gpu->caster_triangles(), gpu->caster_masks(), gpu->material_uniforms()})
        EXPECT_EQ(device.buffer(buffer)->use, gl::BufferUse::fixed);
    EXPECT_EQ(device.buffer(gpu->vertices())->size, gpu->used_vertices() * sizeof(assets::Vertex));
    EXPECT_EQ(expect_contents(device, *gpu), library.meshes.size());
}

TEST_F(StreamingScene, AnAddedMeshUploadsItsOwnBytesAndNoOthers) {
    add(scaled_mesh(kBox, 2.0f));  // the first one makes buffers that grow
    EXPECT_EQ(expect_contents(device, *gpu), 7u);
    const assets::Mesh mesh = strip_mesh(3, 0.5f, 1, false);
    const std::size_t calls = device.calls();
    const std::uint32_t m = add(mesh);
    EXPECT_EQ(device.calls() - calls, 1u) << "the submission; it fits";
    gl::CommandList right;
    const GpuScene::MeshRange& range = gpu->mesh(m);
    std::vector<glm::vec4> normals;
    append_plane_normals(mesh.vertices, mesh.indices, normals);
    right.update(gpu->vertices(), static_cast<std::uint64_t>(range.base_vertex) * 32, std::span<const assets::Vertex>(mesh.vertices));
    right.update(gpu->indices(), std::uint64_t{range.first_index} * 4, std::span<const std::uint32_t>(mesh.indices));
    right.update(gpu->triangle_normals(), std::uint64_t{range.first_index} / 3 * 16, std::span<const glm::vec4>(normals));
    EXPECT_EQ(list, right) << gl::to_text(list);
    EXPECT_EQ(uploaded_bytes(), 12u * 32 + 6 * (12 + 16));
    EXPECT_EQ(expect_contents(device, *gpu), 8u);
    library.remove(m);
    follow();
    EXPECT_THAT(list.commands, IsEmpty());
    EXPECT_EQ(gpu->mesh(m).submesh_count, 0u);
}

TEST_F(StreamingScene, AMeshInAnEnginesBuffersMayTakeTheSlotOfAnother) {
    const std::uint32_t placed = gpu->used_triangles();
    const std::uint32_t m = add(scaled_mesh(kBox, 2.0f));
    library.remove(m);
    ASSERT_EQ(library.add({}), m);  // before the scene sees that the other one went
    const gl::BufferHandle engines = device.create_buffer({.label = "engine's", .size = 36}, {}).handle;
    gpu->put_engine_mesh(m, {.vertices = engines, .indices = engines, .layout = {.stride = 12}, .index_count = 9});
    follow();
    ASSERT_NE(gpu->engine_mesh(m), nullptr);
    EXPECT_EQ(gpu->mesh(m).triangles, 3u);
    EXPECT_GT(gpu->mesh(m).most_reflected, 0.0f);
    EXPECT_EQ(gpu->used_triangles(), placed) << "it has no places";
    gpu->put_engine_mesh(m, {});
    library.replace(m, scaled_mesh(kBox, 3.0f));
    follow();
    EXPECT_EQ(gpu->engine_mesh(m), nullptr);
    EXPECT_EQ(expect_contents(device, *gpu), 7u);
    device.destroy(engines);
}

TEST_F(StreamingScene, GrowthCopiesOnTheDeviceAndUploadsNothingAgain) {
    add(scaled_mesh(kBox, 2.0f));
    const std::uint32_t places = gpu->used_vertices();
    const assets::Mesh large = strip_mesh(100, 0.1f, 0, false);
    const std::uint32_t m = add(large);
    EXPECT_EQ(uploaded_bytes(), 400u * 32 + 200 * (12 + 16));
    std::vector<gl::Command> copies = list.commands;
    std::erase_if(copies, [](const gl::Command& c) { return !std::holds_alternative<gl::CopyBuffer>(c); });
    EXPECT_EQ(copies.size(), 3u);
    EXPECT_EQ(static_cast<std::uint32_t>(gpu->mesh(m).base_vertex), places);
    EXPECT_EQ(expect_contents(device, *gpu), 8u);
    library.remove(m);
    follow();
    const std::size_t calls = device.calls();
    EXPECT_EQ(library.add(large), m) << "its slot";
    follow();
    EXPECT_EQ(device.calls() - calls, 1u) << "and its places";
    EXPECT_EQ(static_cast<std::uint32_t>(gpu->mesh(m).base_vertex), places);
}

TEST_F(StreamingScene, ManyAtOnceGrowOnce) {
    for (int i = 0; i < 500; ++i) library.add(strip_mesh(1 + static_cast<std::uint32_t>(i % 7), 0.1f, 0, false));
    const std::size_t calls = device.calls();
    follow();
    EXPECT_EQ(device.calls() - calls, 4u) << "three buffers and a submission";
    EXPECT_EQ(expect_contents(device, *gpu), 506u);
}

TEST_F(StreamingScene, CasterTrianglesAndMasksFollow) {
    ASSERT_TRUE(gpu->provide_caster_triangles());
    const std::uint32_t masked = add(strip_mesh(5, 0.5f, 1, true));
    ASSERT_TRUE(gpu->caster_triangles()) << "what lights read stays provided";
    EXPECT_TRUE(gpu->colours());
    EXPECT_EQ(expect_contents(device, *gpu), 7u);
    add(strip_mesh(70, 0.5f, 1, false));
    const std::uint32_t last = add(strip_mesh(9, 0.5f, 1, true));
    EXPECT_EQ(expect_contents(device, *gpu), 9u);
    library.remove(masked);
    library.replace(last, strip_mesh(4, 0.25f, 1, true));
    follow();
    EXPECT_EQ(expect_contents(device, *gpu), 8u);
    const std::size_t calls = device.calls();
    add(strip_mesh(5, 0.75f, 1, true));
    EXPECT_EQ(device.calls() - calls, 1u) << "all of it fits where the others were";
    EXPECT_EQ(expect_contents(device, *gpu), 9u);
}

assets::Texture leaves(const char* name, std::uint8_t alpha, std::uint32_t side = 4) {
    return {.name = name, .width = side, .height = side, .rgba = std::vector<std::uint8_t>(4 * side * side, alpha)};
}

TEST_F(StreamingScene, MaterialsAndTexturesComeWithTheirMeshes) {
    ASSERT_TRUE(gpu->provide_caster_triangles());
    const auto texture = static_cast<std::int32_t>(library.add_texture(leaves("leaves", 200)));
    const std::uint32_t leaf = library.add_material({.name = "leaf", .base_colour = {1, 0.5f, 0.25f, 1}, .base_colour_texture = texture, .alpha_mode = assets::AlphaMode::mask});
    const std::uint32_t m = add(strip_mesh(3, 0.5f, leaf, false));
    EXPECT_EQ(expect_contents(device, *gpu), 7u);
    const GpuScene::MaterialInfo& info = gpu->material(gpu->submesh(gpu->mesh(m).first_submesh).material);
    EXPECT_EQ(device.texture(info.texture)->label, "texture leaves");
    EXPECT_EQ(info.alpha_mode, assets::AlphaMode::mask);
    EXPECT_EQ(colour_of(leaf), glm::vec4(1.0f, 0.5f, 0.25f, 1.0f));
    for (int i = 0; i < 100; ++i) library.add_material({.name = "one of many", .metallic = 0.5f});
    add(scaled_mesh(kBox, 1.0f));
    EXPECT_EQ(device.buffer(gpu->material_uniforms())->size, 128u * device.info().uniform_alignment);
    EXPECT_EQ(colour_of(leaf), glm::vec4(1.0f, 0.5f, 0.25f, 1.0f)) << "copied";
}

TEST_F(StreamingScene, MaterialsAndTexturesGoAndOthersTakeTheirSlots) {
    ASSERT_TRUE(gpu->provide_caster_triangles());
    std::size_t living = 0;
    for (std::uint8_t round = 1; round <= 20; ++round) {
        const std::string name = "leaves " + std::to_string(round);
        const float red = 0.01f * static_cast<float>(round);
        const std::uint32_t texture = library.add_texture(leaves(name.c_str(), round, 4 + round % 3));
        const std::uint32_t leaf = library.add_material({.name = "leaf", .base_colour = {red, 1, 1, 0.5f}, .base_colour_texture = static_cast<std::int32_t>(texture), .alpha_mode = assets::AlphaMode::mask});
        EXPECT_EQ(texture, 0u);
        EXPECT_EQ(leaf, 3u);
        const std::uint32_t plain = add(strip_mesh(2, 0.5f, leaf, false)), coloured = add(strip_mesh(2, 0.5f, leaf, true));
        EXPECT_EQ(expect_contents(device, *gpu), 8u) << "masks of this round's texture";
        EXPECT_EQ(device.texture(gpu->material(leaf).texture)->label, "texture " + name);
        EXPECT_EQ(colour_of(leaf).r, red);
        if (round == 1) living = device.live_count();
        EXPECT_EQ(device.live_count(), living);
        for (const std::uint32_t m : {plain, coloured}) library.remove(m);
        library.remove_material(leaf);
        library.remove_texture(texture);
        if (round % 2 == 0) follow();  // or all within a frame
    }
    follow();
    EXPECT_EQ(device.live_count(), living - 1) << "the texture";
}

TEST_F(StreamingScene, WithoutRoomAMeshIsLackingAndOthersStay) {
    for (const std::string label : {"scene vertices", "scene indices", "triangle normals", "vertex colours", "caster triangles", "texture late", "materials"}) {
        SCOPED_TRACE(label);
        const bool of_material = label == "texture late" || label == "materials";
        gpu.reset();
        library = test_library();
        start();
        add(scaled_mesh(kBox, 2.0f));
        ASSERT_TRUE(gpu->provide_caster_triangles());
        device.fail_label(label, gl::Failure::out_of_memory);
        const std::size_t living = device.live_count();
        library.add_texture(leaves("late", 9));
        library.add_material({.name = "late", .base_colour_texture = 0});
        const std::uint32_t m = add(strip_mesh(100, 0.1f, of_material ? 3 : 1, true));
        EXPECT_THAT(gpu->lacking_meshes(), ElementsAre(m));
        EXPECT_EQ(gpu->mesh(m).submesh_count, 0u);
        EXPECT_LE(device.live_count(), living + 2) << "at most the texture and its sampler";
        EXPECT_EQ(expect_contents(device, *gpu), 7u);
        const std::size_t calls = device.calls();
        for (std::uint64_t i = 1; i < Retry::kFrames; ++i) follow();
        EXPECT_EQ(device.calls() - calls, Retry::kFrames - 1) << "submissions alone: it is not tried in every frame";
        device.stop_failing();
        follow();
        EXPECT_THAT(gpu->lacking_meshes(), IsEmpty());
        EXPECT_EQ(expect_contents(device, *gpu), 8u);
    }
}

TEST_F(StreamingScene, PlacesThatComeFreeAreTakenAtOnce) {
    const assets::Mesh large = strip_mesh(100, 0.1f, 0, false);
    const std::uint32_t first = add(large);
    while (gpu->used_vertices() + 400 <= device.buffer(gpu->vertices())->size / 32) add(large);
    device.fail_label("scene vertices", gl::Failure::out_of_memory);
    const std::uint32_t late = add(large);
    EXPECT_THAT(gpu->lacking_meshes(), ElementsAre(late));
    library.remove(first);
    follow();
    EXPECT_THAT(gpu->lacking_meshes(), IsEmpty());
    EXPECT_GT(gpu->mesh(late).triangles, 0u);
    EXPECT_GT(expect_contents(device, *gpu), 0u);
    device.stop_failing();
}

TEST_F(StreamingScene, AListThatWasNotExecutedIsRepeated) {
    add(scaled_mesh(kBox, 2.0f));
    ASSERT_TRUE(gpu->provide_caster_triangles());
    library.add(strip_mesh(2, 0.5f, 1, true));
    follow(false);
    follow();
    EXPECT_EQ(uploaded_bytes(), 8u * (32 + 16) + 4 * (12 + 16)) << "that mesh alone; caster triangles are made anew";
    ASSERT_TRUE(gpu->provide_caster_triangles());
    EXPECT_EQ(expect_contents(device, *gpu), 8u);
    // With it copies to grown buffers were lost.
    library.add(strip_mesh(200, 0.1f, 1, true));
    library.add_material({});
    follow(false);
    follow();
    ASSERT_TRUE(gpu->provide_caster_triangles());
    EXPECT_EQ(expect_contents(device, *gpu), 9u);
    for (std::uint32_t m = 0; m < library.materials.size(); ++m) EXPECT_EQ(colour_of(m), glm::vec4(1.0f)) << m;
}

// Vertices get room and triangles none, and the list with the copies is lost: triangles are still those of the start.
TEST_F(StreamingScene, AListLostAfterHalfOfTheRoomWasMadeWritesIntoNothingFixed) {
    std::mt19937_64 random(1);
    for (std::uint64_t calls = 0; calls < 4; ++calls) {
        SCOPED_TRACE(calls);
        start();
        library.add(random_mesh(random));
        device.fail_from(device.calls() + calls, gl::Failure::out_of_memory, false);
        follow(false);
        device.stop_failing();
        for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) follow();
        gpu->provide_caster_triangles();
        EXPECT_EQ(expect_contents(device, *gpu), calls + 7);
        EXPECT_THAT(device.findings(), IsEmpty());
    }
}

TEST_F(StreamingScene, AnyHistoryLeavesWhatTheLibraryHas) {
    std::mt19937_64 random(print_seed());
    std::vector<std::uint32_t> living;
    const auto number = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
    for (int frame = 0; frame < 400; ++frame) {
        for (std::size_t i = number(4); i > 0; --i) living.push_back(library.add(random_mesh(random)));
        for (std::size_t i = number(4); i > 0 && !living.empty(); --i) {
            std::swap(living[number(living.size() - 1)], living.back());
            if (number(3) == 0) {
                library.replace(living.back(), random_mesh(random));
            } else {
                library.remove(living.back());
                living.pop_back();
            }
        }
        if (number(9) == 0) gpu->provide_caster_triangles();
        const bool lacks = number(9) == 0;
        if (lacks) device.fail_from(device.calls() + number(3), gl::Failure::out_of_memory, false);
        follow(number(9) > 0);
        device.stop_failing();
        if (frame % 10 != 9) continue;
        for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) follow();
        gpu->provide_caster_triangles();
        EXPECT_THAT(gpu->lacking_meshes(), IsEmpty());
        ASSERT_EQ(expect_contents(device, *gpu), living.size() + 6);
        if (HasFailure()) return;
    }
    std::uint32_t vertices = 0, triangles = 0;
    for (const assets::Mesh& mesh : library.meshes) {
        vertices += static_cast<std::uint32_t>(mesh.vertices.size());
        triangles += static_cast<std::uint32_t>(mesh.indices.size() / 3);
    }
    EXPECT_EQ(gpu->used_vertices(), vertices);
    EXPECT_EQ(gpu->used_triangles(), triangles);
}

}  // namespace
}  // namespace gnomon
