#include "bench/area_table/lobe_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace gnomon::bench {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kLeastAlpha = 1.0e-3, kLeastCosine = 1.0e-4;  // as in brdf.glsl
constexpr int kSide = 32;                                      // samples along a side of the unit square
constexpr double kHold = 1.0e-3;  // what a lean of alpha off the mean costs, beside a miss of at most 2
constexpr std::array<double, 4> kRound{0.0, 1.5, 1.5, 0.0};  // what narrow lobes are like, seen along the normal
constexpr double kLeastAbove = 0.5;                          // a lobe with its middle below the surface fits nothing
constexpr std::size_t kParameters = 4;
constexpr int kMostSteps = 150;
constexpr double kDone = 1.0e-4;  // relative spread of the simplex' values

using Parameters = std::array<double, kParameters>;  // lean, along, across, skew

/// Transform from the cosine's space, and its inverse.
struct Transform {
    glm::dmat3 forth{1.0}, back{1.0};
    double determinant = 1.0, above = 1.0;  // share of the lobe above the surface
};

Transform transform_of(const Parameters& p, double alpha, double cosine) {
    const double turn_rad = alpha * p[0] - std::acos(cosine), s = std::sin(turn_rad), c = std::cos(turn_rad);
    const glm::dmat3 turned(glm::dvec3(c, 0.0, s), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-s, 0.0, c));
    const glm::dmat3 stretched(glm::dvec3(alpha * p[1], 0.0, 0.0), glm::dvec3(0.0, alpha * p[2], 0.0),
                               glm::dvec3(alpha * p[3], 0.0, 1.0));
    Transform t;
    t.forth = turned * stretched;
    t.back = glm::inverse(t.forth);
    t.determinant = std::abs(glm::determinant(t.forth));
    // The surface's plane, carried into the cosine's space, cuts it at an angle from its own.
    const glm::dvec3 normal = glm::normalize(glm::transpose(t.forth) * glm::dvec3(0.0, 0.0, 1.0));
    t.above = 0.5 * (1.0 + normal.z);
    return t;
}

double density(const Transform& t, const glm::dvec3& toward) {
    if (!(toward.z > 0.0)) return 0.0;
    const glm::dvec3 original = t.back * toward;
    const double length = glm::length(original), cosine = original.z / length;
    return cosine > 0.0 ? cosine / (kPi * t.determinant * length * length * length * t.above) : 0.0;
}

glm::dvec3 viewer(double cosine) { return {-std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

double smith_of(double alpha, double cosine) {
    const double a2 = alpha * alpha;
    return std::sqrt(cosine * cosine * (1.0 - a2) + a2);
}

/// Returns a direction that the viewer sees reflected, by visible normals (Heitz 2018, "Sampling the GGX Distribution
/// of Visible Normals").
glm::dvec3 reflected_at(double alpha, double cosine, const glm::dvec2& at) {
    const glm::dvec3 v = viewer(cosine);
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double across = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::dvec3 first =
        across > 0.0 ? glm::dvec3(-stretched.y, stretched.x, 0.0) / std::sqrt(across) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 second = glm::cross(stretched, first);
    const double radius = std::sqrt(at.x), angle_rad = 2.0 * kPi * at.y, share = 0.5 * (1.0 + stretched.z);
    const double x = radius * std::cos(angle_rad);
    const double y = (1.0 - share) * std::sqrt(1.0 - x * x) + share * radius * std::sin(angle_rad);
    const glm::dvec3 found = first * x + second * y + stretched * std::sqrt(std::max(1.0 - x * x - y * y, 0.0));
    const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * found.x, alpha * found.y, std::max(found.z, 0.0)));
    return 2.0 * glm::dot(v, half) * half - v;
}

glm::dvec2 in_square(int i) { return {(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide}; }

/// Returns what the part takes of D V cos.
double share_of(LobePart part, const glm::dvec3& v, const glm::dvec3& l) {
    if (part == LobePart::reflected) return 1.0;
    return std::pow(std::max(1.0 - glm::dot(v, glm::normalize(l + v)), 0.0), 5.0);
}

/// Directions in which the lobe is sampled, with its density there.
struct Lobe {
    LobePart part = LobePart::reflected;
    double alpha = 1.0, cosine = 1.0;
    double size = 0.0, reflected = 0.0;  // integrals of the part, and of the part that is sampled
    glm::dvec3 middle{0.0};
    std::vector<glm::dvec3> toward;
};

Lobe sampled_lobe(LobePart part, double alpha, double cosine) {
    Lobe lobe{part, alpha, cosine, 0.0, 0.0, glm::dvec3(0.0), {}};
    const glm::dvec3 v = viewer(cosine);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec3 l = reflected_at(alpha, cosine, in_square(i));
        if (!(l.z > 0.0)) continue;
        // D V cos by the density of visible normals is the second Smith term alone.
        const double smith = 2.0 * l.z * (cosine + smith_of(alpha, cosine)) /
                             (2.0 * (l.z * smith_of(alpha, cosine) + cosine * smith_of(alpha, l.z)));
        const double weight = smith / (kSide * kSide);
        const double counted = weight * share_of(part, v, l);
        lobe.reflected += weight;
        lobe.size += counted;
        lobe.middle += counted * l;
        lobe.toward.push_back(l);
    }
    lobe.middle = glm::normalize(glm::dvec3(lobe.middle.x, 0.0, lobe.middle.z));
    return lobe;
}

/// Returns (f - g)^2 / (f + g), which counts all parts of both lobes by their light.
double difference(double f, double g) { return f + g > 0.0 ? (f - g) * (f - g) / (f + g) : 0.0; }

/// Returns how far the fit is off: the integral of difference(), over places of both lobes alike.
double miss(const Lobe& lobe, const Parameters& p) {
    if (!(p[1] > 1.0e-3 && p[2] > 1.0e-3)) return HUGE_VAL;
    const Transform t = transform_of(p, lobe.alpha, lobe.cosine);
    if (!(t.above > kLeastAbove)) return HUGE_VAL;
    double sum = 0.0;
    const auto add = [&](const glm::dvec3& l, double count) {
        const double f = lobe_at(lobe.part, lobe.alpha, lobe.cosine, l) / lobe.size, g = density(t, l);
        const double sampled = lobe_at(LobePart::reflected, lobe.alpha, lobe.cosine, l) / lobe.reflected;
        if (sampled + g > 0.0) sum += difference(f, g) / (sampled + g) / count;
    };
    for (const glm::dvec3& l : lobe.toward) add(l, static_cast<double>(lobe.toward.size()));
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 at = in_square(i);
        const double radius = std::sqrt(at.x), angle_rad = 2.0 * kPi * at.y;
        const glm::dvec3 toward = glm::normalize(
            t.forth * glm::dvec3(radius * std::cos(angle_rad), radius * std::sin(angle_rad), std::sqrt(1.0 - at.x)));
        if (toward.z > 0.0) add(toward, kSide * kSide * t.above);
    }
    return sum;
}

struct Corner {
    Parameters at{};
    double value = 0.0;
};

Parameters between(const Parameters& a, const Parameters& b, double share) {
    Parameters out{};
    for (std::size_t i = 0; i < kParameters; ++i) out[i] = a[i] + (b[i] - a[i]) * share;
    return out;
}

/// Returns the least of `value` near a start (Nelder and Mead 1965).
template <class Value>
Parameters least_near(const Parameters& start, const Parameters& steps, Value value) {
    std::vector<Corner> simplex{{start, value(start)}};
    for (std::size_t i = 0; i < kParameters; ++i) {
        Parameters at = start;
        if (steps[i] == 0.0) continue;
        at[i] += steps[i];
        simplex.push_back({at, value(at)});
    }
    const auto order = [](const Corner& a, const Corner& b) { return a.value < b.value; };
    for (int step = 0; step < kMostSteps; ++step) {
        std::sort(simplex.begin(), simplex.end(), order);
        Corner& worst = simplex.back();
        if (worst.value - simplex.front().value <= kDone * simplex.front().value) break;
        Parameters middle{};
        for (std::size_t c = 0; c + 1 < simplex.size(); ++c)
            for (std::size_t i = 0; i < kParameters; ++i)
                middle[i] += simplex[c].at[i] / static_cast<double>(simplex.size() - 1);
        const auto tried = [&](double share) {
            const Parameters at = between(worst.at, middle, share);
            return Corner{at, value(at)};
        };
        const Corner mirrored = tried(2.0);
        if (mirrored.value < simplex.front().value) {
            const Corner farther = tried(3.0);
            worst = farther.value < mirrored.value ? farther : mirrored;
        } else if (mirrored.value < simplex[simplex.size() - 2].value) {
            worst = mirrored;
        } else if (const Corner nearer = tried(mirrored.value < worst.value ? 1.5 : 0.5); nearer.value < worst.value) {
            worst = nearer;
        } else {
            for (std::size_t c = 1; c < simplex.size(); ++c) {
                simplex[c].at = between(simplex.front().at, simplex[c].at, 0.5);
                simplex[c].value = value(simplex[c].at);
            }
        }
    }
    return std::min_element(simplex.begin(), simplex.end(), order)->at;
}

Parameters parameters_of(const FittedLobe& lobe) { return {lobe.lean, lobe.along, lobe.across, lobe.skew}; }

}  // namespace

double alpha_of(std::uint32_t column) {
    const double roughness = static_cast<double>(column) / (kLobesAcross - 1);
    return std::max(roughness * roughness, kLeastAlpha);
}

double cosine_of(std::uint32_t row) {
    const double x = static_cast<double>(row) / (kLobesAcross - 1);
    return std::max(1.0 - x * x, kLeastCosine);
}

double lobe_at(LobePart part, double alpha, double cosine, const glm::dvec3& toward) {
    if (!(toward.z > 0.0)) return 0.0;
    const glm::dvec3 half = glm::normalize(toward + viewer(cosine));
    const double a2 = alpha * alpha, by = half.z * half.z * (a2 - 1.0) + 1.0;
    const double visible = 0.5 / (toward.z * smith_of(alpha, cosine) + cosine * smith_of(alpha, toward.z));
    return a2 / (kPi * by * by) * visible * toward.z * share_of(part, viewer(cosine), toward);
}

double fitted_at(const FittedLobe& lobe, double alpha, double cosine, const glm::dvec3& toward) {
    return density(transform_of(parameters_of(lobe), alpha, cosine), toward);
}

FittedLobe fit_lobe(LobePart part, double alpha, double cosine, std::span<const FittedLobe> starts) {
    const Lobe lobe = sampled_lobe(part, alpha, cosine);
    const double mean = cosine >= 1.0 ? 0.0 : (std::acos(cosine) - std::atan2(lobe.middle.x, lobe.middle.z)) / alpha;
    const auto value = [&](const Parameters& at) {
        Parameters used = at;
        if (cosine >= 1.0) used = {0.0, at[1], at[1], 0.0};  // seen along the normal a lobe is round
        return miss(lobe, used);
    };
    // A narrow lobe is moved by its skew as by its lean. So the lean is free last, and stays near where the mean is.
    const auto held = [&](const Parameters& at) { return value(at) + kHold * (at[0] - mean) * (at[0] - mean); };
    const bool round = cosine >= 1.0;
    const auto best_from = [&](Parameters from) {
        from[0] = mean;
        if (round) from[3] = 0.0;
        const Parameters near =
            least_near(from, {0.0, 0.2 * from[1], round ? 0.0 : 0.2 * from[2], round ? 0.0 : 0.2}, value);
        return least_near(near, {round ? 0.0 : 0.1, 0.05 * near[1], round ? 0.0 : 0.05 * near[2], round ? 0.0 : 0.05},
                          held);
    };
    Parameters p = best_from(kRound);
    for (const FittedLobe& start : starts)
        if (const Parameters other = best_from(parameters_of(start)); held(other) < held(p)) p = other;
    if (cosine >= 1.0) p[2] = p[1];
    return {p[0], p[1], p[2], p[3], lobe.size / transform_of(p, alpha, cosine).above};
}

}  // namespace gnomon::bench
