#include "systems/truth/tint_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/rays/transmittance.h"
#include "systems/extract/light_facts.h"
#include "systems/visibility/light_rays.h"
#include "systems/visibility/scene_walk.h"

namespace gnomon::truth {
namespace {

/// Returns whether a triangle that turns as `turn` does has the side pq for its own, of the two triangles that meet
/// there.
bool owns_side(const glm::dvec3& p, const glm::dvec3& q, double turn) {
    for (int i = 0; i < 3; ++i)
        if (p[i] < q[i] || p[i] > q[i]) return (p[i] < q[i]) == (turn > 0.0);
    return false;
}

/// Returns whether the hit counts: inside, or on a side that the triangle owns.
bool counts(const glm::dvec3& along, const rays::ExactTriangle& t, const glm::dvec3& weights) {
    const double turn = glm::dot(glm::cross(t.b - t.a, t.c - t.a), along);
    const auto inside = [&](double weight, const glm::dvec3& p, const glm::dvec3& q) {
        return weight > 0.0 || owns_side(p, q, turn);
    };
    return inside(weights.x, t.b, t.c) && inside(weights.y, t.c, t.a) && inside(weights.z, t.a, t.b);
}

/// Meets every triangle of an instance, and lets none end a ray.
class Tinting final : public rays::ExactTest {
public:
    Tinting(const assets::MeshLibrary& library, const InstanceItem& item, const rays::RayPacket& rays,
            rays::PerLane<glm::dvec3>& passed)
        : library_(library), item_(item), rays_(rays), passed_(passed) {}

    bool hits(std::size_t ray, const rays::BvhTriangle& triangle, double&) override {
        const glm::dvec3 &from_ws_m = rays_.from[ray], &along = rays_.along[ray];
        const rays::ExactTriangle exact = visibility::placed(item_, triangle, from_ws_m);
        rays::ExactHit hit;
        if (!rays::meets(along, exact, hit) || !(hit.t > rays_.first[ray]) || !(hit.t < rays_.last)) return false;
        if (rays::begins_on_plane(exact, visibility::corner_error_m(item_, exact, from_ws_m))) return false;
        if (counts(along, exact, hit.weights))
            passed_[ray] *= rays::transmittance(library_, library_.meshes[item_.mesh], triangle.triangle, triangle.mask,
                                                hit.weights);
        return false;
    }

private:
    const assets::MeshLibrary& library_;
    const InstanceItem& item_;
    const rays::RayPacket& rays_;
    rays::PerLane<glm::dvec3>& passed_;
};

/// Multiplies `passed` by what each translucent surface of the light's layers lets through.
void pass_through(const SceneSnapshot& scene, const visibility::CasterTrees& trees, const LightItem& light,
                  const rays::RayPacket& rays, rays::PerLane<glm::dvec3>& passed) {
    const auto casts = [&](const InstanceItem& item) {
        const rays::MeshBvh* tree = trees.tree(item.mesh);
        return casts_under(light, item) && tree && !tree->nodes().empty();
    };
    const auto none_first = static_cast<std::uint32_t>(scene.instances.size());
    visibility::SceneWalk walk(scene, trees, rays);
    walk.visit(none_first, casts,
               [&](std::uint32_t instance, const rays::MeshBvh& tree, rays::SegmentPacket& segments) {
                   Tinting tinting(trees.library(), scene.instances[instance], rays, passed);
                   rays::blocked_rays(tree, segments, tinting);
               });
}

}  // namespace

void TintTruth::reset(std::size_t pixels) {
    passed.assign(pixels, glm::vec3(1.0f));
    scored.assign(pixels, 0);
}

void trace_tint_rows(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, RowRange rows,
                     const visibility::CasterTrees& trees, TintTruth& truth) {
    const std::array middle{glm::dvec2(0.0)};
    const visibility::LightRays rays_to_light(light, middle);
    rays::RayPacket packet;
    packet.last = rays_to_light.last();
    rays::PerLane<std::size_t> pixel_of_lane{};
    const auto send = [&] {
        rays::PerLane<glm::dvec3> passed;
        passed.fill(glm::dvec3(1.0));
        pass_through(scene, trees, light, packet, passed);
        for (std::size_t lane = 0; lane < packet.count; ++lane)
            truth.passed[pixel_of_lane[lane]] = glm::vec3(passed[lane]);
        packet.count = 0;
    };
    const std::size_t first = rows.first * std::size_t{seen.size_px.x};
    for (std::size_t pixel = first; pixel < first + rows.count * std::size_t{seen.size_px.x}; ++pixel) {
        if (seen.instance[pixel] == kNoSurface || !(cosine_to(light, seen, pixel) > kMinCosine)) continue;
        if (!receives_under(light, scene.instances[seen.instance[pixel]])) continue;
        visibility::LightRay ray;
        const visibility::Reach reach = rays_to_light.ray({seen.position_ws_m[pixel]}, 0, ray);
        truth.scored[pixel] = reach != visibility::Reach::none;
        if (reach != visibility::Reach::ray) continue;
        packet.from[packet.count] = ray.from_ws_m;
        packet.along[packet.count] = ray.along;
        pixel_of_lane[packet.count] = pixel;
        if (++packet.count == rays::kLanes) send();
    }
    if (packet.count > 0) send();
}

void TintMetrics::add(const glm::dvec3& off, bool is_tinted) {
    constexpr double kStep = 1.0 / 255.0;
    const double mean = (off.x + off.y + off.z) / 3.0, most = std::max({off.x, off.y, off.z});
    ++scored;
    tinted += is_tinted ? 1 : 0;
    beyond += most > kStep ? 1 : 0;
    mean_error += mean;
    tinted_error += is_tinted ? mean : 0.0;
    max_error = std::max(max_error, most);
}

void TintMetrics::finish() {
    mean_error /= static_cast<double>(std::max<std::size_t>(scored, 1));
    tinted_error /= static_cast<double>(std::max<std::size_t>(tinted, 1));
}

TintMetrics compare_tint(std::span<const glm::vec4> measured, const TintTruth& truth, const LightTruth& light,
                         std::vector<float>& off) {
    TintMetrics m;
    off.assign(truth.passed.size(), 0.0f);
    for (std::size_t i = 0; i < truth.passed.size(); ++i) {
        if (truth.scored[i] == 0 || light.ambiguous[i] != 0 || !(light.visibility[i] > 0.0f)) continue;
        const glm::dvec3 difference = glm::dvec3(measured[i]) - glm::dvec3(truth.passed[i]),
                         size = glm::abs(difference);
        m.add(size, truth.passed[i] != glm::vec3(1.0f));
        const int worst = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        off[i] = static_cast<float>(difference[worst]);
    }
    m.finish();
    return m;
}

}  // namespace gnomon::truth
