#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

/// How far a picture of visibility is from the truth.
namespace gnomon::truth {

/// Distances in pixels, positive where the measured shadow is too large, negative where too small. Over all places
/// where the truth changes between two neighbouring scored pixels.
struct EdgeDisplacement {
    std::size_t places = 0;      // measured, lost ones included
    std::size_t lost = 0;        // no measured edge within kEdgeSearchPx: counted as that far off
    std::size_t unmeasured = 0;  // the search left the scored set (a silhouette is near): in no other figure
    double mean_signed_px = 0.0;
    double mean_px = 0.0, p95_px = 0.0, p99_px = 0.0, max_px = 0.0;  // of the absolute values
    /// One place: how far off (kEdgeSearchPx if lost), the two pixels it lies between, the middle between their centres
    /// (whole numbers are centres, row 0 is the first), and the way from shadow to light across the edge, unit.
    struct Place {
        double off_px = 0.0;
        std::size_t dark = 0, bright = 0;
        glm::dvec2 middle_px{0.0}, rise{0.0};
    };
    std::vector<Place> each;
};

/// Pixels of one light. All but the first two count within F: scored and not ambiguous.
struct Metrics {
    std::size_t ambiguous = 0;          // scored, but left out because the truth itself hangs on the last digits
    std::size_t coverage_mismatch = 0;  // whole picture: surface in one, none (or not a number) in the other
    std::size_t scored = 0;             // |F|
    std::size_t wrong = 0;              // false_shadow + false_light + uncovered
    std::size_t false_shadow = 0;       // truth lit, measured < 0.5
    std::size_t false_light = 0;        // truth shadowed, measured >= 0.5
    std::size_t uncovered = 0;          // truth sees a surface, the measured picture none: wrong whatever the truth is
    std::size_t acne = 0, leak = 0;     // false shadow and light farther than kEdgeBandPx from every true edge
    EdgeDisplacement edge;

    double fraction(std::size_t pixels) const {
        return scored == 0 ? 0.0 : static_cast<double>(pixels) / static_cast<double>(scored);
    }
};

inline constexpr double kEdgeBandPx = 2.0;
inline constexpr double kEdgeSearchPx = 8.0;

/// Pictures as of --visibility, all of size width × height, rows in any order. `truth` is 0 or 1 where scored;
/// `scored` and `ambiguous` are flags. A true edge lies midway between two 4-neighbours that are scored (ambiguous or
/// not) and differ. Spans of other sizes: programmer error (assert).
struct ComparedPictures {
    glm::uvec2 size_px{0, 0};
    std::span<const float> measured, truth;
    std::span<const std::uint8_t> scored, ambiguous;
};
Metrics compare(const ComparedPictures& pictures);

}  // namespace gnomon::truth
