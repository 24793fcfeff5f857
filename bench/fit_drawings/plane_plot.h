#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <vector>

#include "bench/text/svg.h"
#include "engine/math/convex_polygon.h"

/// Parts of the drawings of fits: a square part of a plane, and a map in it.
namespace gnomon::bench {

using Points = std::vector<glm::dvec2>;

inline constexpr double kMargin = 24.0, kSide = 460.0, kHead = 52.0;  // sizes of a panel, pixels of the drawing
inline constexpr std::array<const char*, 8> kColours = {"#c0392b", "#1f6fb2", "#2e8b57", "#8e44ad",
                                                        "#b8860b", "#16a2a2", "#7f5539", "#555555"};

/// A square part of a plane, drawn as a square; y up.
class Panel {
public:
    Panel(Svg& svg, const glm::dvec2& corner, const Points& shown, const std::string& title)
        : svg_(svg), corner_(corner) {
        glm::dvec2 low(INFINITY), high(-INFINITY);
        for (const glm::dvec2& p : shown) low = glm::min(low, p), high = glm::max(high, p);
        constexpr double kAir = 1.08;
        middle_ = 0.5 * (low + high);
        scale_ = kSide / (kAir * std::max({high.x - low.x, high.y - low.y, 1e-300}));
        svg_.text({corner_.x, corner_.y - 8.0}, title, "font-weight='bold'");
        svg_.open_clip(corner_, corner_ + kSide);
    }
    ~Panel() {
        svg_.close_clip();
        svg_.rectangle(corner_, corner_ + kSide, "fill='none' stroke='#999'");
    }
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    glm::dvec2 at(const glm::dvec2& p) const {
        const glm::dvec2 q = (p - middle_) * scale_;
        return corner_ + glm::dvec2(0.5 * kSide + q.x, 0.5 * kSide - q.y);
    }
    double length(double plane_length) const { return plane_length * scale_; }
    void polygon(const Points& corners, const std::string& style) {
        Points moved;
        for (const glm::dvec2& p : corners) moved.push_back(at(p));
        svg_.polygon(moved, style);
    }
    void hull(Points points, const std::string& style) {
        Points corners;
        math::convex_hull(points, corners);
        polygon(corners, style);
    }
    void line(const glm::dvec2& a, const glm::dvec2& b, const std::string& style) { svg_.line(at(a), at(b), style); }
    void circle(const glm::dvec2& centre, double radius, const std::string& style) {
        svg_.circle(at(centre), length(radius), style);
    }
    void dot(const glm::dvec2& p, const std::string& style) { svg_.circle(at(p), 4.0, style); }
    /// Writes beside a point, on the side with room. Writes nothing if the panel does not show the point.
    void text(const glm::dvec2& p, const std::string& words) {
        if (glm::any(glm::greaterThan(glm::abs(at(p) - corner_ - 0.5 * kSide), glm::dvec2(0.5 * kSide)))) return;
        const bool right = at(p).x > corner_.x + 0.5 * kSide;
        svg_.text(at(p) + glm::dvec2(right ? -6.0 : 6.0, -6.0), words, right ? "text-anchor='end'" : "");
    }

private:
    Svg& svg_;
    glm::dvec2 corner_, middle_{0.0};
    double scale_ = 1.0;
};

/// Place of a map in some plane, for each share of its width and height. Borders of texels are straight.
struct MapOutline {
    std::function<glm::dvec2(const glm::dvec2& share)> at;
    Points corners() const { return {at({0.0, 0.0}), at({1.0, 0.0}), at({1.0, 1.0}), at({0.0, 1.0})}; }
};

/// Draws grid lines, with as many texels between them as make lines distinguishable. Returns that number.
int draw_grid(Panel& panel, const MapOutline& map, const glm::dvec2& texels, const std::string& colour);

}  // namespace gnomon::bench
