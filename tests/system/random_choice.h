#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>

namespace gnomon {

/// Random numbers and places of a test's world, the same for the same seed.
class RandomChoice {
public:
    explicit RandomChoice(std::uint64_t seed) : random_(seed) {}

    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    bool chance(double share) { return number(0.0, 1.0) < share; }
    /// Returns a place above the arena's ground.
    glm::dvec3 place(double low_m, double high_m) {
        const double x = number(-kArena_m, kArena_m), y = number(low_m, high_m), z = number(-kArena_m, kArena_m);
        return {x, y, z};
    }

    static constexpr double kArena_m = 8.0;  // half of its side

protected:
    std::mt19937_64 random_;
};

}  // namespace gnomon
