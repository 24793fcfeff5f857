#include "sample_game/support/built_in_scenes/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/image/encode_image.h"

namespace gnomon::game {
namespace {

constexpr std::uint32_t kSize = 128;

/// Hashes two integers to 0..1 (PCG output permutation). Floating-point noise would differ between machines.
double noise(std::uint32_t x, std::uint32_t y) {
    std::uint32_t state = (x * 1664525u + y * 22695477u + 1013904223u) * 747796405u + 2891336453u;
    state = (state >> (state >> 28 & 15u) ^ state) * 277803737u;
    return static_cast<double>(state >> 22 & 1023u) / 1023.0;
}

struct Texel {
    glm::dvec3 colour{1.0};
    bool opaque = true;
};

template <class Paint>
std::vector<std::uint8_t> painted(Paint paint) {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(std::size_t{kSize} * kSize * 4u);
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            const Texel texel = paint(x, y);
            for (glm::length_t i = 0; i < 3; ++i)
                rgba.push_back(static_cast<std::uint8_t>(std::clamp(texel.colour[i], 0.0, 1.0) * 255.0));
            rgba.push_back(texel.opaque ? 255u : 0u);
        }
    }
    return encode_png(kSize, kSize, rgba);
}

struct Leaf {
    glm::dvec2 centre, along;  // in the unit square; `along` is unit
};

}  // namespace

std::vector<std::uint8_t> leaf_texture_png() {
    constexpr double kHalfLength = 0.16, kHalfWidth = 0.06;
    static constexpr std::array<std::array<double, 4>, 9> kLeaves{{{0.25, 0.25, 0.8, 0.6},
                                                                   {0.72, 0.22, -0.6, 0.8},
                                                                   {0.5, 0.45, 1.0, 0.0},
                                                                   {0.22, 0.68, 0.6, -0.8},
                                                                   {0.76, 0.7, 0.8, 0.6},
                                                                   {0.48, 0.8, 0.0, 1.0},
                                                                   {0.5, 0.17, 0.28, 0.96},
                                                                   {0.19, 0.47, -0.6, 0.8},
                                                                   {0.8, 0.46, 0.96, -0.28}}};
    return painted([&](std::uint32_t x, std::uint32_t y) {
        const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) / static_cast<double>(kSize);
        Texel texel{glm::dvec3(0.24, 0.36, 0.12),
                    false};  // colour also where cut out, so that filtering has no dark rim
        for (const auto& leaf : kLeaves) {
            const glm::dvec2 d = p - glm::dvec2(leaf[0], leaf[1]);
            const double along = (d.x * leaf[2] + d.y * leaf[3]) / kHalfLength;
            const double across = (d.x * leaf[3] - d.y * leaf[2]) / kHalfWidth;
            if (std::abs(across) > 1.0 - along * along) continue;
            texel.opaque = true;
            texel.colour += glm::dvec3(0.05, 0.12, 0.02) * (std::abs(across) < 0.12 ? 2.0 : across);
        }
        return texel;
    });
}

std::vector<std::uint8_t> cloth_texture_png() {
    constexpr double kHoles = 5.0, kHoleRadius = 0.2, kHoleRow = 0.35, kTeeth = 12.0, kHem = 0.9;
    return painted([](std::uint32_t x, std::uint32_t y) {
        const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) / static_cast<double>(kSize);
        const double stripe = std::fmod(p.x * kHoles * 2.0, 2.0) < 1.0 ? 1.0 : 0.55;
        Texel texel{glm::dvec3(0.75, 0.28 * stripe, 0.2 * stripe), true};
        const glm::dvec2 in_cell(std::fmod(p.x * kHoles, 1.0) - 0.5, (p.y - kHoleRow) * kHoles);
        const double tooth = std::abs(std::fmod(p.x * kTeeth, 1.0) - 0.5) * 2.0;
        texel.opaque = glm::length(in_cell) > kHoleRadius && p.y < kHem + (1.0 - kHem) * tooth;
        return texel;
    });
}

std::vector<std::uint8_t> paving_texture_png() {
    constexpr std::uint32_t kSlab = 64, kJoint = 3;
    return painted([](std::uint32_t x, std::uint32_t y) {
        const std::uint32_t row = y / kSlab;
        const std::uint32_t shifted = (x + row * (kSlab / 2u)) % kSize;
        const bool joint = y % kSlab < kJoint || shifted % kSlab < kJoint;
        const double slab = 0.08 * noise(shifted / kSlab + 7u, row + 3u);
        const double grain = 0.06 * noise(x, y);
        return Texel{joint ? glm::dvec3(0.42, 0.4, 0.38) + grain : glm::dvec3(0.62, 0.59, 0.55) + slab + grain, true};
    });
}

}  // namespace gnomon::game
