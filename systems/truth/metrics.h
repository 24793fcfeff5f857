#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

/// Distance of a picture of visibility from the truth.
namespace gnomon::truth {

/// Displacement of shadow edges in pixels; positive: measured shadow too large, negative: too small. Over all places
/// where the truth changes between two neighbouring scored pixels.
struct EdgeDisplacement {
    std::size_t places = 0;      // includes lost ones
    std::size_t lost = 0;        // no measured edge within kEdgeSearchPx: counted with that distance
    std::size_t unmeasured = 0;  // the search left the scored set (near a silhouette): not in any other figure
    double mean_signed_px = 0.0;
    double mean_px = 0.0, p95_px = 0.0, p99_px = 0.0, max_px = 0.0;  // over absolute values
    /// Place of an edge. `off_px`: displacement, kEdgeSearchPx if lost. `dark`, `bright`: the pixels on both sides.
    /// `middle_px`: middle between their centres (integers are centres, row 0 is the first). `rise`: unit vector from
    /// shadow to light across the edge.
    struct Place {
        double off_px = 0.0;
        std::size_t dark = 0, bright = 0;
        glm::dvec2 middle_px{0.0}, rise{0.0};
    };
    std::vector<Place> each;
};

/// Counts of pixels for one light. All but the first two count within F: scored and not ambiguous.
struct Metrics {
    std::size_t ambiguous = 0;          // scored, but excluded because the truth depends on the last digits
    std::size_t coverage_mismatch = 0;  // whole picture: surface in one picture, none (or NaN) in the other
    std::size_t scored = 0;             // |F|
    std::size_t wrong = 0;              // false_shadow + false_light + uncovered
    std::size_t false_shadow = 0;       // truth lit, measured < 0.5
    std::size_t false_light = 0;        // truth shadowed, measured >= 0.5
    std::size_t uncovered = 0;          // truth has a surface, the measured picture none: wrong for any truth
    std::size_t acne = 0, leak = 0;     // false shadow and false light farther than kEdgeBandPx from every true edge
    EdgeDisplacement edge;

    double fraction(std::size_t pixels) const {
        return scored == 0 ? 0.0 : static_cast<double>(pixels) / static_cast<double>(scored);
    }
};

inline constexpr double kEdgeBandPx = 2.0;
inline constexpr double kEdgeSearchPx = 8.0;

/// Pictures as in --visibility, all of size width × height, rows in any order. `truth` is 0 or 1 where scored; `scored`
/// and `ambiguous` are flags. A true edge lies midway between two 4-neighbours that are scored (ambiguous or not) and
/// differ. Spans of other sizes are a programmer error (assert).
struct ComparedPictures {
    glm::uvec2 size_px{0, 0};
    std::span<const float> measured, truth;
    std::span<const std::uint8_t> scored, ambiguous;
};
Metrics compare(const ComparedPictures& pictures);

}  // namespace gnomon::truth
