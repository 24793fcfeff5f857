#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>

namespace gnomon {

/// A seed for a property test, printed so that a failure can be repeated with GNOMON_TEST_SEED=<seed>.
inline std::uint64_t print_seed() {
    const char* fixed = std::getenv("GNOMON_TEST_SEED");
    const std::uint64_t seed = fixed ? std::strtoull(fixed, nullptr, 10) : std::random_device{}();
    std::cout << "seed " << seed << '\n';
    ::testing::Test::RecordProperty("seed", std::to_string(seed));
    return seed;
}

}  // namespace gnomon
