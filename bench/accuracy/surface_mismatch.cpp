#include "bench/accuracy/surface_mismatch.h"

#include "bench/accuracy/rasterised_triangle_ids.h"
#include "bench/audit/audited_surfaces.h"

namespace gnomon::bench {

std::optional<std::vector<std::uint8_t>> other_surfaces(Stage& stage, const oracle::ReferenceTracer& tracer,
                                                        const oracle::PrimaryHits& hits) {
    const auto drawn = drawn_triangles(stage.device(), stage.frame(), stage.library());
    if (!drawn || drawn.value().size() != hits.count()) return std::nullopt;
    TrueSurfaces surfaces(stage.frame().snapshot(), stage.library());
    std::vector<std::uint8_t> other(hits.count(), 0);
    for (std::size_t i = 0; i < hits.count(); ++i) {
        const oracle::PlacedTriangle traced = tracer.source_of(hits.triangle[i]);
        other[i] = !(traced == drawn.value()[i]) && !surfaces.in_one_plane(drawn.value()[i], traced);
    }
    return other;
}

std::size_t leave_out(const std::vector<std::uint8_t>& other, oracle::LightTruth& truth) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < other.size(); ++i) {
        if (!other[i] || !truth.scored[i] || truth.ambiguous[i]) continue;
        truth.ambiguous[i] = 1;
        ++count;
    }
    return count;
}

}  // namespace gnomon::bench
