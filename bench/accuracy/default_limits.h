#pragma once
#include <optional>
#include <string>

namespace gnomon::bench {

/// Bounds that the defaults meet for every light in every scene, as shares of scored pixels (docs/results/cost.md). No
/// acne is allowed, either. Shadows narrower than their map's texels are beyond them.
inline constexpr double kMostWrongByDefault = 0.0005, kMostLeakByDefault = 0.0001;

/// Errors that a light is judged by, as shares of its scored pixels. Far: neither an edge nor the map's texels there
/// explain them (oracle::FarErrors); empty: not computed.
struct JudgedErrors {
    double wrong = 0.0, leak = 0.0, acne = 0.0;
    std::optional<double> false_shadow_far, false_light_far;
};

/// Describes the errors above their bounds, each with the share that lies within half a texel of the map from a true
/// edge. Example: "0.101 % wrong (0.05 %), 93.8 % of that within ...; ...". Empty: none is above.
std::string missed_limits(const JudgedErrors& errors);

}  // namespace gnomon::bench
