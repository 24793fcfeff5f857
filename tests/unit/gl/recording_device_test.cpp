#include <cstring>

#include "tests/unit/gl/recording_fixture.h"

namespace gnomon::gl {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Kind = ResourceCall::Kind;

TEST_F(RecordingTest, SettingUpIsNoMisuse) { EXPECT_THAT(found(), IsEmpty()); }

TEST_F(RecordingTest, HandlesAreNeverReused) {
    const TextureHandle first = device.create_texture({}, {}).handle;
    device.destroy(first);
    const TextureHandle second = device.create_texture({}, {}).handle;
    EXPECT_NE(first, second);
    EXPECT_EQ(device.texture(first), nullptr);
    EXPECT_NE(device.texture(second), nullptr);
}

TEST_F(RecordingTest, LiveBytesCountTexturesAndBuffersUntilDestroyed) {
    RecordingDevice empty;
    const auto cube =
        empty.create_texture({.kind = TextureKind::cube, .format = Format::d16, .width = 8, .height = 8}, {});
    const auto buffer = empty.create_buffer({.size = 100}, {});
    EXPECT_EQ(empty.live_bytes(), 8u * 8 * 2 * 6 + 100);
    EXPECT_EQ(empty.live_count(), 2u);
    empty.destroy(cube.handle);
    EXPECT_EQ(empty.live_bytes(), 100u);
    empty.destroy(buffer.handle);
    EXPECT_EQ(empty.live_bytes(), 0u);
    EXPECT_EQ(empty.live_count(), 0u);
}

TEST_F(RecordingTest, LabelsOfLivingObjectsAreSorted) {
    EXPECT_THAT(device.live_labels(), ElementsAre("colour", "depth", "indices", "items", "other", "program", "sampler",
                                                  "target", "uniforms", "vertices"));
}

TEST_F(RecordingTest, DescriptionsAreKeptWhileAlive) {
    EXPECT_EQ(device.target(target)->depth.texture, depth);
    EXPECT_EQ(device.buffer(items)->size, 16u);
    EXPECT_EQ(device.program(program)->label, "program");
    EXPECT_EQ(device.texture(colour)->width, 64u);
    device.destroy(target);
    EXPECT_EQ(device.target(target), nullptr);
}

TEST_F(RecordingTest, UpdatesChangeTheContentsOfBuffers) {
    CommandList list;
    const std::array<std::uint32_t, 2> values = {0x01020304u, 7u};
    list.update(items, 8, std::span<const std::uint32_t>{values});
    EXPECT_THAT(misuses_of(list), IsEmpty());
    std::array<std::uint32_t, 4> contents{};
    const auto bytes = device.buffer_bytes(items);
    ASSERT_THAT(bytes, SizeIs(sizeof contents));
    std::memcpy(contents.data(), bytes.data(), bytes.size());
    EXPECT_THAT(contents, ElementsAre(0u, 0u, 0x01020304u, 7u));
}

TEST_F(RecordingTest, CallsAndListsAreKeptInOrderUntilForgotten) {
    device.forget();
    CommandList list;
    list.add(BeginGroup{"a"});
    list.add(EndGroup{});
    const SubmitResult first = device.submit(list);
    device.destroy(other);
    device.submit({});
    ASSERT_THAT(device.resource_calls(), SizeIs(3));
    EXPECT_EQ(device.resource_calls()[0].kind, Kind::submit);
    EXPECT_EQ(device.resource_calls()[1],
              (ResourceCall{Kind::destroy_texture, other.id, "other", 64u * 32 * 4, false}));
    EXPECT_EQ(device.resource_calls()[2].id, 1u);
    EXPECT_EQ(first.submission, 0u);
    EXPECT_THAT(device.submissions(), ElementsAre(list, CommandList{}));
    device.forget();
    EXPECT_THAT(device.resource_calls(), IsEmpty());
    EXPECT_THAT(device.submissions(), IsEmpty());
    EXPECT_NE(device.texture(colour), nullptr);
}

TEST_F(RecordingTest, TheChosenCallFailsOnceAndLeavesNothing) {
    const std::uint64_t next = device.calls();
    device.fail_call(next + 1, Failure::out_of_memory);
    const std::size_t live = device.live_count();
    EXPECT_TRUE(device.create_buffer({.label = "a", .size = 4}, {}));
    const auto failed = device.create_texture({.label = "b"}, {});
    EXPECT_EQ(failed.failure, Failure::out_of_memory);
    EXPECT_EQ(failed.handle, TextureHandle{});
    EXPECT_TRUE(device.create_texture({.label = "b"}, {}));
    EXPECT_EQ(device.live_count(), live + 2);
    EXPECT_EQ(device.calls(), next + 3);
    EXPECT_TRUE(device.resource_calls()[device.resource_calls().size() - 2].failed);
    EXPECT_THAT(found(), IsEmpty()) << "a fault of the driver is no misuse";
}

TEST_F(RecordingTest, ASubmissionCanFail) {
    device.fail_call(device.calls(), Failure::out_of_memory);
    EXPECT_EQ(device.submit({}).failure, Failure::out_of_memory);
    EXPECT_EQ(device.submit({}).failure, Failure::none);
}

TEST_F(RecordingTest, ALostContextStaysLost) {
    device.fail_call(device.calls(), Failure::context_lost);
    EXPECT_EQ(device.create_texture({.label = "b"}, {}).failure, Failure::context_lost);
    device.stop_failing();
    EXPECT_EQ(device.create_sampler({.label = "c"}).failure, Failure::context_lost);
    EXPECT_EQ(device.submit({}).failure, Failure::context_lost);
}

TEST_F(RecordingTest, ALastingFaultCanSpareSubmissions) {
    device.fail_from(device.calls() + 1, Failure::out_of_memory, false);
    EXPECT_TRUE(device.create_sampler({.label = "before"}));
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(device.create_buffer({.label = "a", .size = 4}, {}).failure, Failure::out_of_memory);
        EXPECT_EQ(device.submit({}).failure, Failure::none);
    }
    device.fail_from(device.calls(), Failure::invalid_value, true);
    EXPECT_EQ(device.submit({}).failure, Failure::invalid_value);
    device.stop_failing();
    EXPECT_EQ(device.submit({}).failure, Failure::none);
    EXPECT_TRUE(device.create_buffer({.label = "a", .size = 4}, {}));
}

/// Reads a back buffer of two numbers.
struct Two {
    Readback state;
    std::array<std::uint32_t, 2> values{};
};
Two read_two(RecordingDevice& device, BufferHandle buffer) {
    Two two{};
    two.state = device.read_buffer(buffer, std::as_writable_bytes(std::span(two.values)));
    return two;
}

class RecordingReadback : public RecordingTest {
protected:
    RecordingReadback() {
        source = device.create_buffer({.label = "source", .size = 8}, {}).handle;
        back = read_back(8);
    }
    void copy(std::uint32_t first) {
        CommandList list;
        const std::array<std::uint32_t, 2> values = {first, first + 1};
        list.update(source, 0, std::span<const std::uint32_t>{values});
        list.add(CopyBuffer{source, back});
        EXPECT_THAT(misuses_of(list), IsEmpty());
    }
    BufferHandle source, back;
};

TEST_F(RecordingReadback, GivesWhatWasCopiedOnceAndThenNothing) {
    EXPECT_EQ(read_two(device, back).state, Readback::empty);
    copy(7);
    const Two two = read_two(device, back);
    EXPECT_EQ(two.state, Readback::done);
    EXPECT_THAT(two.values, ElementsAre(7u, 8u));
    EXPECT_EQ(read_two(device, back).state, Readback::empty);
}

TEST_F(RecordingReadback, APartOfABufferIsCopiedToItsPlaceAndNothingElseChanges) {
    const BufferHandle larger = device.create_buffer({.label = "larger", .size = 16}, {}).handle;
    const std::array<std::uint32_t, 4> before = {1, 2, 3, 4};
    CommandList list;
    list.update(larger, 0, std::span<const std::uint32_t>{before});
    const std::array<std::uint32_t, 2> values = {70, 80};
    list.update(source, 0, std::span<const std::uint32_t>{values});
    list.add(CopyBuffer{source, larger, 4, 8, 4});
    EXPECT_THAT(misuses_of(list), IsEmpty());
    std::array<std::uint32_t, 4> after{};
    ASSERT_EQ(device.buffer_bytes(larger).size(), sizeof after);
    std::memcpy(after.data(), device.buffer_bytes(larger).data(), sizeof after);
    EXPECT_THAT(after, ElementsAre(1u, 2u, 80u, 4u));
}

TEST_F(RecordingReadback, CanBeLateAndIsInTimeAfterFinish) {
    device.delay_readbacks(2);
    copy(1);
    EXPECT_EQ(read_two(device, back).state, Readback::pending);
    device.submit({});
    EXPECT_EQ(read_two(device, back).state, Readback::pending);
    device.submit({});
    EXPECT_EQ(read_two(device, back).state, Readback::done);
    copy(2);
    EXPECT_EQ(read_two(device, back).state, Readback::pending);
    device.finish();
    EXPECT_EQ(read_two(device, back).state, Readback::done);
}

TEST_F(RecordingReadback, AnswersAsScripted) {
    const std::array<std::uint32_t, 1> answer = {42};
    const auto bytes = std::as_bytes(std::span(answer));
    device.script_readback("ba", {bytes.begin(), bytes.end()});
    EXPECT_EQ(read_two(device, back).state, Readback::empty) << "nothing was copied, so nothing is answered";
    copy(7);
    EXPECT_THAT(read_two(device, back).values, ElementsAre(42u, 0u));
}

TEST_F(RecordingReadback, IsACallThatCanFail) {
    copy(7);
    device.fail_call(device.calls(), Failure::out_of_memory);
    EXPECT_EQ(read_two(device, back).state, Readback::failed);
    EXPECT_TRUE(device.resource_calls().back().failed);
    EXPECT_EQ(read_two(device, back).state, Readback::empty) << "what was lost does not come back";
    device.fail_from(device.calls(), Failure::out_of_memory, false);
    copy(8);
    EXPECT_EQ(read_two(device, back).state, Readback::done) << "a fault of creations spares it";
}

TEST_F(RecordingTest, DestroyingCountsAsNoCall) {
    const std::uint64_t before = device.calls();
    device.destroy(other);
    EXPECT_EQ(device.calls(), before);
}

TEST_F(RecordingTest, LabelsFailUntilStopped) {
    device.fail_label("shadow", Failure::compile_failed);
    EXPECT_EQ(device.create_program({"spot shadow", "v", "f"}).failure, Failure::compile_failed);
    EXPECT_EQ(device.create_texture({.label = "shadow map"}, {}).failure, Failure::compile_failed);
    EXPECT_EQ(device.create_buffer({.label = "shadow views", .size = 4}, {}).failure, Failure::compile_failed);
    EXPECT_EQ(device.create_target({.label = "shadow", .colours = {{colour}}}).failure, Failure::compile_failed);
    EXPECT_TRUE(device.create_program({"lighting", "v", "f"}));
    device.stop_failing();
    EXPECT_TRUE(device.create_program({"spot shadow", "v", "f"}));
}

TEST_F(RecordingTest, TimersReportZeroWhenTimingIsOn) {
    CommandList list;
    list.add(BeginTimer{5});
    list.add(EndTimer{5});
    list.add(BeginTimer{6});
    list.add(EndTimer{6});
    device.submit(list);
    EXPECT_THAT(device.take_timings(), IsEmpty());
    device.set_timing(TimingMode::query);
    device.submit(list);
    const std::vector<Timing> timings = device.take_timings();
    ASSERT_THAT(timings, SizeIs(2));
    EXPECT_EQ(timings[0].id, 5u);
    EXPECT_EQ(timings[1].id, 6u);
    EXPECT_EQ(timings[1].submission, 1u);
    EXPECT_EQ(timings[0].gpu_us, 0.0);
    EXPECT_THAT(device.take_timings(), IsEmpty());
}

TEST_F(RecordingTest, ReadingGivesZerosOfTheRightSizeOnly) {
    std::vector<std::byte> out(64 * 32 * 4, std::byte{9});
    EXPECT_TRUE(device.read_texture(depth, 0, out));
    EXPECT_THAT(out, Each(std::byte{0}));
    EXPECT_FALSE(device.read_texture(depth, 1, out));
    out.pop_back();
    EXPECT_FALSE(device.read_texture(depth, 0, out));
}

TEST_F(RecordingTest, DestroyingNothingDoesNothing) {
    device.forget();
    device.destroy(TextureHandle{});
    device.destroy(TargetHandle{});
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(device.resource_calls(), IsEmpty());
}

}  // namespace
}  // namespace gnomon::gl
