#include <gtest/gtest.h>

#include <cctype>
#include <iostream>

#include "tests/long_run.h"
#include "tests/system/fault_play.h"

/// Fails each device call of set-up and three frames in turn, in each way, once and lastingly.
namespace gnomon {
namespace {

struct Scenario {
    const char* name;
    FaultScene (*make)();
};

/// Returns calls from a failing one to the next: 1 in a long run. Else failures and spans begin at calls of their own,
/// so that each call fails in some where every failure is played.
std::uint64_t stride() { return kSanitized ? 8 : is_long_run() ? 1 : 3; }

std::uint64_t first_call(gl::Failure failure, FaultSpan span) {
    return (static_cast<std::uint64_t>(failure) + static_cast<std::uint64_t>(span)) % stride();
}

class EveryCallFails : public ::testing::TestWithParam<std::tuple<Scenario, gl::Failure>> {};

TEST_P(EveryCallFails, WithoutAFrameAShadowOrAnObjectLostForGood) {
    const auto [scenario, failure] = GetParam();
    FaultPlay play(scenario.make());
    ASSERT_GT(play.calls(), 40u);
    std::size_t cases = 0;
    for (const FaultSpan span : {FaultSpan::once, FaultSpan::creations, FaultSpan::all_calls})
        for (std::uint64_t call = first_call(failure, span); call < play.calls(); call += stride()) {
            if (span == FaultSpan::creations && !play.is_creation(call)) continue;
            play.check({call, failure, span});
            ++cases;
        }
    std::cout << scenario.name << ", " << gl::to_text(failure) << ": " << cases << " cases, " << play.calls()
              << " calls\n";
    RecordProperty("cases", std::to_string(cases));
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<Scenario, gl::Failure>>& param) {
    std::string name = std::string(std::get<0>(param.param).name) + gl::to_text(std::get<1>(param.param));
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
}

INSTANTIATE_TEST_SUITE_P(
    EachFailure, EveryCallFails,
    ::testing::Combine(::testing::Values(Scenario{"Boxes", box_scene}, Scenario{"Courtyard", courtyard_scene},
                                         Scenario{"SampledCourtyard", sampled_courtyard_scene}),
                       ::testing::Values(gl::Failure::out_of_memory, gl::Failure::invalid_value,
                                         gl::Failure::incomplete_target, gl::Failure::compile_failed,
                                         gl::Failure::link_failed, gl::Failure::context_lost)),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    EachFailureOfCatchers, EveryCallFails,
    ::testing::Combine(::testing::Values(Scenario{"Catchers", catcher_scene}),
                       ::testing::Values(gl::Failure::out_of_memory, gl::Failure::incomplete_target,
                                         gl::Failure::compile_failed, gl::Failure::context_lost)),
    name_of);

/// Fails objects of rays and sheets for one reason only: the executor treats them in the same way for every reason.
INSTANTIATE_TEST_SUITE_P(
    EachFailureOfRays, EveryCallFails,
    ::testing::Combine(::testing::Values(Scenario{"Exact", exact_scene}), ::testing::Values(gl::Failure::out_of_memory)),
    name_of);

}  // namespace
}  // namespace gnomon
