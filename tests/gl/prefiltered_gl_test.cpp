#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/box_fixture.h"
#include "tests/gl/moment_maps.h"
#include "tests/long_run.h"

// Prefiltered maps: their blur over a cube's seams, their settings, and what shows through two casters.
namespace gnomon {
namespace {

constexpr std::uint32_t kFace_px = 64, kBlur_texel = 9;
constexpr double kLampNear_m = 1.0, kLampFar_m = 9.0, kWall_m = 5.0;

std::vector<const shadow::FilterRow*> prefiltered_rows() {
    std::vector<const shadow::FilterRow*> rows;
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (row.moments) rows.push_back(&row);
    return rows;
}

glm::dvec3 direction_of(std::uint32_t face, double column, double row) {
    const shadow::CubeFace& f = shadow::cube_face(face);
    const double u = (column + 0.5) / kFace_px * 2.0 - 1.0, v = (row + 0.5) / kFace_px * 2.0 - 1.0;
    return f.axis_u * u + f.axis_v * v - f.axis_back;
}

/// Returns 1 where a caster at kWall_m from the light covers the direction, else 0. The caster lies beyond a plane that
/// crosses seams and a corner askew.
double covered(const glm::dvec3& direction) { return glm::dot(direction, {0.62, 0.51, -0.37}) > 0.0 ? 1.0 : 0.0; }

class PrefilteredCube : public MomentMapTest {
protected:
    /// Returns each face's blurred moments of a VSM over that caster, two a texel; elsewhere the map is empty.
    std::vector<std::vector<float>> blurred_faces(std::uint32_t size) {
        std::vector<float> depths;
        for (std::uint32_t face = 0; face < 6; ++face)
            for (std::uint32_t row = 0; row < kFace_px; ++row)
                for (std::uint32_t column = 0; column < kFace_px; ++column) {
                    const glm::dvec3 d = direction_of(face, column, row);
                    const double z_m = kWall_m / glm::length(d);  // along the face's axis
                    const double depth = kLampNear_m / (kLampFar_m - kLampNear_m) * (kLampFar_m / z_m - 1.0);
                    depths.push_back(static_cast<float>(covered(d) * depth));
                }
        const auto map = keep(device().create_texture({.label = "depths", .kind = gl::TextureKind::cube, .format = gl::Format::d32f, .width = kFace_px, .height = kFace_px},
                                                      std::as_bytes(std::span(depths))));
        LightItem lamp;
        lamp.kind = LightKind::point;
        lamp.tuning.kernel.size_texel = size;
        const auto moments = moments_of(shadow::filter_row(ShadowFilter::vsm), lamp, map, kFace_px, {kLampNear_m, kLampFar_m});
        std::vector<std::vector<float>> faces;
        for (std::uint32_t face = 0; face < 6; ++face) faces.push_back(read<float>(moments, std::size_t{kFace_px} * kFace_px * 2, face));
        return faces;
    }
    static double share_of_wall() { return (kWall_m - kLampNear_m) / (std::sqrt(3.0) * kLampFar_m - kLampNear_m); }
    /// Returns how much of the caster a texel shows, 0 to 1.
    static double shown(const std::vector<std::vector<float>>& faces, std::uint32_t face, std::uint32_t column, std::uint32_t row) {
        const double mean = static_cast<double>(faces[face][2 * (std::size_t{row} * kFace_px + column)]);
        return (1.0 - mean) / (1.0 - share_of_wall());
    }
    /// Returns the blur over the sphere, the mean of many directions. The weights are a round Gaussian around the
    /// direction, as wide as the texel's own.
    static double over_the_sphere(const glm::dvec3& direction) {
        const glm::dvec3 axis = glm::normalize(direction);
        const glm::dvec3 aside = glm::normalize(glm::cross(axis, glm::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 other = glm::cross(axis, aside);
        // A texel's side, seen from the light: shorter toward the corners, by the mean of both sides.
        const double stretch = glm::length(direction);
        const double texel_rad = 2.0 / kFace_px / std::pow(stretch, 1.5);
        const double deviation_rad = (kBlur_texel / 2 + 0.5) / 2.0 * texel_rad;
        double sum = 0.0, weights = 0.0;
        for (double u = -2.5; u <= 2.5; u += 0.125)
            for (double v = -2.5; v <= 2.5; v += 0.125) {
                const double weight = std::exp(-0.5 * (u * u + v * v));
                sum += weight * covered(axis + deviation_rad * (u * aside + v * other));
                weights += weight;
            }
        return sum / weights;
    }
};

TEST_F(PrefilteredCube, IsBlurredAcrossSeamsAsOverTheSphere) {
    const auto faces = blurred_faces(kBlur_texel);
    // Stated in docs/explanation/prefiltered_maps.md: what a face's plane makes of a round blur, most at the corners; plus half
    // a texel of the neighbour's grid.
    constexpr double kTolerance = 0.12;
    double worst_inside = 0.0, worst_seam = 0.0;
    std::size_t between = 0;
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t row = 0; row < kFace_px; ++row)
            for (std::uint32_t column = 0; column < kFace_px; ++column) {
                const std::uint32_t to_seam = std::min({row, column, kFace_px - 1 - row, kFace_px - 1 - column});
                const double found = shown(faces, face, column, row);
                const double wrong = std::abs(found - over_the_sphere(direction_of(face, column, row)));
                double& worst = to_seam < kBlur_texel / 2 ? worst_seam : worst_inside;
                worst = std::max(worst, wrong);
                between += to_seam < kBlur_texel / 2 && found > 0.1 && found < 0.9;
            }
    EXPECT_LT(worst_seam, kTolerance);
    EXPECT_LT(worst_seam, worst_inside + 0.05) << "seams are worse than the rest";
    EXPECT_GT(between, 200u) << "no edge near a seam: the test sees nothing";
}

TEST_F(PrefilteredCube, HasNoStepWhereTwoFacesMeet) {
    const auto faces = blurred_faces(kBlur_texel);
    double worst_step = 0.0, inner_step = 0.0;
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t row = 0; row < kFace_px; ++row) {
            // Across the face's first column lies a texel of a neighbour.
            const glm::dvec3 d = direction_of(face, -1.0, row);
            const glm::dvec3 size = glm::abs(d);
            std::uint32_t axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
            const std::uint32_t beside = 2 * axis + (d[static_cast<int>(axis)] < 0.0 ? 1 : 0);
            ASSERT_NE(beside, face);
            const shadow::CubeFace& f = shadow::cube_face(beside);
            const double along = -glm::dot(d, f.axis_back);
            const auto place = [&](const glm::dvec3& on) {
                const double at = (glm::dot(d, on) / along * 0.5 + 0.5) * kFace_px;
                return static_cast<std::uint32_t>(std::clamp(at, 0.0, kFace_px - 1.0));
            };
            const double here = shown(faces, face, 0, row), next = shown(faces, face, 1, row);
            worst_step = std::max(worst_step, std::abs(shown(faces, beside, place(f.axis_u), place(f.axis_v)) - here));
            inner_step = std::max(inner_step, std::abs(next - here));
        }
    EXPECT_GT(inner_step, 0.05) << "no edge crosses a seam";
    EXPECT_LT(worst_step, inner_step + 0.05);
}

class Prefiltered : public BoxTest, public ::testing::WithParamInterface<LightKind> {
protected:
    /// Adds a light high on the left that shines on the origin.
    ecs::Entity add_slanting_light(const LightShadow& shadow, const ShadowTuning& tuning) {
        const glm::dvec3 position(-3.0, 6.0, 2.0);
        const Light light{.kind = GetParam(), .intensity = GetParam() == LightKind::directional ? 10000.0f : 3000.0f, .outer_cone_rad = 0.9f};
        return add_light(light, position, -position, shadow, tuning);
    }
};

TEST_P(Prefiltered, ShadowsAreThoseOfAHardFilterAwayFromEdgesInEveryFormatAndWidth) {
    constexpr std::uint32_t kMap_px = 512;
    std::vector<std::pair<ShadowFilter, ShadowTuning>> rows;
    std::size_t first_bits = 0;
    for (const shadow::FilterRow* row : prefiltered_rows()) {
        const std::array<ShadowTuning, 4> widths{{{.kernel = {.size_texel = 1}},
                                                  {.kernel = {.size_texel = 9}},
                                                  {.moments = {.levels = 3}},
                                                  {.moments = {.anisotropy = 8}}}};
        // A short run takes every width, and both formats, of each filter; a long one every pair.
        constexpr std::array kBits{16u, 32u};
        for (std::size_t width = 0; width < widths.size(); ++width)
            for (std::size_t format = 0; format < kBits.size(); ++format) {
                if (!is_long_run() && (first_bits + width) % kBits.size() != format) continue;
                rows.emplace_back(row->id, widths[width]);
                rows.back().second.moments.bits = kBits[format];
            }
        ++first_bits;  // the next filter begins with the other format
    }
    truth.margin_m = 0.45;  // nine texels of blur, or four and a pixel's footprint, on the plane
    add_ground(6.0);
    add_box({-1.2, 1.0, -1.4}, {1.1, 2.5, 1.3});
    for (const auto& [filter, tuning] : rows) add_slanting_light({.filter = filter, .resolution_px = kMap_px}, tuning);
    look_down(5.0);
    draw();
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        const auto& [filter, tuning] = rows[i];
        SCOPED_TRACE(std::string(shadow::filter_row(filter).name) + ", " + std::to_string(tuning.moments.bits) +
                     " bits, size " + std::to_string(tuning.kernel.size_texel) + ", levels " +
                     std::to_string(tuning.moments.levels) + ", anisotropy " +
                     std::to_string(tuning.moments.anisotropy));
        constexpr float kOnePercent = 0.01f;
        const SceneSnapshot& scene = frame().snapshot();
        const boxes::Verdict verdict = boxes::judge(truth, scene.consumers.front(), scene.lights[i], visibility(i), kOnePercent);
        EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
        EXPECT_GT(verdict.dark, 100u);
        EXPECT_GT(verdict.lit, 3000u);
    }
}

/// A sun's casters lie on its near plane, both: nothing bleeds.
class PrefilteredLamp : public Prefiltered {};

TEST_P(PrefilteredLamp, TwoCastersLetThroughNoMoreThanTheDocumentedShare) {
    // Straight above: the lower box darkens all that is claimed; the upper one ends above its middle.
    add_ground(6.0);
    add_box({-1.5, 1.0, -1.5}, {1.5, 1.2, 1.5});
    add_box({-1.5, 3.8, -1.5}, {0.0, 4.0, 1.5});
    const Light light{.kind = GetParam(), .intensity = 3000.0f, .outer_cone_rad = 0.9f};
    const auto add = [&](ShadowFilter filter, float bleeding) {
        add_light(light, {0.0, 6.0, 0.0}, {0.0, -1.0, 0.0}, {.filter = filter, .resolution_px = 512},
                  {.moments = {.bleeding = bleeding}});
    };
    for (const shadow::FilterRow* row : prefiltered_rows()) add(row->id, 0.0f);
    add(ShadowFilter::vsm, 0.4f);
    truth.boxes.pop_back();
    truth.margin_m = 0.09;  // less than half of a box's thickness
    add_camera({.fov_y_rad = 1.8}, {0.0, 0.65, 0.0}, {0.0, -1.0, 0.0});  // from below both
    draw();
    const auto brightest = [&](std::uint32_t i) {
        const std::vector<float> shown = visibility(i);
        const SceneSnapshot& scene = frame().snapshot();
        float most = 0.0f;
        std::size_t claimed = 0;
        for (std::uint32_t y = 0; y < scene.consumers.front().viewport_px.y; ++y)
            for (std::uint32_t x = 0; x < scene.consumers.front().viewport_px.x; ++x) {
                if (boxes::claim_of_pixel(truth, scene.consumers.front(), scene.lights[i], x, y) != boxes::Claim::dark) continue;
                ++claimed;
                most = std::max(most, shown[std::size_t{y} * scene.consumers.front().viewport_px.x + x]);
            }
        EXPECT_GT(claimed, 3000u);
        return most;
    };
    std::uint32_t i = 0;
    float of_variance = 0.0f;
    for (const shadow::FilterRow* row : prefiltered_rows()) {
        const float most = brightest(i++);
        if (row->id == ShadowFilter::vsm) of_variance = most;
        // x = 2.8 m between casters, y = 1 m to the receiver. A variance lets through at most x^2 / (x^2 + 4 y (x + y))
        // = 0.34.
        EXPECT_LE(most, row->id == ShadowFilter::vsm ? 0.35f : 0.02f) << row->name;
    }
    EXPECT_GT(of_variance, 0.1f) << "no edge above: the test sees nothing";
    EXPECT_EQ(brightest(i), 0.0f) << "bleeding of 0.4 takes it";
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Prefiltered, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(shadow::light_kind_row(row.param).name); });

INSTANTIATE_TEST_SUITE_P(OfEachKind, PrefilteredLamp, ::testing::Values(LightKind::spot, LightKind::point),
                         [](const auto& row) { return std::string(shadow::light_kind_row(row.param).name); });

}  // namespace
}  // namespace gnomon
