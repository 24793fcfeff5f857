#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/visibility/caster_trees.h"

/// Share of a light that reaches a place, for gameplay: hiding in shadows, plants, detection. Computed on the CPU from
/// the casters' triangles, independent of cameras and maps.
namespace gnomon::visibility {

/// Point, or sphere: then its half that faces the light receives.
struct Place {
    glm::dvec3 at_ws_m{0.0};
    double radius_m = 0.0;
    /// Surface at a point: only light from before it counts, from area lights by its cosine. 0: all alike.
    glm::dvec3 normal_ws{0.0};
};

struct QueryOptions {
    /// Rays per place where the place or the light has a size (Light::source_radius_m, sun_radius_rad); at least
    /// 1. Elsewhere one ray is all there is. The same places on both in every query, spread evenly.
    std::uint32_t samples = 16;
    /// Distance along the ray below which casters are ignored, to exclude the surface under the place. A surface
    /// exactly at the place, to double's rounding, is always ignored.
    double nearest_m = 0.0;
    /// Number of threads for the batch, including the caller's; at least 1. Each call starts and joins the others.
    /// Alternatively several LightQueries may run ask() concurrently over the same trees.
    unsigned threads = 1;
};

/// Computes visibility for batches of places and one light. Reuses its memory: once warm for a number of places and
/// threads, it does not allocate.
class LightQueries {
public:
    /// Refers to `trees`, which must outlive the queries. ask() updates them, or the caller beforehand by their
    /// update(), which must not run during ask().
    explicit LightQueries(CasterTrees& trees);
    ~LightQueries();
    LightQueries(LightQueries&&) noexcept;
    LightQueries& operator=(LightQueries&&) noexcept;

    /// Sets answers[i] to the share of `light` that reaches places[i], 0 to 1; both spans have equal length. The light
    /// need not be in the scene.
    /// - 0 beyond the light's range or outside its cone. Attenuation within them and angles of incidence do not count.
    /// - Casters are those of the light's layers in their current places and poses, both faces. Alpha masks match the
    ///   picture and the reference tracer; blended surfaces let all light through.
    /// - The light needs no LightShadow. A place or light that is not finite gives 0.
    /// - The test is watertight in double: no ray slips between two triangles with a common edge. Its corners relative
    ///   to the place are exact to 2^-51 of the larger of corner and distance, also at 1e8 m. Float only narrows the
    ///   search, and only where it is certain.
    /// - Results do not depend on batches, order or threads.
    void ask(const SceneSnapshot& scene, const LightItem& light, std::span<const Place> places,
             const QueryOptions& options, std::span<float> answers);

private:
    struct Worker;
    CasterTrees* trees_;
    std::vector<glm::dvec2> disk_;  // for the last number of samples
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace gnomon::visibility
