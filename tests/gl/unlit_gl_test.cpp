#include <algorithm>
#include <cmath>

#include "tests/gl/frame_fixture.h"

// KHR_materials_unlit: a surface shows its colour, whatever light falls on it and whatever the exposure; its shadow
// falls as others' do.
namespace gnomon {
namespace {

constexpr glm::uvec2 kUnlit_px{96, 64};

int shown_as(float linear) {
    const float srgb = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(255.0f * srgb));
}

class Unlit : public FrameTest {
protected:
    /// Draws a box of that material, on the left, over a matt ground.
    void make_world(const assets::Material& of_box, std::optional<float> ev, float lux = 500.0f) {
        start_anew();
        settings = {.viewport_px = kUnlit_px, .exposure_ev = ev, .leave_out_dim_lights = false};
        add_material({.name = "matt", .base_colour = glm::vec4(glm::vec3(0.5f), 1.0f), .metallic = 0.0f});
        const std::uint32_t material = add_material(of_box);
        place(add_mesh(game::make_card(glm::dvec3(0.0), {40.0, 0.0, 0.0}, {0.0, 0.0, -40.0})));
        place(add_mesh(game::make_box({-3.0, 1.0, -1.0}, {-1.0, 2.0, 1.0}), material));
        add_light({.kind = LightKind::directional, .intensity = lux}, {}, {1.0, -1.0, 0.0});
        add_light({.kind = LightKind::point, .intensity = lux}, {-2.0, 3.0, 2.0}, {0.0, -1.0, 0.0});
        add_camera({.projection = CameraProjection::orthographic, .half_height_m = 4.0, .near_m = 0.1, .far_m = 40.0},
                   {0.0, 20.0, 0.0}, {0.0, -1.0, 0.0});
        draw();
    }

    /// Returns the picture's colour, 0 to 255, where it shows this place of the ground or of the box.
    glm::ivec3 at(const std::vector<std::uint8_t>& rgba, double x_m, double z_m) const {
        // looking_along() turns a view straight down so that the world's x is up.
        const double half_m = 4.0, pixel_m = 2.0 * half_m / kUnlit_px.y;
        const auto column = static_cast<std::uint32_t>(0.5 * kUnlit_px.x + z_m / pixel_m);
        const auto row = static_cast<std::uint32_t>(0.5 * kUnlit_px.y - x_m / pixel_m);
        const std::size_t i = (std::size_t{row} * kUnlit_px.x + column) * 4;
        return {rgba[i], rgba[i + 1], rgba[i + 2]};
    }
    static int apart(const glm::ivec3& a, const glm::ivec3& b) {
        return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
    }
};

const glm::vec4 kPaint{0.8f, 0.2f, 0.05f, 1.0f};
const glm::ivec3 kPaintShown{shown_as(0.8f), shown_as(0.2f), shown_as(0.05f)};

TEST_F(Unlit, ShowsItsColourByAnyLightAndExposureAndCastsItsShadow) {
    const assets::Material paint{.name = "paint", .base_colour = kPaint, .emissive = glm::vec3(3.0f), .unlit = true};
    const struct {
        float lux;
        std::optional<float> ev;
    } rows[] = {{0.0f, {}}, {0.0f, 2.0f}, {1.0f, {}}, {1e6f, {}}, {1e6f, 2.0f}, {1e6f, 20.0f}};
    for (const auto& row : rows) {
        SCOPED_TRACE(std::to_string(row.lux) + " lx, EV " + (row.ev ? std::to_string(*row.ev) : "auto"));
        make_world(paint, row.ev, row.lux);
        EXPECT_LE(apart(at(picture(), -2.0, 0.0), kPaintShown), 1);
        const std::vector<float> sun = visibility();
        if (row.lux > 0.0f) {
            EXPECT_GT(std::count(sun.begin(), sun.end(), 0.0f), 50);
        }
    }
}

TEST_F(Unlit, LeavesAllElseAsItWouldBeBesideALitOne) {
    make_world({.name = "paint", .base_colour = kPaint, .metallic = 0.0f, .unlit = true}, 6.0f);
    const auto beside_unlit = picture();
    make_world({.name = "paint", .base_colour = kPaint, .metallic = 0.0f}, 6.0f);
    const auto beside_lit = picture();
    EXPECT_GT(apart(at(beside_lit, -2.0, 0.0), kPaintShown), 20) << "the lit box looks unlit";
    std::size_t changed = 0;
    for (std::size_t i = 0; i < beside_lit.size(); i += 4) changed += beside_lit[i] != beside_unlit[i];
    EXPECT_LE(changed, 18u * 18u) << "more than the box";
}

TEST_F(Unlit, DoesNotEnterTheAutomaticExposure) {
    make_world({.name = "white", .base_colour = glm::vec4(1.0f), .unlit = true}, {});
    const glm::ivec3 white_beside = at(picture(), 2.0, 0.0);
    make_world({.name = "black", .base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f), .unlit = true}, {});
    EXPECT_LE(apart(at(picture(), 2.0, 0.0), white_beside), 0);
    EXPECT_GT(white_beside.x, 60);
}

TEST_F(Unlit, BlendsItsColourOverWhatIsBehind) {
    glm::vec4 half = kPaint;
    half.a = 0.5f;
    make_world({.name = "glass", .base_colour = half, .alpha_mode = assets::AlphaMode::blend, .unlit = true}, 6.0f,
               0.0f);
    // Black behind it, in the light of none: half of the exposed radiance.
    const auto half_shown = [](float shown) {
        const float less = 1.0f - shown, x = shown / (less + std::sqrt(less * less + shown / 16.0f));
        return shown_as(x * (1.0f + x / 64.0f) / (1.0f + x));
    };
    EXPECT_LE(apart(at(picture(), -2.0, 0.0), {half_shown(0.8f), half_shown(0.2f), half_shown(0.05f)}), 1);
}

}  // namespace
}  // namespace gnomon
