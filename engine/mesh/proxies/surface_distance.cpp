#include "engine/mesh/proxies/surface_distance.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace gnomon::assets {
namespace {

constexpr double kUnlimited_m = std::numeric_limits<double>::infinity();
/// Part of a bound by which it may exceed what was found.
constexpr double kSpare = 0.5;
/// Halvings of a triangle's sides. The bound of a piece that is left is true, if not near.
constexpr int kMostHalvings = 10;
/// Quarterings of all pieces of a surface, per triangle and beside that: they bound the time.
constexpr std::size_t kQuarterings = 64, kMoreQuarterings = 256;

std::size_t most_quarterings(std::span<const TriangleCorners> from) {
    return kQuarterings * from.size() + kMoreQuarterings;
}

struct Piece {
    TriangleCorners corners;
    int halvings = 0;
};

/// Distances of pieces from a surface. The triangle that was near the last piece is tried first: it is mostly near the
/// next one, and saves a search.
class PieceDistances {
public:
    PieceDistances(const TriangleTree& to, const std::vector<bool>& left_out) : to_(to), left_out_(left_out) {}

    /// Bounds the distance of all of a piece by that of its corners from the triangle that was near last.
    double at_corners_m(const TriangleCorners& c) const {
        if (last_ == kNone) return kUnlimited_m;
        double most_m = 0.0;
        for (const glm::dvec3& corner : c) most_m = std::max(most_m, distance_to(to_.triangle(last_), corner));
        return most_m;
    }
    /// Returns the distance of a point; infinite if the surface has no triangles.
    double at_point_m(const glm::dvec3& p) {
        const double last_m = last_ == kNone ? kUnlimited_m : distance_to(to_.triangle(last_), p);
        const NearTriangle near = to_.nearest(p, last_m, left_out_);
        if (!(near.distance_m < last_m)) return last_m;
        last_ = near.triangle;
        return near.distance_m;
    }

private:
    static constexpr std::uint32_t kNone = ~0u;
    const TriangleTree& to_;
    const std::vector<bool>& left_out_;
    std::uint32_t last_ = kNone;
};

glm::dvec3 middle_of(const TriangleCorners& c) { return (c[0] + c[1] + c[2]) / 3.0; }

double radius_m(const TriangleCorners& c, const glm::dvec3& middle) {
    return std::max({glm::distance(c[0], middle), glm::distance(c[1], middle), glm::distance(c[2], middle)});
}

void push_quarters(const Piece& piece, std::vector<Piece>& waiting) {
    const auto& [a, b, c] = piece.corners;
    const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    for (const TriangleCorners& part : {TriangleCorners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        waiting.push_back({part, piece.halvings + 1});
}

/// Result of judging a piece.
enum class Verdict : std::uint8_t { settled, split, given_up };

/// Judges all pieces of the triangles, and quarters those to split. Returns false once a piece is given up, or
/// after most_quarterings().
template <class Judge>
bool settles(std::span<const TriangleCorners> triangles, const Judge& judge) {
    std::vector<Piece> waiting;
    std::size_t left = most_quarterings(triangles);
    for (const TriangleCorners& triangle : triangles) {
        waiting.assign(1, {triangle, 0});
        while (!waiting.empty()) {
            const Piece piece = waiting.back();
            waiting.pop_back();
            const Verdict verdict = judge(piece);
            if (verdict == Verdict::settled) continue;
            if (verdict == Verdict::given_up || left == 0) return false;
            push_quarters(piece, waiting);
            --left;
        }
    }
    return true;
}

}  // namespace

SurfaceDistance surface_distance(std::span<const TriangleCorners> from, const TriangleTree& to, double slack_m) {
    SurfaceDistance found;
    const std::vector<bool> all;
    PieceDistances distances(to, all);
    // What corners find keeps the pieces few.
    for (const TriangleCorners& triangle : from)
        found.least_m = std::max(found.least_m, distances.at_point_m(triangle[0]));
    const auto is_near = [&](double most_m) {
        return most_m <= std::max(found.least_m * (1.0 + kSpare), found.least_m + slack_m);
    };
    const bool settled = settles(from, [&](const Piece& piece) {
        double most_m = distances.at_corners_m(piece.corners);
        if (!is_near(most_m)) {
            const glm::dvec3 middle = middle_of(piece.corners);
            const double middle_m = distances.at_point_m(middle);
            found.least_m = std::max(found.least_m, middle_m);
            most_m = std::min(middle_m + radius_m(piece.corners, middle), distances.at_corners_m(piece.corners));
        }
        if (!is_near(most_m) && piece.halvings < kMostHalvings) return Verdict::split;
        found.most_m = std::max(found.most_m, most_m);
        return Verdict::settled;
    });
    return settled ? found : SurfaceDistance{found.least_m, kUnlimited_m};
}

bool lies_within(std::span<const TriangleCorners> from, const TriangleTree& to, double limit_m,
                 const std::vector<bool>& left_out) {
    PieceDistances distances(to, left_out);
    return settles(from, [&](const Piece& piece) {
        if (distances.at_corners_m(piece.corners) <= limit_m) return Verdict::settled;
        const glm::dvec3 middle = middle_of(piece.corners);
        const double middle_m = distances.at_point_m(middle);
        if (middle_m + radius_m(piece.corners, middle) <= limit_m) return Verdict::settled;
        if (distances.at_corners_m(piece.corners) <= limit_m) return Verdict::settled;
        return middle_m <= limit_m && piece.halvings < kMostHalvings ? Verdict::split : Verdict::given_up;
    });
}

}  // namespace gnomon::assets
