#pragma once
#include <optional>
#include <string>

namespace gnomon::bench {

/// What the defaults promise of every light in every scene, as shares of the pixels that are scored: the bounds of
/// docs/cost.md; and no acne. They cannot be had where shadows are narrower than their map's texels.
inline constexpr double kMostWrongByDefault = 0.0005, kMostLeakByDefault = 0.0001;

/// What a light is judged by, as shares of its scored pixels. Far: what neither an edge nor the map's texels there
/// explain (oracle::FarErrors); empty: nobody asked.
struct PromisedErrors {
    double wrong = 0.0, leak = 0.0, acne = 0.0;
    std::optional<double> false_shadow_far, false_light_far;
};

/// What is above its bound, how far, and how much of it lies nearer to a true edge than half a texel of the map is wide
/// there: "0.101 % wrong (0.05 %), 93.8 % of that within ...; ...". Empty: nothing is.
std::string promise_words(const PromisedErrors& errors);

}  // namespace gnomon::bench
