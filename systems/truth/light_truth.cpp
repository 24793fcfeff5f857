#include "systems/truth/light_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "systems/extract/light_facts.h"
#include "systems/visibility/light_rays.h"

namespace gnomon::truth {
namespace {

constexpr std::array<glm::dvec2, 4> kAround{{{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}}};

/// Returns two axes in the plane of a unit normal.
std::array<glm::dvec3, 2> tangents(const glm::dvec3& n) {
    const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 first = glm::normalize(glm::cross(n, helper));
    return {first, glm::cross(n, first)};
}

/// Places of some rows to query, and their results.
struct Questions {
    std::vector<std::size_t> pixels;
    std::vector<visibility::Place> places;
    std::vector<float> answers;
};

void ask(const SceneSnapshot& scene, const LightItem& light, visibility::LightQueries& queries, Questions& questions) {
    questions.answers.resize(questions.places.size());
    queries.ask(scene, light, questions.places, {}, questions.answers);
}

/// Adds four places around the pixel's. The offset stays in the surface: outside it, a place could lie inside the
/// solid, and grazing rays would hit neighbours.
void add_around(const SeenSurfaces& seen, std::size_t pixel, Questions& questions) {
    const glm::dvec3& point = seen.position_ws_m[pixel];
    const double step_m = kJitter * glm::length(point - seen.camera_ws_m);
    const auto [one, other] = tangents(seen.normal_ws[pixel]);
    for (const glm::dvec2& at : kAround) questions.places.push_back({point + step_m * (one * at.x + other * at.y)});
    questions.pixels.push_back(pixel);
}

}  // namespace

void LightTruth::reset(std::size_t pixels) {
    visibility.assign(pixels, -1.0f);
    scored.assign(pixels, 0);
    ambiguous.assign(pixels, 0);
}

double cosine_to(const LightItem& light, const SeenSurfaces& seen, std::size_t pixel) {
    const glm::dvec3 way = to_light(light, seen.position_ws_m[pixel]);
    const double distance = glm::length(way);
    return distance > 0.0 ? glm::dot(seen.normal_ws[pixel], way) / distance : 0.0;
}

LightItem as_point(const LightItem& light) {
    LightItem point = light;
    point.source_radius_m = point.sun_radius_rad = point.width_m = point.height_m = 0.0f;
    return point;
}

void trace_rows(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, RowRange rows,
                visibility::LightQueries& queries, LightTruth& truth) {
    const std::array middle{glm::dvec2(0.0)};
    const visibility::LightRays reach(light, middle);
    const std::size_t width_px = seen.size_px.x, first = rows.first * width_px, end = first + rows.count * width_px;
    Questions here, around;
    for (std::size_t pixel = first; pixel < end; ++pixel) {
        if (seen.instance[pixel] == kNoSurface) continue;
        truth.visibility[pixel] = 0.0f;
        const double cosine = cosine_to(light, seen, pixel);
        if (!(cosine > 0.0) || !reach.reaches(seen.position_ws_m[pixel])) continue;
        truth.scored[pixel] = cosine > kMinCosine;
        if (!receives_under(light, scene.instances[seen.instance[pixel]])) {
            truth.visibility[pixel] = 1.0f;
            continue;
        }
        here.pixels.push_back(pixel);
        here.places.push_back({seen.position_ws_m[pixel]});
        if (truth.scored[pixel]) add_around(seen, pixel, around);
    }
    ask(scene, light, queries, here);
    for (std::size_t i = 0; i < here.pixels.size(); ++i) truth.visibility[here.pixels[i]] = here.answers[i];
    ask(scene, light, queries, around);
    for (std::size_t i = 0; i < around.answers.size(); ++i) {
        const std::size_t pixel = around.pixels[i / kAround.size()];
        if (around.answers[i] < truth.visibility[pixel] || around.answers[i] > truth.visibility[pixel])
            truth.ambiguous[pixel] = 1;
    }
}

}  // namespace gnomon::truth
