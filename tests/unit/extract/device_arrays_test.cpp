#include "systems/device_arrays.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numeric>

#include "engine/gl/device_recording.h"

namespace gnomon {
namespace {

using ::testing::IsEmpty;

/// Two arrays with common places, of 4 and of 16 bytes.
class DeviceArraysTest : public ::testing::Test {
protected:
    DeviceArraysTest() : arrays(device) {
        for (const auto& [i, label, stride] : {std::tuple(0u, "small", 4u), std::tuple(1u, "large", 16u)})
            arrays.put(i, {label, stride, stride == 16, device.create_buffer({label, stride, gl::BufferUse::updated, stride == 16}, {}).handle});
        arrays.start(0, 0, true);
    }
    void TearDown() override {
        arrays = DeviceArrays();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    /// Takes places and writes numbers from `value` on.
    std::uint32_t add(std::uint32_t count, std::uint32_t value) {
        const std::uint32_t first = arrays.take(count, true, list);
        if (first == DeviceArrays::kNone) return first;
        std::vector<std::uint32_t> numbers(count), large(std::size_t{4} * count);
        std::iota(numbers.begin(), numbers.end(), value);
        std::iota(large.begin(), large.end(), 4 * value);
        arrays.write(0, first, std::span<const std::uint32_t>(numbers), list);
        arrays.write(1, first, std::span<const std::uint32_t>(large), list);
        return first;
    }
    void submit() {
        device.submit(list);
        list.clear();
        arrays.submitted();
    }
    std::uint32_t word(std::size_t array, std::size_t at) const {
        std::uint32_t value = 0;
        std::memcpy(&value, device.buffer_bytes(arrays.buffer(array)).data() + 4 * at, sizeof value);
        return value;
    }
    void expect(std::uint32_t first, std::uint32_t count, std::uint32_t value) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(word(0, first + i), value + i) << first << " " << i;
            for (std::uint32_t c = 0; c < 4; ++c) EXPECT_EQ(word(1, 4 * (first + i) + c), 4 * (value + i) + c);
        }
    }

    gl::RecordingDevice device;
    gl::CommandList list;
    DeviceArrays arrays;
};

TEST_F(DeviceArraysTest, KeepNumbersAndContentsWhileTheyGrow) {
    const std::uint32_t first = add(40, 1000);
    const std::uint32_t second = add(50, 2000);
    EXPECT_EQ(second, 40u);
    EXPECT_EQ(arrays.places(), 128u);
    submit();
    expect(first, 40, 1000);
    expect(second, 50, 2000);
    const std::uint32_t third = add(300, 3000);
    EXPECT_EQ(arrays.places(), 512u);
    submit();
    expect(first, 40, 1000);
    expect(second, 50, 2000);
    expect(third, 300, 3000);
    EXPECT_EQ(device.live_count(), 2u) << "what was outgrown is free";
    EXPECT_EQ(device.live_bytes(), arrays.bytes());
}

TEST_F(DeviceArraysTest, ReuseWhatWasGivenBackWithoutGrowing) {
    const std::uint32_t first = add(60, 1000), second = add(4, 2000);
    submit();
    arrays.give(first, 60);
    const std::size_t calls = device.calls();
    EXPECT_EQ(add(60, 5000), first);
    EXPECT_EQ(device.calls(), calls);
    submit();
    expect(first, 60, 5000);
    expect(second, 4, 2000);
}

TEST_F(DeviceArraysTest, WithoutRoomForOneOfThemNoneChanges) {
    const std::uint32_t first = add(60, 1000);
    submit();
    const gl::BufferHandle small = arrays.buffer(0), large = arrays.buffer(1);
    device.fail_label("large", gl::Failure::out_of_memory);
    EXPECT_EQ(add(10, 2000), DeviceArrays::kNone);
    EXPECT_EQ(arrays.buffer(0), small);
    EXPECT_EQ(arrays.buffer(1), large);
    EXPECT_EQ(device.live_count(), 2u);
    EXPECT_THAT(list.commands, IsEmpty());
    EXPECT_EQ(add(4, 2000), 60u) << "which fits";
    device.stop_failing();
    EXPECT_EQ(add(10, 3000), 64u);
    submit();
    expect(first, 60, 1000);
    expect(60, 4, 2000);
    expect(64, 10, 3000);
}

TEST_F(DeviceArraysTest, GrowOnlyAsFarAsNeededWhereTheDeviceHasNoMore) {
    add(60, 1000);
    submit();
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    EXPECT_EQ(add(10, 2000), 60u);
    EXPECT_EQ(arrays.places(), 70u) << "not 128";
    submit();
    expect(0, 60, 1000);
    expect(60, 10, 2000);
}

TEST_F(DeviceArraysTest, ShrinkToWhatIsLeftAtTheirBeginning) {
    const std::uint32_t first = add(40, 1000), second = add(2000, 2000), third = add(40, 3000);
    submit();
    EXPECT_EQ(arrays.places(), 4096u);
    const auto shrink_for = [&](std::uint32_t frames) {
        for (std::uint32_t i = 0; i < frames; ++i) arrays.shrink(list);
    };
    arrays.give(second, 2000);
    shrink_for(2 * DeviceArrays::kHoldFrames);
    EXPECT_EQ(arrays.places(), 4096u) << "the last ones stay where they are";
    arrays.give(third, 40);
    shrink_for(DeviceArrays::kHoldFrames - 1);
    EXPECT_EQ(arrays.places(), 4096u) << "they may come again";
    EXPECT_EQ(add(2100, 9000), 40u);
    shrink_for(1);
    arrays.give(40, 2100);
    shrink_for(DeviceArrays::kHoldFrames - 1);
    EXPECT_EQ(arrays.places(), 4096u);
    shrink_for(1);
    EXPECT_EQ(arrays.places(), DeviceArrays::kLeastPlaces);
    submit();
    expect(first, 40, 1000);
    EXPECT_EQ(device.live_bytes(), arrays.bytes());
}

TEST_F(DeviceArraysTest, FixedBuffersAreReplacedBeforeTheyAreWritten) {
    DeviceArrays fixed(device);
    const std::array<std::uint32_t, 3> values = {7, 8, 9};
    fixed.put(0, {"fixed", 4, false, device.create_buffer({"fixed", sizeof values, gl::BufferUse::fixed}, std::as_bytes(std::span(values))).handle});
    fixed.start(3, 3, false);
    fixed.give(1, 1);
    const std::uint32_t place = fixed.take(1, true, list);
    EXPECT_EQ(place, 1u);
    const std::uint32_t ten = 10;
    fixed.write(0, place, std::span<const std::uint32_t>(&ten, 1), list);
    device.submit(list);
    list.clear();
    std::array<std::uint32_t, 3> after{};
    std::memcpy(after.data(), device.buffer_bytes(fixed.buffer(0)).data(), sizeof after);
    EXPECT_THAT(after, ::testing::ElementsAre(7u, 10u, 9u));
}

}  // namespace
}  // namespace gnomon
