#include "tests/gl/embed_fixture.h"
#include "tests/gl/packed_mesh.h"
#include "tests/unit/allocation_counter.h"

// Meshes that stay in the engine's own buffers.
namespace gnomon {
namespace {

class EmbedBuffers : public EmbedTest {
protected:
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
        arrays = std::move(Shadows::create(options()).value());
    }
    void TearDown() override {
        arrays.reset();
        packed.clear();
        EmbedTest::TearDown();
    }
    /// Adds a ground as arrays to both.
    void add_ground() {
        add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}));
        arrays->add_caster({.mesh = arrays->add_mesh({.positions_m = room[0].positions, .indices = room[0].indices}).value()});
    }
    /// Adds a light to both.
    LightId light_both(LightKind kind, const glm::dvec3& at_m, const LightShadow& shadow) {
        const LightId lamp = add_shadowed(kind, at_m, shadow);
        in_arrays = arrays->add_light({.light = {.kind = kind, .outer_cone_rad = 0.9f},
                                       .position_m = at_m,
                                       .direction = -at_m,
                                       .shadow = shadow});
        return lamp;
    }
    /// Adds a mesh as the engine's buffers to one and as arrays to the other.
    void add_mesh(const game::Shape& shape, const Packing& packing) {
        packed.push_back(std::make_unique<PackedMesh>(shape, packing));
        const auto made = shadows->add_buffer_mesh(packed.back()->desc);
        ASSERT_TRUE(made) << to_line(made.error());
        mesh = made.value();
        array_mesh = arrays->add_mesh({.positions_m = shape.positions, .indices = shape.indices}).value();
        shape_ = shape;
    }
    /// Places the last mesh in all worlds. `scale`: what packed positions lack.
    void place_mesh(const glm::dmat4& world_from_mesh, double scale = 1.0) {
        game::Shape placed = shape_;
        for (glm::vec3& p : placed.positions) p = glm::vec3(world_from_mesh * glm::dvec4(p, 1.0));
        if (glm::determinant(world_from_mesh) < 0.0)
            for (std::size_t i = 0; i + 2 < placed.indices.size(); i += 3) std::swap(placed.indices[i], placed.indices[i + 1]);
        EmbedTest::place(add_analysed(placed));
        engine->add(placed.positions, placed.indices);
        const glm::dmat4 scaled = glm::scale(world_from_mesh, glm::dvec3(scale));
        casters.push_back(shadows->add_caster({.mesh = mesh, .world_from_mesh = scaled}));
        arrays->add_caster({.mesh = array_mesh, .world_from_mesh = scaled});
    }
    std::vector<std::uint8_t> masked_by(Shadows& by) {
        draw_depths(view, *engine);
        return layer_of(by.render(view), 0);
    }
    static glm::dmat4 at(const glm::dvec3& place_m) { return glm::translate(glm::dmat4(1.0), place_m); }

    std::unique_ptr<Shadows> arrays;
    std::vector<std::unique_ptr<PackedMesh>> packed;
    std::vector<CasterId> casters;
    MeshId mesh, array_mesh;
    LightId in_arrays;

private:
    game::Shape shape_;
};

/// Makes a shape with numbers that floats of all sizes hold exactly: multiples of an eighth.
game::Shape eighths() {
    game::Shape shape = game::make_box({-0.5, -0.125, -0.375}, {0.5, 0.125, 0.375});
    game::append(shape, game::make_box({-0.125, 0.25, -0.125}, {0.25, 0.75, 0.125}));
    game::append(shape, game::make_card({-0.5, 0.5, 0.0}, {0.0, 0.0, 0.5}, {0.0, 0.5, 0.0}));  // open
    return shape;
}

class EmbedBufferLayouts : public EmbedBuffers, public ::testing::WithParamInterface<std::tuple<LightKind, Packing>> {};

TEST_P(EmbedBufferLayouts, CastWhatTheSameArraysCast) {
    const auto& [kind, packing] = GetParam();
    add_ground();
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), packing));
    place_mesh(at({0.0, 0.7, 0.0}));
    place_mesh(glm::rotate(at({0.9, 0.5, 0.4}), 0.7, glm::dvec3(0.3, 1.0, 0.2)));
    place_mesh(glm::scale(at({-0.9, 0.6, -0.3}), glm::dvec3(-1.0, 1.0, 1.0)));  // mirrored
    const LightId lamp = light_both(kind, {1.5, 3.0, 1.0}, {.filter = ShadowFilter::pcf_bilinear});
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> mask = masked_by(*shadows);
    EXPECT_EQ(mask, masked_by(*arrays)) << "to the bit";
    EXPECT_EQ(shadows->status(lamp).by_depth, 0u) << "its filter reads depths of all";
    EXPECT_EQ(shadows->status(lamp).maps, arrays->status(in_arrays).maps);
    EXPECT_EQ(shadows->status(lamp).bytes, arrays->status(in_arrays).bytes);
    EXPECT_EQ(shadows->status(lamp).draws, arrays->status(in_arrays).draws) << "instances are one draw here, too";
    for (const CasterId caster : casters) shadows->remove(caster);
    EXPECT_GT(differing(masked_by(*shadows), mask), 1000u) << "control: without them there is no shadow";
}

constexpr Packing kTight{"tight"};
constexpr Packing kPackings[] = {
    kTight,
    {.name = "interleaved", .stride_bytes = 36, .position_offset_bytes = 8, .index_size = IndexSize::u16, .first_index = 5, .base_vertex = 7},
    {.name = "half", .format = PositionFormat::float16, .stride_bytes = 8, .first_index = 3},
};
INSTANTIATE_TEST_SUITE_P(All, EmbedBufferLayouts,
                         ::testing::Combine(::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                                            ::testing::ValuesIn(kPackings)),
                         [](const auto& row) {
                             return std::string(kind_name(std::get<0>(row.param))) + "_" + std::get<1>(row.param).name;
                         });

TEST_F(EmbedBuffers, NormalisedPositionsTakeTheirScaleFromTheCaster) {
    for (const bool is_signed : {true, false}) {
        SCOPED_TRACE(is_signed);
        add_ground();
        // Whole steps of the format, so that the arrays hold the same numbers to a float's rounding.
        game::Shape shape = game::make_box({is_signed ? -0.5 : 0.25, 0.25, 0.125}, {0.75, 0.5, 0.5});
        const float steps = is_signed ? 32767.0f : 65535.0f;
        for (glm::vec3& p : shape.positions) p = glm::round(p * steps) / steps;
        ASSERT_NO_FATAL_FAILURE(add_mesh(shape, {.name = "", .format = is_signed ? PositionFormat::snorm16 : PositionFormat::unorm16, .stride_bytes = 6}));
        place_mesh(at({0.0, 0.4, 0.0}), 1.5);
        light_both(LightKind::spot, {1.5, 3.0, 1.0}, {.filter = ShadowFilter::pcf_bilinear});
        look_from({0.5, 2.5, 4.0});
        const std::vector<std::uint8_t> mask = masked_by(*shadows);
        EXPECT_LE(differing(mask, masked_by(*arrays)), kFewPixels);
        EXPECT_GT(std::count(mask.begin(), mask.end(), 0), 1000);
    }
}

TEST_F(EmbedBuffers, AFilterOfTrianglesReadsThemByDepth) {
    add_ground();
    add(game::make_box({-1.4, 0.2, 0.4}, {-1.1, 0.5, 0.7}));  // with triangles, to compare
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), kTight));
    place_mesh(at({0.0, 0.7, 0.0}));
    place_mesh(glm::rotate(at({0.9, 0.5, 0.4}), 0.7, glm::dvec3(0.3, 1.0, 0.2)));
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        const LightId lamp = add_shadowed(kind, {1.5, 3.0, 1.0});
        look_from({0.5, 2.5, 4.0});
        const auto layer = static_cast<std::uint32_t>(kind == LightKind::directional ? 0 : kind == LightKind::spot ? 1 : 2);
        const std::vector<std::uint8_t> mask = masked(layer);
        draw();
        std::vector<float> measured;
        for (const std::uint8_t texel : mask) measured.push_back(static_cast<float>(texel) / 255.0f);
        Tally tally;
        tally.add(judge(layer, frame().snapshot(), measured));
        std::printf("%s: %s\n", kind_name(kind), tally.text().c_str());
        EXPECT_GT(tally.dark, 1500.0);
        EXPECT_LT((tally.false_light + tally.false_shadow) / tally.scored, 0.003);
        EXPECT_EQ(shadows->status(lamp).filter, ShadowFilter::triangles);
        EXPECT_EQ(shadows->status(lamp).by_depth, 2u);
        masked(layer);
        EXPECT_EQ(shadows->status(lamp).by_depth, 2u) << "in a still frame, too";
    }
}

TEST_F(EmbedBuffers, AWorldOfBuffersAloneIsShadowed) {
    ASSERT_NO_FATAL_FAILURE(add_mesh(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 12.0}, {12.0, 0.0, 0.0}), kTight));
    place_mesh(glm::dmat4(1.0));
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), kTight));
    place_mesh(at({0.0, 0.7, 0.0}));
    const LightId lamp = add_shadowed(LightKind::point, {1.5, 3.0, 1.0});
    look_from({0.5, 2.5, 4.0});
    const Difference d = compared(masked());
    std::printf("%zu surfaces, %zu dark, %.4f %%\n", d.surfaces, d.dark, 100.0 * d.share());
    EXPECT_GT(d.dark, 800u);
    EXPECT_LT(d.share(), 0.003);
    EXPECT_EQ(shadows->status(lamp).state, LightState::rendered);
}

TEST_F(EmbedBuffers, ContentThatChangedIsDrawnAgainWhereItShows) {
    add_ground();
    add(game::make_box({4.0, 0.5, -0.5}, {5.0, 1.0, 0.5}));
    ASSERT_NO_FATAL_FAILURE(add_mesh(game::make_box({-0.3, 0.4, -0.3}, {0.3, 0.6, 0.3}), kTight));
    place_mesh(glm::dmat4(1.0));
    const LightId lamp = light_both(LightKind::spot, {1.5, 3.0, 1.0}, {.filter = ShadowFilter::pcf_bilinear, .refresh_error_px = 1.0f});
    const LightId elsewhere = shadows->add_light({.light = {.kind = LightKind::spot, .range_m = 6.0f, .outer_cone_rad = 0.4f},
                                                  .position_m = {4.5, 4.0, 0.0}});
    look_from({3.5, 4.5, 8.0});
    const std::vector<std::uint8_t> before = masked();
    ASSERT_EQ(shadows->status(elsewhere).state, LightState::rendered) << reason_code(shadows->status(elsewhere).reason);
    for (int frame = 0; frame < 6; ++frame) {
        const float shift = 0.05f * static_cast<float>(frame + 1);
        game::Shape moved = game::make_box({-0.3, 0.4, -0.3}, {0.3, 0.6, 0.3});
        for (glm::vec3& p : moved.positions) p.x += shift;
        packed.back()->fill(moved);
        if (frame == 0) {
            EXPECT_EQ(masked(), before) << "what nobody announced costs nothing";
            EXPECT_EQ(shadows->status().maps_drawn, 0u);
        }
        shadows->mesh_changed(mesh, packed.back()->desc.bounds);
        const std::vector<std::uint8_t> now = masked();
        EXPECT_GT(shadows->status(lamp).maps_drawn, 0u) << "though it may be kept while known movement is small";
        EXPECT_EQ(shadows->status(elsewhere).maps_drawn, 0u);
        EXPECT_GT(differing(now, before), 20u * static_cast<std::size_t>(frame + 1));
        masked();
        EXPECT_TRUE(shadows->status().still);
    }
}

TEST_F(EmbedBuffers, ABufferThatTheEngineDeletedIsReported) {
    add_ground();
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), kTight));
    place_mesh(at({0.0, 0.7, 0.0}));
    const LightId lamp = light_both(LightKind::point, {1.5, 3.0, 1.0}, {});
    look_from({0.5, 2.5, 4.0});
    const std::vector<std::uint8_t> with = masked();
    ASSERT_TRUE(shadows->dropped().empty());
    const game::Shape little = game::make_card({0.0, 0.0, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.5, 0.0});
    packed.back()->fill(little);
    const std::vector<std::uint8_t> without = masked();
    ASSERT_EQ(shadows->dropped().size(), 1u) << "its content is smaller than its description";
    EXPECT_EQ(shadows->dropped()[0].caster, casters[0]);
    EXPECT_EQ(shadows->dropped()[0].reason, "buffer_lost");
    EXPECT_GT(differing(with, without), 500u);
    packed.back()->fill(eighths());
    EXPECT_EQ(masked(), with) << "it returns with its buffers";
    EXPECT_TRUE(shadows->dropped().empty());
    packed.back()->drop();
    EXPECT_EQ(masked(), without);
    ASSERT_EQ(shadows->dropped().size(), 1u);
    EXPECT_EQ(shadows->dropped()[0].reason, "buffer_lost");
    EXPECT_EQ(shadows->status().failure, "");
    EXPECT_NE(shadows->status(lamp).state, LightState::degraded);
    shadows->remove(mesh);
    masked();
    ASSERT_EQ(shadows->dropped().size(), 1u);
    EXPECT_EQ(shadows->dropped()[0].reason, "unknown_mesh");
}

TEST_F(EmbedBuffers, ARemovedMeshLeavesItsPlaceToArrays) {
    add_ground();
    ASSERT_NO_FATAL_FAILURE(add_mesh(game::make_box({-0.3, 0.4, -0.3}, {0.3, 0.6, 0.3}), kTight));
    place_mesh(glm::dmat4(1.0));
    light_both(LightKind::point, {1.5, 3.0, 1.0}, {});
    look_from({0.5, 2.5, 4.0});
    masked();
    shadows->remove(mesh);
    shadows->remove(casters[0]);
    const game::Shape other = eighths();
    const auto made = shadows->add_mesh({.positions_m = other.positions, .indices = other.indices});
    shadows->add_caster({.mesh = made.value(), .world_from_mesh = at({0.0, 0.7, 0.0})});
    const std::vector<std::uint8_t> reused = masked();
    auto fresh = std::move(Shadows::create(options()).value());
    fresh->add_caster({.mesh = fresh->add_mesh({.positions_m = room[0].positions, .indices = room[0].indices}).value()});
    fresh->add_caster({.mesh = fresh->add_mesh({.positions_m = other.positions, .indices = other.indices}).value(),
                       .world_from_mesh = at({0.0, 0.7, 0.0})});
    fresh->add_light({.light = {.kind = LightKind::point}, .position_m = {1.5, 3.0, 1.0}});
    EXPECT_EQ(differing(reused, masked_by(*fresh)), 0u);
}

TEST_F(EmbedBuffers, QueriesDoNotSeeThem) {
    add_ground();
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), kTight));
    place_mesh(at({0.0, 0.7, 0.0}));
    const LightId lamp = light_both(LightKind::point, {0.0, 3.0, 0.0}, {});
    look_from({0.5, 2.5, 4.0});
    masked_by(*shadows);
    masked_by(*arrays);
    EXPECT_EQ(shadows->visibility(lamp, {0.0, 0.2, 0.0}), 1.0f);
    EXPECT_EQ(arrays->visibility(in_arrays, {0.0, 0.2, 0.0}), 0.0f) << "control: as arrays they do";
}

/// Returns the bytes of all buffers in the context.
std::uint64_t buffer_bytes() {
    std::uint64_t sum = 0;
    for (GLuint name = 1; name < 4096; ++name) {
        GLint64 bytes = 0;
        if (glIsBuffer(name) == GL_TRUE) glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &bytes);
        sum += static_cast<std::uint64_t>(bytes);
    }
    return sum;
}

TEST_F(EmbedBuffers, NothingOfAMeshIsCopied) {
    add_ground();
    look_from({0.5, 2.5, 4.0});
    light_both(LightKind::point, {1.5, 3.0, 1.0}, {});
    const auto growth = [&](std::uint32_t sides) {
        const game::Shape shape = game::make_sphere(0.3, sides, sides / 2);
        const PackedMesh in_buffers(shape, kTight);
        auto alone = std::move(Shadows::create().value());
        alone->add_light({.light = {.kind = LightKind::point}, .position_m = {1.5, 3.0, 1.0}});
        const std::uint64_t before = buffer_bytes();
        const auto made = alone->add_buffer_mesh(in_buffers.desc);
        for (int i = 0; i < 4; ++i) alone->add_caster({.mesh = made.value(), .world_from_mesh = at({0.1 * i, 1.0, 0.0})});
        masked_by(*alone);
        EXPECT_GT(alone->status().draws, 0u);
        return buffer_bytes() - before;
    };
    const std::uint64_t small = growth(8), large = growth(256);
    EXPECT_EQ(small, large) << "256 sides are 1000 times as many triangles";
    EXPECT_LT(large, std::uint64_t{1} << 16);
}

TEST_F(EmbedBuffers, NothingIsAllocatedWhileContentChanges) {
    add_ground();
    ASSERT_NO_FATAL_FAILURE(add_mesh(eighths(), kTight));
    place_mesh(at({0.0, 0.7, 0.0}));
    light_both(LightKind::spot, {1.5, 3.0, 1.0}, {});
    look_from({0.5, 2.5, 4.0});
    draw_depths(view, *engine);
    const auto frame = [&] {
        shadows->mesh_changed(mesh, packed.back()->desc.bounds);
        shadows->render(view);
    };
    for (int i = 0; i < 40; ++i) frame();
    const std::size_t before = allocation_count();
    for (int i = 0; i < 6; ++i) frame();
    EXPECT_EQ(allocation_count() - before, 0u);
    EXPECT_GT(shadows->status().maps_drawn, 0u) << "control: these frames drew";
}

TEST_F(EmbedBuffers, BadDescriptionsAreRefused) {
    const PackedMesh good(eighths(), {.name = "", .stride_bytes = 16, .index_size = IndexSize::u16, .first_index = 3});
    const auto rule = [&](auto&& change) {
        BufferMeshDesc desc = good.desc;
        change(desc);
        const auto made = shadows->add_buffer_mesh(desc);
        return made ? std::string() : made.error().rule;
    };
    EXPECT_EQ(rule([](BufferMeshDesc&) {}), "") << "control";
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.index_count = 0; }), "mesh.empty");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.index_count -= 1; }), "mesh.empty");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.stride_bytes = 0; }), "mesh.layout");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.stride_bytes = 11; }), "mesh.layout");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.stride_bytes = 2052; }), "mesh.layout");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.vertex_count = 0; }), "mesh.layout");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.bounds.min_m.x = std::nan(""); }), "mesh.bounds");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { std::swap(d.bounds.min_m, d.bounds.max_m); }), "mesh.bounds");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.vertex_buffer = 0; }), "mesh.buffer");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.index_buffer = 4711; }), "mesh.buffer");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.vertex_count += 1; }), "mesh.buffer");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.position_offset_bytes = 5; }), "mesh.buffer") << "the last one ends 4 bytes before the end";
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.position_offset_bytes = ~std::uint64_t{0} - 8; }), "mesh.buffer");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.first_index += 1; }), "mesh.buffer");
    EXPECT_EQ(rule([](BufferMeshDesc& d) { d.index_size = IndexSize::u32; }), "mesh.buffer");
}

}  // namespace
}  // namespace gnomon
