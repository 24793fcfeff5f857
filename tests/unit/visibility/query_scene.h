#pragma once
#include <vector>

#include "systems/extract/scene_tree.h"
#include "systems/visibility/light_queries.h"
#include "tests/oracle/light_reach.h"
#include "tests/oracle/traced_world.h"
#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::test {

/// A world put together by hand, with bounds and a tree over them.
struct QueryScene : oracle::AnalyticScene {
    /// Computes the bounds and the tree; call it when all is placed.
    void finish() {
        for (InstanceItem& item : snapshot.instances) {
            math::Aabb box;
            for (const assets::Vertex& vertex : library.meshes[item.mesh].vertices)
                box = math::extended(box, item.basis * glm::dvec3(vertex.position_ms) + item.translation_ws_m);
            item.bounds_ws = box;
            item.mesh_version = library.version_of(item.mesh);
        }
        snapshot.list_version = ++snapshot.version;
        build_tree(snapshot);
    }
    std::vector<float> ask(const LightItem& light, std::span<const visibility::Place> places,
                           const visibility::QueryOptions& options = {}) const {
        visibility::CasterTrees trees(library);
        visibility::LightQueries queries(trees);
        std::vector<float> answers(places.size(), -1.0f);
        queries.ask(snapshot, light, places, options, answers);
        return answers;
    }
    float ask(const LightItem& light, const visibility::Place& place,
              const visibility::QueryOptions& options = {}) const {
        return ask(light, std::span(&place, 1), options).front();
    }
};

/// Answers against the reference's double, ray by ray, at points.
struct Agreement {
    std::size_t lit = 0, dark = 0;
    std::size_t ambiguous = 0;  // differ, and the reference changes its mind when the point moves by kJitter
    std::size_t wrong = 0;
};

inline bool reference_lit(const oracle::TracedWorld& world, const LightItem& light, const glm::dvec3& point_rel_m) {
    glm::dvec3 to_light;
    double last = 0.0;
    if (!oracle::reach(light, light.position_ws_m - world.origin_ws_m(), point_rel_m, to_light, last)) return false;
    return world.occluder(oracle::make_ray(point_rel_m, to_light), last, oracle::kNoTriangle, oracle::kNoTriangle,
                          light.shadow.layers) == oracle::kNoTriangle;
}

inline void compare(const oracle::TracedWorld& world, const LightItem& light, std::span<const visibility::Place> places,
                    std::span<const float> answers, double size_m, Agreement& agreement) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 at = places[i].at_ws_m - world.origin_ws_m();
        const bool lit = reference_lit(world, light, at);
        (lit ? agreement.lit : agreement.dark)++;
        if (answers[i] == (lit ? 1.0f : 0.0f)) continue;
        bool flips = false;
        for (int way = 0; way < 6 && !flips; ++way) {
            glm::dvec3 moved = at;
            moved[way / 2] += (way % 2 ? 1.0 : -1.0) * oracle::kJitter * size_m;
            flips = reference_lit(world, light, moved) != lit;
        }
        (flips ? agreement.ambiguous : agreement.wrong)++;
    }
}

}  // namespace gnomon::test
