#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "systems/truth/light_truth.h"

/// True shares of a light that pixels see: of its source, if that has a size; over their areas, for antialiased edges.
namespace gnomon::truth {

/// Rays of a pixel: one from each of `places` to each of `samples` places on the source. The former lie in its area
/// and come on top of its middle, which is else the only one.
struct ShareRays {
    std::uint32_t places = 1, samples = 1;
    std::uint32_t count() const { return places * samples; }
};

/// Each pixel sends a few. It sends many, as for the bench's truth, where these and those of pixels around meet both
/// light and casters.
struct ShareSteps {
    ShareRays few, many;
};

/// Returns true if the light's source has a size.
bool has_size(const LightItem& light);

/// Returns the rays for a light's source, for pixels' areas, or for both.
ShareSteps share_steps(const LightItem& light, bool over_area);

/// Traces one light. Its references outlive it. Several threads may trace different rows, each with queries of its own.
class ShareTrace {
public:
    /// Prepares the trace. `light`: from as_point() for the share of its middle. `surfaces`: also follows rays through
    /// pixels' areas; null: only the place at a pixel's middle counts. `truth` gets the share as
    /// LightTruth::visibility; ambiguous stays 0.
    ///
    /// A place of a pixel's area counts if it lies on the surface at the middle, within kSameSurface_px. Pixels with
    /// such a place that the light does not reach or face are not scored.
    ShareTrace(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen,
               const SurfaceTracer* surfaces, LightTruth& truth)
        : scene_(scene),
          light_(light),
          seen_(seen),
          surfaces_(surfaces),
          steps_(share_steps(light, surfaces != nullptr)),
          truth_(truth) {}

    /// Traces a few rays from the surfaces of some rows.
    void trace_few(RowRange rows, visibility::LightQueries& queries) const;
    /// Traces many rays where a few left the share open. `few`: a copy of `truth` after all rows had these.
    void trace_undecided(RowRange rows, const LightTruth& few, visibility::LightQueries& queries) const;

private:
    struct Batch;
    bool receives(std::size_t pixel) const;
    bool faces_source(const glm::dvec3& at_ws_m, const glm::dvec3& normal_ws) const;
    bool is_open(const LightTruth& few, const glm::ivec2& at) const;
    /// Adds the places of a pixel's area on the surface at its middle; none and not scored, if one sees no light.
    void add_area(std::size_t pixel, std::uint32_t places, std::uint32_t& hint, Batch& batch) const;
    void trace(std::span<const std::size_t> pixels, const ShareRays& rays, visibility::LightQueries& queries) const;

    const SceneSnapshot& scene_;
    const LightItem& light_;
    const SeenSurfaces& seen_;
    const SurfaceTracer* surfaces_;
    ShareSteps steps_;
    LightTruth& truth_;
};

/// Distance from the tangent plane up to which a place is on the same surface, in widths of a pixel there. Takes in
/// facets that bend by little.
inline constexpr double kSameSurface_px = 0.1;

}  // namespace gnomon::truth
