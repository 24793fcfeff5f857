#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::bench {

/// A drawing in SVG 1.1: y grows downward, units are CSS pixels. Styles are SVG attributes ("fill='none'
/// stroke='#888'").
class Svg {
public:
    Svg(double width, double height, std::string_view title);

    void line(const glm::dvec2& a, const glm::dvec2& b, std::string_view style);
    void polyline(std::span<const glm::dvec2> points, std::string_view style);
    void polygon(std::span<const glm::dvec2> points, std::string_view style);
    void circle(const glm::dvec2& centre, double radius, std::string_view style);
    void rectangle(const glm::dvec2& low, const glm::dvec2& high, std::string_view style);
    void text(const glm::dvec2& at, std::string_view words, std::string_view style = "");
    /// Clips all drawing until close_clip() to the rectangle.
    void open_clip(const glm::dvec2& low, const glm::dvec2& high);
    void close_clip();

    /// Returns the whole file.
    std::string str() const { return text_ + "</svg>\n"; }

private:
    void shape(std::string_view name, std::span<const glm::dvec2> points, std::string_view style);
    std::string text_;
    int clips_ = 0;
};

/// Formats a number to four significant digits.
std::string short_number(double value);

}  // namespace gnomon::bench
