#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/visibility/caster_trees.h"

/// How much of a light reaches a place: for what hides in shadows, grows in the sun or has to be seen. On the CPU, of
/// the casters' own triangles, whether or not a camera sees them and whatever maps hold.
namespace gnomon::visibility {

/// A point, or a sphere: then the light on the half of it that faces the light.
struct Place {
    glm::dvec3 at_ws_m{0.0};
    double radius_m = 0.0;
};

struct QueryOptions {
    /// Rays per place where the place or the light has a size (Light::source_radius_m, sun_radius_rad); at least
    /// 1. Elsewhere one ray is all there is. The same places on both in every query, spread evenly.
    std::uint32_t samples = 16;
    /// Casters nearer to the place than this, along the ray, do not count: what the place itself lies on. What it lies
    /// on exactly, to the rounding of double, never counts.
    double nearest_m = 0.0;
    /// Threads that share the batch, this one included; at least 1. More than one are started and joined by each call.
    /// Batches can be shared out otherwise: ask() of several LightQueries may run at once over the same trees.
    unsigned threads = 1;
};

/// Answers batches of places for one light. What it needs besides the casters' trees is kept, so that nothing is
/// allocated once as many places have been asked on as many threads.
class LightQueries {
public:
    /// `trees` must outlive the queries. They are brought up to date by ask(), or beforehand by their update(), which
    /// must not run while anybody asks.
    explicit LightQueries(CasterTrees& trees);
    ~LightQueries();
    LightQueries(LightQueries&&) noexcept;
    LightQueries& operator=(LightQueries&&) noexcept;

    /// answers[i], 0 to 1: the share of `light`, which need not be in the scene, that reaches places[i]; answers must
    /// be as long as places. 0 beyond the light's range or outside its cone; how it fades within them is not counted,
    /// nor is any angle. Casters are those of the light's layers, both faces, alpha masks as the picture and the
    /// reference tracer have them, moved and bent as the scene says, whether or not the light has a LightShadow; what
    /// is blended lets all light through. A place or light that is not finite: 0.
    ///
    /// One ray's answer is that of a watertight test in double on corners relative to the place, which are right to
    /// 2^-51 of the larger of corner and distance, here as at 1e8 m: no ray slips between two triangles with a common
    /// edge. Float only leads there, and only where it is sure; answers do not depend on batches, order or threads.
    void ask(const SceneSnapshot& scene, const LightItem& light, std::span<const Place> places,
             const QueryOptions& options, std::span<float> answers);

private:
    struct Worker;
    CasterTrees* trees_;
    std::vector<glm::dvec2> disk_;  // for the last number of samples
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace gnomon::visibility
