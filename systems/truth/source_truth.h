#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "systems/truth/light_truth.h"

/// True share of a light's source that surfaces see, for lights with a size.
namespace gnomon::truth {

/// Rays from a surface to the source. Each surface sends a few. It sends many, as for the bench's truth, where these
/// and those of pixels around meet both light and casters.
inline constexpr std::uint32_t kFewSamples = 16, kManySamples = 256;

/// Returns true if the light's source has a size.
bool has_size(const LightItem& light);

/// Traces one light. Its references outlive it. Several threads may trace different rows, each with queries of its own.
class SourceTrace {
public:
    /// Prepares the trace. `truth` gets the share as LightTruth::visibility; ambiguous stays 0.
    SourceTrace(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, LightTruth& truth)
        : scene_(scene), light_(light), seen_(seen), truth_(truth) {}

    /// Traces a few rays from the surfaces of some rows.
    void trace_few(RowRange rows, visibility::LightQueries& queries) const;
    /// Traces many rays where a few left the share open. `few`: visibility of the whole picture by these.
    void trace_undecided(RowRange rows, std::span<const float> few, visibility::LightQueries& queries) const;

private:
    bool receives(std::size_t pixel) const;
    bool faces_source(std::size_t pixel) const;
    bool is_open(std::span<const float> few, const glm::ivec2& at) const;
    void trace(std::span<const std::size_t> pixels, std::uint32_t samples, visibility::LightQueries& queries) const;

    const SceneSnapshot& scene_;
    const LightItem& light_;
    const SeenSurfaces& seen_;
    LightTruth& truth_;
};

}  // namespace gnomon::truth
