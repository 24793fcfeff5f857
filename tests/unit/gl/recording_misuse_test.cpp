#include "tests/unit/gl/recording_fixture.h"

// Each misuse is found, alone; its legal twin is not.
namespace gnomon::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RecordingMisuse : public RecordingTest {
protected:
    /// Returns the misuses in a correct pass with `extra` before its draw.
    std::vector<Misuse> in_draw(const std::vector<Command>& extra, Command draw = DrawTriangle{}) {
        CommandList list;
        begin(list);
        pipeline(list);
        meshes(list);
        for (const Command& command : extra) list.add(command);
        list.add(std::move(draw));
        list.add(EndPass{});
        return misuses_of(list);
    }
    std::vector<Misuse> of(const std::vector<Command>& commands) {
        CommandList list;
        for (const Command& command : commands) list.add(command);
        return misuses_of(list);
    }
    BeginPass pass() const { return {.target = target, .viewport = {0, 0, 64, 32}}; }
};

TEST_F(RecordingMisuse, ACompleteFrameIsRight) {
    EXPECT_THAT(in_draw({BindTexture{0, other, sampler}, BindUniforms{0, uniforms, 256, 256}, BindStorage{0, items}},
                        DrawMeshes{0, 6, 0, 0, 2}),
                IsEmpty());
}

TEST_F(RecordingMisuse, DrawsNeedAPass) {
    CommandList list;
    pipeline(list);
    list.add(DrawTriangle{});
    EXPECT_THAT(misuses_of(list), ElementsAre(Misuse::draw_outside_pass));
    EXPECT_THAT(in_draw({}), IsEmpty());
}

TEST_F(RecordingMisuse, PassesDoNotNestAndMustClose) {
    EXPECT_THAT(of({pass(), pass(), EndPass{}}), ElementsAre(Misuse::nested_pass));
    EXPECT_THAT(of({pass()}), ElementsAre(Misuse::unbalanced_pass));
    EXPECT_THAT(of({EndPass{}}), ElementsAre(Misuse::unbalanced_pass));
    EXPECT_THAT(of({pass(), EndPass{}, pass(), EndPass{}}), IsEmpty());
}

TEST_F(RecordingMisuse, GroupsNestAndMustClose) {
    EXPECT_THAT(of({BeginGroup{"a"}}), ElementsAre(Misuse::unbalanced_group));
    EXPECT_THAT(of({EndGroup{}}), ElementsAre(Misuse::unbalanced_group));
    EXPECT_THAT(of({BeginGroup{"a"}, BeginGroup{"b"}, EndGroup{}, EndGroup{}}), IsEmpty());
}

TEST_F(RecordingMisuse, TimersDoNotNestAndMustClose) {
    EXPECT_THAT(of({BeginTimer{1}}), ElementsAre(Misuse::unbalanced_timer));
    EXPECT_THAT(of({EndTimer{1}}), ElementsAre(Misuse::unbalanced_timer));
    EXPECT_THAT(of({BeginTimer{1}, EndTimer{2}}), ElementsAre(Misuse::unbalanced_timer));
    EXPECT_THAT(of({BeginTimer{1}, BeginTimer{2}, EndTimer{2}}), ElementsAre(Misuse::nested_timer));
    EXPECT_THAT(of({BeginTimer{1}, EndTimer{1}, BeginTimer{1}, EndTimer{1}}), IsEmpty());
}

TEST_F(RecordingMisuse, DrawsNeedAPipeline) {
    EXPECT_THAT(of({pass(), DrawTriangle{}, EndPass{}}), ElementsAre(Misuse::draw_without_pipeline));
    EXPECT_THAT(of({pass(), DrawLines{2}, EndPass{}}), ElementsAre(Misuse::draw_without_pipeline));
    EXPECT_THAT(of({SetPipeline{{.program = program}}, pass(), DrawLines{2}, EndPass{}}), IsEmpty());
    EXPECT_THAT(of({pass(), DrawPoints{0, 5}, EndPass{}}), ElementsAre(Misuse::draw_without_pipeline));
    EXPECT_THAT(of({SetPipeline{{.program = program}}, pass(), DrawPoints{3, 5}, EndPass{}}), IsEmpty());
    EXPECT_THAT(of({pass(), DrawPulled{0, 6}, EndPass{}}), ElementsAre(Misuse::draw_without_pipeline));
    EXPECT_THAT(of({SetPipeline{{.program = program}}, pass(), DrawPulled{6, 6}, EndPass{}}), IsEmpty());
    EXPECT_THAT(of({SetPipeline{{.program = program}}, pass(), DrawPulled{0, 4}, EndPass{}}),
                ElementsAre(Misuse::draw_out_of_range));
}

TEST_F(RecordingMisuse, StateDoesNotReachTheNextList) {
    EXPECT_THAT(of({SetPipeline{{.program = program}}, BindMeshes{vertices, indices, items}}), IsEmpty());
    EXPECT_THAT(of({pass(), DrawMeshes{0, 3, 0, 0, 1}, EndPass{}}),
                ElementsAre(Misuse::draw_without_pipeline, Misuse::draw_without_meshes));
}

TEST_F(RecordingMisuse, DrawsOfMeshesNeedMeshes) {
    const SetPipeline set{{.program = program}};
    EXPECT_THAT(of({pass(), set, DrawMeshes{0, 3, 0, 0, 1}, EndPass{}}), ElementsAre(Misuse::draw_without_meshes));
    EXPECT_THAT(in_draw({}, DrawMeshes{0, 3, 0, 0, 1}), IsEmpty());
}

TEST_F(RecordingMisuse, DrawsStayInTheirBuffers) {
    EXPECT_THAT(in_draw({}, DrawMeshes{3, 3, 0, 1, 1}), IsEmpty());
    EXPECT_THAT(in_draw({}, DrawMeshes{3, 4, 0, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(in_draw({}, DrawMeshes{0, 3, 0, 1, 2}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(in_draw({}, DrawMeshes{~0u, 3, 0, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
}

TEST_F(RecordingMisuse, DrawsFetchOnlyVerticesThatExist) {
    EXPECT_THAT(in_draw({}, DrawMeshes{0, 3, 1, 0, 1}), IsEmpty());  // vertices 1 to 3 of 4
    EXPECT_THAT(in_draw({}, DrawMeshes{0, 3, 2, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(in_draw({}, DrawMeshes{0, 3, -1, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
}

TEST_F(RecordingMisuse, DrawsOfAnotherLayoutStayInTheirBuffers) {
    // Four vertices of 32 bytes are ten of 12 with 8 bytes left; six indices of four bytes are twelve of two.
    const auto drawn = [&](const MeshLayout& layout, const DrawMeshes& draw) {
        return of({pass(), SetPipeline{{.program = program}}, BindMeshes{vertices, indices, items, layout}, draw, EndPass{}});
    };
    const MeshLayout tight{.stride = 12}, half{.stride = 12, .position = PositionFormat::float16};
    EXPECT_THAT(drawn(tight, {0, 3, 7, 0, 1}), IsEmpty());
    EXPECT_THAT(drawn(tight, {0, 3, 8, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(drawn(half, {0, 3, 8, 0, 1}), IsEmpty()) << "6 bytes of the eleventh are there";
    EXPECT_THAT(drawn({.stride = 12, .position_offset = 9}, {0, 3, 7, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(drawn({.stride = 12, .position_offset = 1000}, {0, 3, 0, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
    EXPECT_THAT(drawn({.stride = 12, .short_indices = true}, {6, 6, 0, 0, 1}), IsEmpty());
    EXPECT_THAT(drawn({.stride = 12, .short_indices = true}, {6, 7, 0, 0, 1}), ElementsAre(Misuse::draw_out_of_range));
}

TEST_F(RecordingMisuse, UpdatesStandOutsidePasses) {
    const std::array<std::uint32_t, 1> one = {1};
    CommandList inside, outside;
    begin(inside);
    inside.update(items, 0, std::span<const std::uint32_t>{one});
    inside.add(EndPass{});
    outside.update(items, 0, std::span<const std::uint32_t>{one});
    begin(outside);
    outside.add(EndPass{});
    EXPECT_THAT(misuses_of(inside), ElementsAre(Misuse::update_inside_pass));
    EXPECT_THAT(misuses_of(outside), IsEmpty());
}

TEST_F(RecordingMisuse, UpdatesStayInTheirBufferAndPayload) {
    const std::array<std::uint32_t, 1> one = {1};
    CommandList last, beyond;
    last.update(items, 12, std::span<const std::uint32_t>{one});
    beyond.update(items, 13, std::span<const std::uint32_t>{one});
    EXPECT_THAT(misuses_of(last), IsEmpty());
    EXPECT_THAT(misuses_of(beyond), ElementsAre(Misuse::update_out_of_range));
    EXPECT_THAT(of({UpdateBuffer{items, 0, 0, 4}}), ElementsAre(Misuse::update_out_of_range)) << "no payload";
    EXPECT_THAT(of({ClearBuffer{items, 0, 4}}), IsEmpty());
    EXPECT_THAT(of({ClearBuffer{items, 2, 4}}), ElementsAre(Misuse::update_out_of_range)) << "no whole words";
    EXPECT_THAT(of({ClearBuffer{items, 0, 1u << 20}}), ElementsAre(Misuse::update_out_of_range));
    EXPECT_THAT(of({pass(), ClearBuffer{items, 0, 4}, EndPass{}}), ElementsAre(Misuse::update_inside_pass));
    EXPECT_THAT(of({ClearBuffer{indices, 0, 4}}), ElementsAre(Misuse::update_of_fixed_buffer));
}

TEST_F(RecordingMisuse, FixedBuffersAreNotUpdated) {
    const std::array<std::uint32_t, 1> one = {1};
    CommandList list;
    list.update(indices, 0, std::span<const std::uint32_t>{one});
    EXPECT_THAT(misuses_of(list), ElementsAre(Misuse::update_of_fixed_buffer));
}

TEST_F(RecordingMisuse, ComputeProgramsAreDispatchedOutsidePassesAndOthersDraw) {
    const ProgramHandle counts = device.create_program({.label = "counts", .compute = "void main() {}"}).handle;
    EXPECT_THAT(of({Dispatch{counts, 2, 1}}), IsEmpty());
    EXPECT_THAT(of({Dispatch{program, 2, 1}}), ElementsAre(Misuse::wrong_program));
    EXPECT_THAT(of({SetPipeline{{.program = counts}}}), ElementsAre(Misuse::wrong_program));
    EXPECT_THAT(of({Dispatch{counts, 2, 0}}), ElementsAre(Misuse::dispatch_of_nothing));
    EXPECT_THAT(of({pass(), Dispatch{counts, 1, 1}, EndPass{}}), ElementsAre(Misuse::dispatch_inside_pass));
    const SetPipeline set{{.program = program}};
    EXPECT_THAT(of({set, pass(), DrawTriangle{}, EndPass{}}), IsEmpty());
    EXPECT_THAT(of({set, Dispatch{counts, 1, 1}, pass(), DrawTriangle{}, EndPass{}}),
                ElementsAre(Misuse::draw_without_pipeline));
    device.forget();
    EXPECT_FALSE(device.create_program({.label = "both", .vertex = "v", .compute = "c"}));
    EXPECT_THAT(found(), ElementsAre(Misuse::bad_description));
}

TEST_F(RecordingMisuse, CopiesFitTheirBuffersAndStandOutsidePasses) {
    const BufferHandle twin = device.create_buffer({.label = "twin", .size = 2 * 8}, {}).handle;
    EXPECT_THAT(of({CopyBuffer{items, twin}}), IsEmpty());
    EXPECT_THAT(of({CopyBuffer{items, uniforms}}), ElementsAre(Misuse::copy_mismatch)) << "of another size";
    EXPECT_THAT(of({CopyBuffer{items, items}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({pass(), CopyBuffer{items, twin}, EndPass{}}), ElementsAre(Misuse::copy_inside_pass));
    const BufferHandle back = read_back(24);
    EXPECT_THAT(of({CopyBuffer{back, indices}}), ElementsAre(Misuse::copy_mismatch)) << "indices are fixed";
}

TEST_F(RecordingMisuse, CopiesOfPartsFitBothBuffersAndGoToUpdatedOnes) {
    const BufferHandle large = device.create_buffer({.label = "large", .size = 64}, {}).handle;
    EXPECT_THAT(of({CopyBuffer{items, large, 0, 48, 16}}), IsEmpty()) << "another size is no matter";
    EXPECT_THAT(of({CopyBuffer{items, large, 0, 52, 16}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyBuffer{items, large, 4, 0, 16}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyBuffer{items, large, ~std::uint64_t{0}, 0, 16}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyBuffer{large, large, 0, 32, 16}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyBuffer{large, read_back(64), 0, 0, 16}}), ElementsAre(Misuse::copy_mismatch))
        << "only whole copies are read back";
    EXPECT_THAT(of({CopyBuffer{large, indices, 0, 0, 4}}), ElementsAre(Misuse::copy_mismatch)) << "indices are fixed";
    EXPECT_THAT(of({pass(), CopyBuffer{items, large, 0, 0, 16}, EndPass{}}), ElementsAre(Misuse::copy_inside_pass));
}

TEST_F(RecordingMisuse, TexturesAreCopiedLayerByLayerToTheirLikeOutsidePasses) {
    const TextureDesc cube{"cube", TextureKind::cube, Format::d32f, 8, 8};
    const auto made = [&](const TextureDesc& desc) { return device.create_texture(desc, {}).handle; };
    const TextureHandle map = made(cube), twin = made(cube);
    EXPECT_THAT(of({CopyTexture{map, twin, 0}, CopyTexture{map, twin, 5}}), IsEmpty());
    EXPECT_THAT(of({CopyTexture{map, twin, 6}}), ElementsAre(Misuse::copy_mismatch)) << "a cube has six faces";
    EXPECT_THAT(of({CopyTexture{map, map, 0}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({pass(), CopyTexture{map, twin, 0}, EndPass{}}), ElementsAre(Misuse::copy_inside_pass));
    TextureDesc larger = cube, coarser = cube, array = cube;
    larger.width = larger.height = 16;
    coarser.format = Format::d16;
    array.kind = TextureKind::array;
    array.layers = 6;
    EXPECT_THAT(of({CopyTexture{map, made(larger), 0}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyTexture{map, made(coarser), 0}}), ElementsAre(Misuse::copy_mismatch));
    EXPECT_THAT(of({CopyTexture{map, made(array), 0}}), IsEmpty()) << "layers are the faces";
    EXPECT_THAT(of({CopyTexture{map, twin, 0, {7, 0, 1, 8}}}), IsEmpty());
    for (const Rect& beyond :
         {Rect{7, 0, 2, 8}, Rect{0, 1, 8, 8}, Rect{-1, 0, 2, 2}, Rect{0, 0, 2, 0}, Rect{0, 0, -1, 2}})
        EXPECT_THAT(of({CopyTexture{map, twin, 0, beyond}}), ElementsAre(Misuse::copy_mismatch));
}

TEST_F(RecordingMisuse, OnlyBuffersToReadBackAreReadAndNothingElseIsWrittenIntoThem) {
    const BufferHandle back = read_back(8);
    std::array<std::byte, 8> eight{};
    std::array<std::byte, 16> sixteen{};
    EXPECT_EQ(device.read_buffer(back, eight), Readback::empty);
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_EQ(device.read_buffer(back, sixteen), Readback::failed);
    EXPECT_EQ(device.read_buffer(items, sixteen), Readback::failed);
    EXPECT_EQ(device.read_buffer({999}, eight), Readback::failed);
    EXPECT_THAT(found(),
                ElementsAre(Misuse::read_of_other_buffer, Misuse::read_of_other_buffer, Misuse::unknown_handle));
    const std::array<std::uint32_t, 1> one = {1};
    CommandList list;
    list.update(back, 0, std::span<const std::uint32_t>{one});
    EXPECT_THAT(misuses_of(list), ElementsAre(Misuse::update_of_fixed_buffer));
}

TEST_F(RecordingMisuse, UniformsAreAlignedAndInRange) {
    EXPECT_THAT(of({BindUniforms{0, uniforms, 256, 256}}), IsEmpty());
    EXPECT_THAT(of({BindUniforms{0, uniforms, 128, 256}}), ElementsAre(Misuse::uniform_misaligned));
    EXPECT_THAT(of({BindUniforms{0, uniforms, 256, 257}}), ElementsAre(Misuse::uniform_out_of_range));
    EXPECT_THAT(of({BindUniforms{0, uniforms, 0, 0}}), ElementsAre(Misuse::uniform_out_of_range));
}

TEST_F(RecordingMisuse, OnlyBuffersOfTexelsAreBoundAsSuch) {
    const BufferHandle texels = device.create_buffer({.label = "texels", .size = 32, .texels = true}, {}).handle;
    EXPECT_THAT(of({BindTexels{0, texels}, BindStorage{0, texels}}), IsEmpty());
    EXPECT_THAT(of({BindTexels{0, items}}), ElementsAre(Misuse::buffer_without_texels));
    EXPECT_FALSE(device.create_buffer({.label = "part of a texel", .size = 24, .texels = true}, {}).handle);
    EXPECT_THAT(in_draw({BindTexture{3, colour, sampler}, BindTexels{3, texels}}), IsEmpty())
        << "what was bound there is not any more";
}

TEST_F(RecordingMisuse, ViewportsLieInTheirTarget) {
    const auto with = [&](Rect viewport) { return of({BeginPass{.target = target, .viewport = viewport}, EndPass{}}); };
    EXPECT_THAT(with({32, 16, 32, 16}), IsEmpty());
    EXPECT_THAT(with({33, 16, 32, 16}), ElementsAre(Misuse::viewport_out_of_target));
    EXPECT_THAT(with({-1, 0, 32, 16}), ElementsAre(Misuse::viewport_out_of_target));
    EXPECT_THAT(with({0, 0, 0, 16}), ElementsAre(Misuse::viewport_out_of_target));
    EXPECT_THAT(of({BeginPass{.viewport = {0, 0, 9000, 9000}}, EndPass{}}), IsEmpty()) << "a window of unknown size";
}

TEST_F(RecordingMisuse, BlitsLieInTheirTargetsAndNeedColour) {
    const TargetHandle blank = device.create_target({.label = "depth only", .depth = {depth}}).handle;
    EXPECT_THAT(of({Blit{target, {}, {0, 0, 64, 32}, {0, 0, 640, 320}}}), IsEmpty());
    EXPECT_THAT(of({Blit{target, {}, {0, 0, 65, 32}, {0, 0, 64, 32}}}), ElementsAre(Misuse::viewport_out_of_target));
    EXPECT_THAT(of({Blit{blank, {}, {0, 0, 64, 32}, {0, 0, 64, 32}}}), ElementsAre(Misuse::incomplete_target));
    EXPECT_THAT(of({Blit{target, target, {0, 0, 8, 8}, {8, 8, 8, 8}}}), ElementsAre(Misuse::feedback_loop));
}

TEST_F(RecordingMisuse, NoTextureIsBoundWhileThePassDrawsIntoIt) {
    EXPECT_THAT(in_draw({BindTexture{3, other, sampler}}), IsEmpty());
    EXPECT_THAT(in_draw({BindTexture{3, colour, sampler}}), ElementsAre(Misuse::feedback_loop));
    const SetPipeline writes{{.program = program, .depth_test = DepthTest::greater, .depth_write = true}};
    const SetPipeline tests{{.program = program, .depth_test = DepthTest::greater}};
    EXPECT_THAT(in_draw({writes, BindTexture{3, depth, sampler}}), ElementsAre(Misuse::feedback_loop));
    EXPECT_THAT(in_draw({tests, BindTexture{3, depth, sampler}}), IsEmpty()) << "depth that is tested alone";
    EXPECT_THAT(in_draw({tests, BindTexture{3, colour, sampler}}), ElementsAre(Misuse::feedback_loop));
    EXPECT_THAT(in_draw({BindTexture{3, colour, sampler}, BindTexture{3, {}, {}}}), IsEmpty());
    EXPECT_THAT(of({pass(), BindTexture{3, colour, sampler}, EndPass{}}), IsEmpty()) << "nothing was drawn";
}

TEST_F(RecordingMisuse, AnyLayerOfAnAttachedTextureIsFeedback) {
    const auto maps = device.create_texture({.kind = TextureKind::array, .format = Format::d32f, .layers = 2}, {});
    const auto layer = device.create_target({.label = "layer", .depth = {maps.handle, 1}});
    const BeginPass into_layer{.target = layer.handle, .viewport = {0, 0, 1, 1}};
    const SetPipeline set{{.program = program, .depth_write = true}};
    EXPECT_THAT(of({into_layer, set, BindTexture{0, maps.handle, {}}, DrawTriangle{}, EndPass{}}),
                ElementsAre(Misuse::feedback_loop));
    EXPECT_THAT(of({pass(), set, BindTexture{0, maps.handle, {}}, DrawTriangle{}, EndPass{}}), IsEmpty());
}

TEST_F(RecordingMisuse, MipsOfTheOpenTargetAreFeedback) {
    EXPECT_THAT(of({pass(), GenerateMips{colour}, EndPass{}}), ElementsAre(Misuse::feedback_loop));
    EXPECT_THAT(of({pass(), EndPass{}, GenerateMips{colour}}), IsEmpty());
}

TEST_F(RecordingMisuse, EveryHandleInACommandMustLive) {
    const TextureHandle no_texture{999};
    const BufferHandle no_buffer{999};
    const std::vector<Command> commands = {BindTexture{0, no_texture, {}},
                                           BindTexture{0, other, {999}},
                                           BindUniforms{0, no_buffer, 0, 4},
                                           BindStorage{0, no_buffer},
                                           BindStorage{0, {}},
                                           BindTexels{0, no_buffer},
                                           UpdateBuffer{no_buffer, 0, 0, 4},
                                           BindMeshes{no_buffer, indices, items},
                                           BindMeshes{vertices, no_buffer, items},
                                           BindMeshes{vertices, indices, no_buffer},
                                           SetPipeline{{.program = {999}}},
                                           SetPipeline{},
                                           GenerateMips{no_texture},
                                           Dispatch{{999}, 1, 1},
                                           CopyBuffer{no_buffer, items},
                                           CopyBuffer{items, no_buffer},
                                           CopyTexture{no_texture, other, 0},
                                           CopyTexture{other, no_texture, 0},
                                           Blit{{999}, {}, {0, 0, 1, 1}, {0, 0, 1, 1}}};
    for (const Command& command : commands) {
        EXPECT_THAT(of({command}), ElementsAre(Misuse::unknown_handle)) << to_text(command);
    }
    EXPECT_THAT(of({BeginPass{.target = {999}, .viewport = {0, 0, 1, 1}}, EndPass{}}),
                ElementsAre(Misuse::unknown_handle));
}

TEST_F(RecordingMisuse, ADestroyedObjectIsUnknown) {
    EXPECT_THAT(of({GenerateMips{other}}), IsEmpty());
    device.destroy(other);
    EXPECT_THAT(of({GenerateMips{other}}), ElementsAre(Misuse::unknown_handle));
    device.forget();
    device.destroy(other);
    EXPECT_THAT(found(), ElementsAre(Misuse::unknown_handle));
}

TEST_F(RecordingMisuse, AHandleOfAnotherKindIsUnknown) {
    EXPECT_THAT(of({BindStorage{0, BufferHandle{other.id}}}), ElementsAre(Misuse::unknown_handle));
}

TEST_F(RecordingMisuse, TexturesOutliveTheirTargets) {
    device.forget();
    device.destroy(depth);
    EXPECT_THAT(found(), ElementsAre(Misuse::destroyed_while_attached));
    device.forget();
    device.destroy(target);
    device.destroy(colour);
    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(RecordingMisuse, IncompleteTargetsAreRefusedAndFound) {
    const auto cube = device.create_texture({.kind = TextureKind::cube, .format = Format::d32f}, {}).handle;
    const std::vector<TargetDesc> bad = {{.label = "nothing"},
                                         {.label = "colour as depth", .depth = {colour}},
                                         {.label = "depth as colour", .colours = {{depth}}},
                                         {.label = "no such face", .depth = {cube, 6}},
                                         {.label = "whole cube", .depth = {cube, -1}}};
    for (const TargetDesc& desc : bad) {
        device.forget();
        EXPECT_EQ(device.create_target(desc).failure, Failure::incomplete_target) << desc.label;
        EXPECT_THAT(found(), ElementsAre(Misuse::incomplete_target)) << desc.label;
    }
    device.forget();
    EXPECT_TRUE(device.create_target({.label = "face", .depth = {cube, 5}}));
    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(RecordingMisuse, ATargetOfADeadTextureIsRefused) {
    EXPECT_EQ(device.create_target({.label = "t", .depth = {{999}}}).failure, Failure::invalid_value);
    EXPECT_THAT(found(), ElementsAre(Misuse::unknown_handle));
}

TEST_F(RecordingMisuse, BadDescriptionsAreRefusedAndFound) {
    const auto expect_bad = [&](Failure failure, Failure wanted) {
        EXPECT_EQ(failure, wanted);
        EXPECT_THAT(found(), ElementsAre(Misuse::bad_description));
        device.forget();
    };
    const std::array<std::byte, 3> three{};
    const std::size_t live = device.live_count();
    expect_bad(device.create_texture({.width = 16385}, {}).failure, Failure::invalid_value);
    expect_bad(device.create_texture({.label = "rgba8"}, three).failure, Failure::invalid_value);
    expect_bad(device.create_buffer({.size = 0}, {}).failure, Failure::invalid_value);
    expect_bad(device.create_buffer({.size = 4}, three).failure, Failure::invalid_value);
    expect_bad(device.create_program({}).failure, Failure::compile_failed);
    EXPECT_EQ(device.live_count(), live);
}

TEST_F(RecordingMisuse, WhatLivesAtTheEndIsALeak) {
    device.forget();
    device.check_leaks();
    EXPECT_EQ(device.findings().size(), device.live_count());
    EXPECT_THAT(found(), ::testing::Each(Misuse::leak));
    RecordingDevice clean;
    clean.destroy(clean.create_texture({}, {}).handle);
    clean.check_leaks();
    EXPECT_TRUE(clean.findings().empty());
}

TEST_F(RecordingMisuse, FindingsNameTheCommand) {
    of({BeginGroup{"ok"}, EndGroup{}, GenerateMips{{999}}});
    ASSERT_EQ(device.findings().size(), 1u);
    EXPECT_THAT(device.findings()[0].detail, ::testing::HasSubstr("command 2: GenerateMips texture=#999"));
}

}  // namespace
}  // namespace gnomon::gl
