#include <gmock/gmock.h>

#include "tests/gl/device_fixture.h"

// Compute programs, copies between buffers, and reading back without blocking.
namespace gnomon {
namespace {

using gl::Failure;
using gl::Readback;
using ::testing::ElementsAre;

class DeviceReadback : public DeviceTest {
protected:
    static constexpr std::uint64_t kBytes = 4 * sizeof(std::uint32_t);
    void SetUp() override {
        DeviceTest::SetUp();
        if (HasFatalFailure()) return;
        counts = keep(device().create_buffer({.label = "counts", .size = kBytes}, {}));
        back = keep(device().create_buffer({.label = "back", .size = kBytes, .use = gl::BufferUse::read_back}, {}));
        doubler = keep(device().create_program({.label = "doubler",
                                                .compute = "#version 450 core\nlayout(local_size_x = 4) "
                                                           "in;\nlayout(std430, binding = 3) buffer B { uint n[]; };\n"
                                                           "void main() { n[gl_LocalInvocationIndex] *= 2u; }\n"}));
    }
    /// Records commands that double 1, 2, 3 and 4 and copy them to the buffer that is read back.
    gl::CommandList doubling() const {
        constexpr std::array<std::uint32_t, 4> numbers = {1, 2, 3, 4};
        gl::CommandList list;
        list.update(counts, 0, std::span<const std::uint32_t>(numbers));
        list.add(gl::BindStorage{3, counts});
        list.add(gl::Dispatch{doubler, 1, 1});
        list.add(gl::CopyBuffer{counts, back});
        return list;
    }
    Readback read_back() { return device().read_buffer(back, std::as_writable_bytes(std::span(values))); }

    gl::BufferHandle counts, back;
    gl::ProgramHandle doubler;
    std::array<std::uint32_t, 4> values{};
};

TEST_F(DeviceReadback, WhatAComputeProgramWroteComesBackOnce) {
    EXPECT_EQ(read_back(), Readback::empty);
    run(doubling());
    device().finish();
    EXPECT_EQ(read_back(), Readback::done);
    EXPECT_THAT(values, ElementsAre(2u, 4u, 6u, 8u));
    EXPECT_EQ(read_back(), Readback::empty);
}

// What shaders add up begins at 0 in each frame, however often the buffer was written by the processor and by shaders.
TEST_F(DeviceReadback, WhatShadersWroteIsClearedInTheListsOrder) {
    for (int frame = 0; frame < 16; ++frame) {
        gl::CommandList list = doubling();
        list.add(gl::ClearBuffer{counts, 4, 8});
        list.add(gl::Dispatch{doubler, 1, 1});
        list.add(gl::CopyBuffer{counts, back});
        run(list);
        device().finish();
        EXPECT_EQ(read_back(), Readback::done);
        EXPECT_THAT(values, ElementsAre(4u, 0u, 0u, 16u)) << frame;
    }
}

// Bytes of lists lie in places that are used again, and grow: none may be overwritten before the device has read it.
TEST_F(DeviceReadback, UpdatesOfManyListsArriveWhateverTheirSizes) {
    constexpr std::size_t kSizes[] = {4, 100, 70'000, 12, 300'000, 5u << 20, 17u << 20, 8};
    std::vector<gl::BufferHandle> updated, copied;
    for (const std::size_t size : kSizes) {
        updated.push_back(keep(device().create_buffer({.label = "updated", .size = size}, {})));
        copied.push_back(
            keep(device().create_buffer({.label = "copied", .size = size, .use = gl::BufferUse::read_back}, {})));
    }
    constexpr std::uint32_t kRounds = 5;
    const auto value = [](std::uint32_t round, std::size_t i, std::size_t byte) {
        return static_cast<std::byte>(round * 31 + i * 7 + byte % 251);
    };
    for (std::uint32_t round = 0; round < kRounds; ++round)
        for (std::size_t i = 0; i < updated.size(); ++i) {
            std::vector<std::byte> bytes(kSizes[i]);
            for (std::size_t byte = 0; byte < bytes.size(); ++byte) bytes[byte] = value(round, i, byte);
            gl::CommandList list;
            list.update<std::byte>(updated[i], 0, bytes);
            list.add(gl::CopyBuffer{updated[i], copied[i]});
            run(list);
        }
    device().finish();
    for (std::size_t i = 0; i < copied.size(); ++i) {
        std::vector<std::byte> bytes(kSizes[i]);
        EXPECT_EQ(device().read_buffer(copied[i], bytes), Readback::done);
        std::size_t wrong = 0;
        for (std::size_t byte = 0; byte < bytes.size(); ++byte) wrong += bytes[byte] != value(kRounds - 1, i, byte);
        EXPECT_EQ(wrong, 0u) << kSizes[i];
    }
}

TEST_F(DeviceReadback, APartOfABufferIsCopiedToItsPlaceAndNothingElseChanges) {
    gl::CommandList list = doubling();
    list.add(gl::CopyBuffer{fixed_buffer<std::uint32_t>({70, 80}), counts, 4, 8, 4});
    list.add(gl::CopyBuffer{counts, back});
    run(list);
    device().finish();
    EXPECT_EQ(read_back(), Readback::done);
    EXPECT_THAT(values, ElementsAre(2u, 4u, 80u, 8u));
}

TEST_F(DeviceReadback, ComesInTimeWithoutAFinishIfOneAsksAgain) {
    run(doubling());
    Readback state = Readback::pending;
    constexpr int kMostTries = 10'000'000;  // some microseconds each
    for (int i = 0; i < kMostTries && state == Readback::pending; ++i) state = read_back();
    EXPECT_EQ(state, Readback::done);
    EXPECT_THAT(values, ElementsAre(2u, 4u, 6u, 8u));
}

TEST_F(DeviceReadback, EachListWorksOnWhatTheLastOneLeft) {
    run(doubling());
    gl::CommandList again;
    again.add(gl::BindStorage{3, counts});
    again.add(gl::Dispatch{doubler, 1, 1});
    again.add(gl::CopyBuffer{counts, back});
    run(again);
    device().finish();
    EXPECT_EQ(read_back(), Readback::done);
    EXPECT_THAT(values, ElementsAre(4u, 8u, 12u, 16u));
}

TEST_F(DeviceReadback, OnlyWholeBuffersToReadBackAreRead) {
    run(doubling());
    device().finish();
    std::array<std::byte, 8> half{};
    EXPECT_EQ(device().read_buffer(back, half), Readback::failed);
    EXPECT_EQ(device().read_buffer(counts, std::as_writable_bytes(std::span(values))), Readback::failed);
    EXPECT_EQ(device().read_buffer({999}, half), Readback::failed);
    EXPECT_EQ(read_back(), Readback::done) << "which took nothing away";
}

TEST_F(DeviceReadback, ADestroyedBufferIsForgottenOnItsWay) {
    const auto other =
        device().create_buffer({.label = "other", .size = kBytes, .use = gl::BufferUse::read_back}, {}).handle;
    gl::CommandList list;
    list.add(gl::CopyBuffer{counts, other});
    run(list);
    device().destroy(other);
    EXPECT_EQ(device().read_buffer(other, std::as_writable_bytes(std::span(values))), Readback::failed);
}

TEST_F(DeviceReadback, MisuseIsLeftOutAndTold) {
    const auto refused = [&](const gl::Command& command, bool in_pass = false) {
        gl::CommandList list;
        if (in_pass) list.add(keeping(target));
        list.add(command);
        if (in_pass) list.add(gl::EndPass{});
        return device().submit(list).failure;
    };
    EXPECT_EQ(refused(gl::Dispatch{doubler, 1, 1}), Failure::none);
    EXPECT_EQ(refused(gl::Dispatch{doubler, 1, 1}, true), Failure::invalid_value);
    EXPECT_EQ(refused(gl::Dispatch{doubler, 1, 0}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::Dispatch{{999}, 1, 1}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, back}), Failure::none);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, back}, true), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, counts}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, {999}}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, fixed_buffer<std::uint32_t>({1, 2, 3, 4})}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{fixed_buffer<std::uint32_t>({1}), counts}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{fixed_buffer<std::uint32_t>({1}), counts, 0, 4, 4}), Failure::none);
    EXPECT_EQ(refused(gl::CopyBuffer{fixed_buffer<std::uint32_t>({1}), counts, 0, kBytes, 4}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{fixed_buffer<std::uint32_t>({1}), counts, 4, 0, 4}), Failure::invalid_value);
    EXPECT_EQ(refused(gl::CopyBuffer{counts, back, 0, 0, 4}), Failure::invalid_value) << "read back as a whole";
    EXPECT_EQ(refused(gl::UpdateBuffer{back, 0, 0, 0}), Failure::invalid_value);
}

TEST_F(DeviceReadback, APassAfterADispatchSetsItsPipelineAnew) {
    const auto white = full_screen("result = vec4(1.0);");
    gl::CommandList list;
    list.add(gl::SetPipeline{{.program = white}});
    list.add(gl::Dispatch{doubler, 1, 1});
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = white}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(pixels(), ::testing::Each(Rgba{255, 255, 255, 255}));
}

TEST_F(DeviceReadback, AComputeProgramWithAMistakeIsRefused) {
    EXPECT_EQ(device().create_program({.label = "bad", .compute = "#version 450 core\nvoid main( {}\n"}).failure,
              Failure::compile_failed);
    take_messages();
}

}  // namespace
}  // namespace gnomon
