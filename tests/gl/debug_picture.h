#pragma once
#include <array>
#include <cmath>
#include <string>

#include "systems/debug/debug_view.h"
#include "tests/gl/box_fixture.h"

namespace gnomon {

using Srgb = std::array<int, 3>;

/// A debug view over a world of boxes, read back by pixels: x to the right and y up, as GL has it.
class DebugPictureTest : public BoxTest {
protected:
    void show(const char* view, const std::string& light = {}, std::optional<std::uint32_t> layer = {}) {
        settings.debug = {.view = debug::find_view(view), .light = light, .layer = layer};
        draw();
        shown_ = picture();
    }
    /// Draws the picture without any view.
    void show_plain() {
        settings.debug = {};
        draw();
        plain_ = picture();
    }
    Srgb shown_at(std::uint32_t x, std::uint32_t y) const { return pixel(shown_, x, y); }
    Srgb plain_at(std::uint32_t x, std::uint32_t y) const { return pixel(plain_, x, y); }

    const std::vector<debug::Label>& labels() { return frame().debug_labels(); }
    const ConsumerItem& camera() { return frame().snapshot().consumers.front(); }
    glm::uvec2 size_px() const { return settings.viewport_px; }

    /// Returns where a pixel sees the plane y = 0; nothing if it sees something else or looks past it.
    std::optional<glm::dvec3> ground_at(std::uint32_t x, std::uint32_t y) {
        const boxes::Ray ray = boxes::pixel_ray(camera(), x, y);
        if (!(ray.direction.y < 0.0)) return std::nullopt;
        const glm::dvec3 p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
        for (const boxes::Box& box : truth.boxes)
            if (boxes::meets(box, ray.origin, p, truth.margin_m)) return std::nullopt;
        return p;
    }
    /// Returns the place in the picture, pixels, that sees a point; nothing if it is outside the picture.
    std::optional<glm::dvec2> place_of(const glm::dvec3& p_ws) {
        const glm::dvec3 p = (p_ws - camera().position_ws_m) * camera().rotation_ws;
        const double half_y = std::tan(0.5 * camera().fov_y_rad);
        if (!(p.z < -camera().near_m)) return std::nullopt;
        const glm::dvec2 size(size_px()), ndc = glm::dvec2(p.x * size.y / size.x, p.y) / (-p.z * half_y);
        const glm::dvec2 place = (ndc * 0.5 + 0.5) * size;
        const bool inside = place.x >= 0.0 && place.y >= 0.0 && place.x < size.x && place.y < size.y;
        return inside ? std::optional(place) : std::nullopt;
    }
    static glm::dvec3 linear(const glm::vec3& srgb) { return {linear(srgb.r), linear(srgb.g), linear(srgb.b)}; }
    /// Blends `colour` (linear) over a pixel.
    static Srgb over(const Srgb& below, const glm::dvec3& colour, double share) {
        Srgb mixed{};
        for (int i = 0; i < 3; ++i) {
            const auto c = static_cast<std::size_t>(i);
            mixed[c] = to_byte(share * colour[i] + (1.0 - share) * linear(below[c] / 255.0));
        }
        return mixed;
    }
    /// Blends a label's colour over a pixel.
    static Srgb over(const Srgb& below, const debug::Label& label, double share) {
        return over(below, linear(label.swatch.value()), share);
    }
    /// Returns whether two colours differ by at most `most` steps. The default allows two roundings to a byte, half a
    /// step each, and one step by the device's own curve.
    static bool near(const Srgb& a, const Srgb& b, int most = 2) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if (std::abs(a[i] - b[i]) > most) return false;
        return true;
    }

private:
    Srgb pixel(const std::vector<std::uint8_t>& rgba, std::uint32_t x, std::uint32_t y) const {
        const std::size_t i = 4 * (std::size_t{size_px().y - 1 - y} * size_px().x + x);
        return {rgba[i], rgba[i + 1], rgba[i + 2]};
    }
    static double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
    static int to_byte(double c) {
        return static_cast<int>(
            std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055)));
    }

    std::vector<std::uint8_t> shown_, plain_;
};

}  // namespace gnomon
