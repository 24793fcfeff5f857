#include <bit>

#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"

/// What a light needs if its filter reads triangles, and that no other light pays for it.
namespace gnomon {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::SizeIs;

class CasterTriangles : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    struct Bindings {
        std::vector<std::uint32_t> units, storage;
    };
    /// Returns the units and storage bindings that the list binds something to.
    Bindings bindings() const {
        Bindings found;
        for (const gl::Command& c : frame->commands().commands) {
            if (const auto* t = std::get_if<gl::BindTexture>(&c); t && t->texture) found.units.push_back(t->unit);
            if (const auto* t = std::get_if<gl::BindTexels>(&c)) found.units.push_back(t->unit);
            if (const auto* s = std::get_if<gl::BindStorage>(&c)) found.storage.push_back(s->binding);
        }
        return found;
    }
    std::vector<std::string> program_labels() const {
        std::vector<std::string> labels;
        for (const Pass& pass : depth_passes())
            for (const gl::PipelineState& state : pass.pipelines)
                labels.push_back(device.program(state.program)->label);
        return labels;
    }
    std::vector<std::string> triangle_labels() const { return map_labels(device, "caster triangles"); }
    TestWorld::Stage stage;
    static constexpr std::uint64_t kDepthBytes = 4, kTriangleBytes = 4;
};

TEST_F(CasterTriangles, LightsOfEveryOtherRowMakeBindAndDrawNothingOfThem) {
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (row.storage == shadow::FilterStorage{} && !row.moments)
            add_light(LightKind::spot, std::string(row.name), row.id);
    step();
    EXPECT_THAT(triangle_labels(), IsEmpty());
    EXPECT_THAT(bindings().units, Not(Contains(AnyOf(5u, 9u))));
    EXPECT_THAT(program_labels(), Not(Contains(::testing::HasSubstr("triangles"))));
    for (const LightReport& light : frame->report().lights)
        EXPECT_EQ(light.counts.bytes, light.counts.texels * kDepthBytes);
}

TEST_F(CasterTriangles, AreOneBufferForAllLightsThatReadThem) {
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    add_light(LightKind::directional, "sun", ShadowFilter::triangles);
    add_light(LightKind::point, "bulb", ShadowFilter::triangles);
    step();
    EXPECT_THAT(triangle_labels(), SizeIs(1));
    EXPECT_THAT(bindings().units, IsSupersetOf({5u, 9u}));
    EXPECT_THAT(program_labels(), Each(::testing::HasSubstr("triangles")));
    for (const LightReport& light : frame->report().lights) {
        EXPECT_EQ(light.state, LightState::rendered) << light.name;
        EXPECT_EQ(light.counts.bytes, light.counts.texels * (kDepthBytes + kTriangleBytes)) << light.name;
    }
    for (const Pass& pass : depth_passes())
        EXPECT_FALSE(pass.begin.clear_colour) << "what depth does not cover is not read";
    step();
    for (const LightReport& light : frame->report().lights) EXPECT_EQ(light.state, LightState::reused) << light.name;
    EXPECT_THAT(triangle_labels(), SizeIs(1));
}

TEST_F(CasterTriangles, TakeTwoNumbersATexelWhereOneIsNotWanted) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    const auto expect_parts = [&](std::uint64_t triangle_bytes) {
        const LightReport& shown = light("lamp");
        EXPECT_EQ(shown.state, LightState::rendered);
        EXPECT_EQ(shown.counts.parts.depths, shown.counts.texels * kDepthBytes);
        EXPECT_EQ(shown.counts.parts.triangles, shown.counts.texels * triangle_bytes);
        EXPECT_EQ(shown.counts.bytes, shown.counts.parts.depths + shown.counts.parts.triangles);
    };
    expect_parts(kTriangleBytes);
    ShadowTuning tuning;
    tuning.maps.short_references = false;
    world.registry.emplace<ShadowTuning>(lamp, tuning);
    step();
    expect_parts(2 * kTriangleBytes);
    step();
    EXPECT_EQ(light("lamp").state, LightState::reused) << "the choice stays";
    world.registry.patch<ShadowTuning>(lamp, [](ShadowTuning& t) { t.maps.short_references = true; });
    step();
    expect_parts(kTriangleBytes);
}

TEST_F(CasterTriangles, OfALightThatReadsThemNoMoreAreFreed) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    EXPECT_THAT(map_labels(device), SizeIs(3)) << "depth, triangles, target";
    choose(lamp, ShadowFilter::hard);
    step();
    EXPECT_THAT(map_labels(device), SizeIs(2));
    EXPECT_EQ(light("lamp").counts.bytes, light("lamp").counts.texels * kDepthBytes);
    EXPECT_EQ(light("lamp").state, LightState::rendered) << "what the old map held is gone";
    choose(lamp, ShadowFilter::triangles);
    step();
    EXPECT_THAT(map_labels(device), SizeIs(3));
}

TEST_F(CasterTriangles, NameTheirInstanceAndTheFirstOfTheirDraw) {
    // The first half of the mesh is opaque and its second masked: two draws, each with a count of triangles of its own.
    const ecs::Entity mixed = world.add_mesh(kMixedBox, {1, 1, 0}, true);
    const ecs::Entity second = world.add_mesh(kMixedBox, {-1, 1, 0}, true);
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    const std::vector<Pass> drawn = depth_passes();
    ASSERT_THAT(drawn, SizeIs(1));
    gl::BufferHandle items{};
    for (const gl::Command& c : frame->commands().commands)
        if (const auto* bind = std::get_if<gl::BindMeshes>(&c);
            bind && device.buffer(bind->draw_items)->label == "shadow draw items")
            items = bind->draw_items;
    const auto bytes = device.buffer_bytes(items);
    std::vector<std::uint32_t> slots;
    for (const gl::DrawMeshes& draw : drawn[0].draws)
        for (std::uint32_t i = 0; i < draw.item_count; ++i) {
            std::uint32_t item[2] = {};
            std::memcpy(item, bytes.data() + (draw.first_item + i) * sizeof item, sizeof item);
            slots.push_back(item[0]);
            EXPECT_EQ(item[1], draw.first_index / 3 << 3) << "face 0 in the lowest three bits";
        }
    EXPECT_THAT(slots, ::testing::UnorderedElementsAre(slot_of(stage.box), slot_of(mixed), slot_of(second),
                                                       slot_of(mixed), slot_of(second)));
}

class CasterTrianglesWithoutMasks : public CasterTriangles {
protected:
    void SetUp() override {
        for (assets::Material& material : library.materials) material.alpha_mode = assets::AlphaMode::opaque;
        CasterTriangles::SetUp();
    }
};

TEST_F(CasterTriangles, BringTheMasksOfThoseThatAreMasked) {
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    EXPECT_THAT(bindings().storage, Contains(7u));
    EXPECT_THAT(map_labels(device, "caster masks"), SizeIs(1));
}

TEST_F(CasterTrianglesWithoutMasks, BringNone) {
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    EXPECT_THAT(bindings().units, Contains(9u));
    EXPECT_THAT(bindings().storage, Not(Contains(7u)));
    EXPECT_THAT(map_labels(device, "caster masks"), IsEmpty());
}

TEST_F(CasterTriangles, WithoutRoomForTheirMasksAreGivenBack) {
    device.fail_label("caster masks", gl::Failure::out_of_memory);
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    step();
    EXPECT_EQ(light("lamp").reason, Reason::buffer_failed);
    EXPECT_THAT(triangle_labels(), IsEmpty());
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
}

TEST_F(CasterTriangles, WithoutRoomForThemTheLightIsLitAndTriedAgain) {
    device.fail_label("caster triangles", gl::Failure::out_of_memory);
    add_light(LightKind::spot, "lamp", ShadowFilter::triangles);
    const ecs::Entity soft = add_light(LightKind::spot, "soft", ShadowFilter::soft_triangles);
    world.registry.patch<Light>(soft, [](Light& l) { l.source_radius_m = 0.1f; });
    add_light(LightKind::spot, "other", ShadowFilter::hard);
    step();
    for (const char* name : {"lamp", "soft"}) {
        EXPECT_EQ(light(name).state, LightState::skipped) << name;
        EXPECT_EQ(light(name).reason, Reason::buffer_failed) << name;
    }
    EXPECT_EQ(light("other").state, LightState::rendered);
    device.stop_failing();
    for (std::uint64_t i = 0; i <= Retry::kFrames; ++i) step();
    for (const char* name : {"lamp", "soft"}) EXPECT_EQ(light(name).state, LightState::reused) << name << " is drawn";
    EXPECT_EQ(light("soft").filter.filter, ShadowFilter::soft_triangles);
}

TEST_F(CasterTriangles, WithoutRoomForTheirNamesAMapIsTriedAgain) {
    device.fail_label(", triangles", gl::Failure::out_of_memory);
    const ecs::Entity soft = add_light(LightKind::spot, "soft", ShadowFilter::soft_triangles);
    world.registry.patch<Light>(soft, [](Light& l) { l.source_radius_m = 0.1f; });
    step();
    EXPECT_EQ(light("soft").state, LightState::skipped);
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_EQ(light("soft").state, LightState::rendered);
    EXPECT_EQ(light("soft").counts.bytes, light("soft").counts.texels * (kDepthBytes + kTriangleBytes));
}

TEST(CasterTriangleRecords, HoldTheCornersAndCountNeighboursOverAllMeshes) {
    const assets::MeshLibrary library = test_library();
    const auto triangles = caster_triangles_of(library).triangles;
    std::size_t at = 0, found = 0;
    for (const assets::Mesh& mesh : library.meshes) {
        const std::size_t first = at;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const CasterTriangle::Corner& corner = triangles.at(first + i / 3).corners[i % 3];
            EXPECT_EQ(corner.position_ms, mesh.vertices[mesh.indices[i]].position_ms);
            if (corner.across == assets::kNoNeighbour || triangles.at(first + i / 3).masked()) continue;
            ++found;
            EXPECT_GE(corner.across, first);
            EXPECT_LT(corner.across, first + mesh.indices.size() / 3);
        }
        at += mesh.indices.size() / 3;
    }
    EXPECT_EQ(triangles.size(), at);
    EXPECT_GT(found, 0u);
}

TEST(CasterTriangleRecords, OfMasksHaveNoNeighbours) {
    assets::MeshLibrary library = test_library();
    const auto neighbours = [&](std::uint32_t mesh) {
        library.meshes = {test_library().meshes[mesh]};
        std::size_t count = 0;
        for (const CasterTriangle& triangle : caster_triangles_of(library).triangles)
            for (const auto& corner : triangle.corners)
                count += !triangle.masked() && corner.across != assets::kNoNeighbour;
        return count;
    };
    EXPECT_GT(neighbours(kSolidBox), 0u);
    EXPECT_EQ(neighbours(kMaskedBox), 0u);
    EXPECT_EQ(neighbours(kBlendedBox), 0u);
    EXPECT_LT(neighbours(kMixedBox), neighbours(kSolidBox));
}

TEST(CasterTriangleRecords, OfMasksNameTheirMaskAndTextureCoordinates) {
    const assets::MeshLibrary library = test_library();
    const CasterTriangleList all = caster_triangles_of(library);
    std::size_t at = 0, masked = 0;
    const auto word = [&](std::size_t i) { return std::bit_cast<float>(all.masks.at(i)); };
    for (const assets::Mesh& mesh : library.meshes) {
        for (const assets::Submesh& s : mesh.submeshes)
            for (std::size_t i = s.first_index; i < s.first_index + s.index_count; i += 3) {
                const CasterTriangle& triangle = all.triangles.at(at + i / 3);
                const assets::Material& material = library.materials[s.material];
                ASSERT_EQ(triangle.masked(), material.alpha_mode == assets::AlphaMode::mask) << mesh.name << " " << i;
                if (!triangle.masked()) continue;
                ++masked;
                const std::uint32_t mask = triangle.corners[1].across, uvs = triangle.corners[2].across;
                EXPECT_EQ(word(mask), material.alpha_cutoff);
                EXPECT_EQ(word(mask + 1), material.base_colour.a);
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_EQ(glm::vec2(word(uvs + 2 * c), word(uvs + 2 * c + 1)),
                              mesh.vertices[mesh.indices[i + c]].uv);
            }
        at += mesh.indices.size() / 3;
    }
    EXPECT_GT(masked, 0u);
}

TEST(CasterTriangleRecords, OfALibraryWithoutMasksBringNone) {
    assets::MeshLibrary library = test_library();
    EXPECT_FALSE(caster_triangles_of(library).masks.empty());
    library.meshes = {library.meshes[kSolidBox]};
    EXPECT_TRUE(caster_triangles_of(library).masks.empty());
}

}  // namespace
}  // namespace gnomon
