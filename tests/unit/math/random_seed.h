#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string_view>

namespace gnomon {

/// The seed of every run that names none, so that each gives the same result. A date.
constexpr std::uint64_t kKnownSeed = 20261122;

/// Returns the number in GNOMON_TEST_SEED, a drawn one if it is `random`, or kKnownSeed if it is not set.
inline std::uint64_t test_seed() {
    const char* given = std::getenv("GNOMON_TEST_SEED");
    if (given == nullptr) return kKnownSeed;
    return std::string_view(given) == "random" ? std::random_device{}() : std::strtoull(given, nullptr, 10);
}

/// Returns whether a run explores seeds. It takes shorter walks of more worlds: many_seeds tries hundreds.
inline bool is_exploring() { return std::getenv("GNOMON_TEST_SEED") != nullptr; }

/// Returns test_seed() for a property test, printed so that a failure can be repeated.
inline std::uint64_t print_seed() {
    const std::uint64_t seed = test_seed();
    std::cout << "seed " << seed << '\n';
    ::testing::Test::RecordProperty("seed", std::to_string(seed));
    return seed;
}

}  // namespace gnomon
