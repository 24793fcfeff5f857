#include "bench/text/svg.h"

#include <cstdio>

namespace gnomon::bench {
namespace {

// A hundredth of a pixel: finer is not seen, and files stay small.
std::string coordinate(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}
std::string attribute(const char* name, double value) {
    return " " + std::string(name) + "=\"" + coordinate(value) + "\"";
}
std::string escaped(std::string_view words) {
    std::string text;
    for (const char c : words) {
        if (c == '<')
            text += "&lt;";
        else if (c == '&')
            text += "&amp;";
        else
            text += c;
    }
    return text;
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title) {
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) + attribute("height", height) +
            " font-family=\"sans-serif\" font-size=\"12\">\n<title>" + escaped(title) + "</title>\n";
    rectangle({0.0, 0.0}, {width, height}, "fill='#fff'");
}

void Svg::line(const glm::dvec2& a, const glm::dvec2& b, std::string_view style) {
    text_ += "<line" + attribute("x1", a.x) + attribute("y1", a.y) + attribute("x2", b.x) + attribute("y2", b.y) + " " +
             std::string(style) + "/>\n";
}

void Svg::shape(std::string_view name, std::span<const glm::dvec2> points, std::string_view style) {
    text_ += "<" + std::string(name) + " points=\"";
    for (const glm::dvec2& p : points) text_ += coordinate(p.x) + "," + coordinate(p.y) + " ";
    text_ += "\" " + std::string(style) + "/>\n";
}
void Svg::polyline(std::span<const glm::dvec2> points, std::string_view style) { shape("polyline", points, style); }
void Svg::polygon(std::span<const glm::dvec2> points, std::string_view style) { shape("polygon", points, style); }

void Svg::circle(const glm::dvec2& centre, double radius, std::string_view style) {
    text_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) + " " +
             std::string(style) + "/>\n";
}

void Svg::rectangle(const glm::dvec2& low, const glm::dvec2& high, std::string_view style) {
    text_ += "<rect" + attribute("x", low.x) + attribute("y", low.y) + attribute("width", high.x - low.x) +
             attribute("height", high.y - low.y) + " " + std::string(style) + "/>\n";
}

void Svg::text(const glm::dvec2& at, std::string_view words, std::string_view style) {
    text_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + " " + std::string(style) + ">" + escaped(words) +
             "</text>\n";
}

void Svg::open_clip(const glm::dvec2& low, const glm::dvec2& high) {
    const std::string id = "clip" + std::to_string(clips_++);
    text_ += "<clipPath id=\"" + id + "\">";
    rectangle(low, high, "");
    text_ += "</clipPath><g clip-path=\"url(#" + id + ")\">\n";
}
void Svg::close_clip() { text_ += "</g>\n"; }

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace gnomon::bench
