// How much of each lamp reaches a place? For gameplay: is the player in the dark?
//
// A guard walks through a hall with three lamps and some pillars, and visibility() answers by rays, without a map or a
// view. The picture is a plan of the hall, a query per cell and lamp: no shader draws it.
#include <epoxy/gl.h>
#include <gnomon/shadows.h>
#include <gnomon/window.h>

#include <array>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <vector>

namespace {

constexpr double kHallX_m = 16.0, kHallZ_m = 9.0;
constexpr double kGuard_m = 0.3;  // radius of who walks
constexpr int kCellsX = 64, kCellsZ = 36;

struct Lamp {
    glm::dvec3 position_m;
    glm::vec3 colour;
    gnomon::LightId id = {};
};

int fail(const gnomon::Error& error) {
    std::fprintf(stderr, "%s\n", to_line(error).c_str());
    return 2;
}

// The place of the guard after this share of the walk, at chest height.
glm::dvec3 guard_at(double share) { return {(share - 0.5) * 14.0, 1.2, 3.2 - 6.4 * share * share}; }

// Adds the hall's pillars, all of them one mesh.
gnomon::Result<gnomon::MeshId> add_pillars(gnomon::Shadows& shadows) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    constexpr std::uint32_t kFaces[] = {1, 3, 7, 1, 7, 5, 0, 4, 6, 0, 6, 2, 2, 6, 7, 2, 7, 3,
                                        0, 1, 5, 0, 5, 4, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1};
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 low(-6.0f + 1.5f * static_cast<float>(i), 0.0f, i % 3 == 0 ? -2.2f : i % 3 == 1 ? 0.4f : 1.8f);
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (int corner = 0; corner < 8; ++corner)
            positions.push_back(low +
                                glm::vec3(corner & 1, corner & 2, (corner >> 2) & 1) * glm::vec3(0.6f, 1.5f, 0.6f));
        for (const std::uint32_t face : kFaces) indices.push_back(first + face);
    }
    return shadows.add_mesh({.name = "pillars", .positions_m = positions, .indices = indices});
}

// Fills a rectangle of the plan, given in shares of the hall. +z is down, as on a map.
void fill(glm::uvec2 size_px, glm::dvec2 low, glm::dvec2 high, const glm::vec3& colour) {
    const glm::ivec2 from(low * glm::dvec2(size_px)), to(high * glm::dvec2(size_px));
    glScissor(from.x, static_cast<GLint>(size_px.y) - to.y, to.x - from.x, to.y - from.y);
    glClearColor(colour.r, colour.g, colour.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

int main(int argc, char** argv) {
    auto options = gnomon::window_options(argc, argv, "visibility_queries");
    if (!options) return fail(options.error());
    auto window = gnomon::Window::open(options.value());
    if (!window) return fail(window.error());
    auto created = gnomon::Shadows::create();
    if (!created) return fail(created.error());
    gnomon::Shadows& shadows = *created.value();

    const auto pillars = add_pillars(shadows);
    if (!pillars) return fail(pillars.error());
    shadows.add_caster({.mesh = pillars.value()});
    std::array<Lamp, 3> lamps = {{{{-5.0, 2.5, -3.0}, {0.9f, 0.3f, 0.1f}},
                                  {{0.5, 2.5, 3.5}, {0.1f, 0.7f, 0.2f}},
                                  {{6.0, 2.5, -1.5}, {0.1f, 0.3f, 0.9f}}}};
    for (Lamp& lamp : lamps)
        lamp.id = shadows.add_light(
            {.light = {.kind = gnomon::LightKind::point, .source_radius_m = 0.05f}, .position_m = lamp.position_m});
    shadows.render(std::span<const gnomon::View>());  // takes what was added; no view: no map, no mask

    std::printf("  x m    z m   lamp 0  lamp 1  lamp 2\n");
    constexpr int kSteps = 12;
    for (int step = 0; step <= kSteps; ++step) {
        const glm::dvec3 place_m = guard_at(static_cast<double>(step) / kSteps);
        std::printf("%5.2f  %5.2f", place_m.x, place_m.z);
        for (const Lamp& lamp : lamps) std::printf("  %6.3f", shadows.visibility(lamp.id, place_m, kGuard_m));
        std::printf("\n");
    }

    while (window.value()->begin_frame()) {
        const glm::uvec2 size_px = window.value()->size_px();
        glEnable(GL_SCISSOR_TEST);
        glEnable(GL_FRAMEBUFFER_SRGB);
        const glm::dvec2 cell(1.0 / kCellsX, 1.0 / kCellsZ);
        for (int z = 0; z < kCellsZ; ++z)
            for (int x = 0; x < kCellsX; ++x) {
                const glm::dvec2 low(x * cell.x, z * cell.y);
                const glm::dvec2 middle = low + 0.5 * cell - 0.5;
                glm::vec3 sum(0.0f);
                for (const Lamp& lamp : lamps)
                    sum +=
                        lamp.colour * shadows.visibility(lamp.id, {middle.x * kHallX_m, 1.2, middle.y * kHallZ_m}, 0.0);
                fill(size_px, low, low + cell, sum);
            }
        for (int step = 0; step <= kSteps; ++step) {
            const glm::dvec3 place_m = guard_at(static_cast<double>(step) / kSteps);
            const glm::dvec2 at(place_m.x / kHallX_m + 0.5, place_m.z / kHallZ_m + 0.5);
            fill(size_px, at - 0.25 * cell, at + 0.25 * cell, glm::vec3(1.0f));
        }
        glDisable(GL_SCISSOR_TEST);
        if (const auto shown = window.value()->end_frame(); !shown) return fail(shown.error());
    }
    return 0;
}
