#include "tests/oracle/exactness.h"

namespace gnomon::oracle {
namespace {

/// Returns whether all that lies around a pixel's centre, as far as the rasteriser snaps, is the plane that its ray
/// meets.
bool is_one_surface(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                    std::size_t pixel) {
    const glm::dvec2 centre(static_cast<double>(pixel % hits.size_px.x), static_cast<double>(pixel / hits.size_px.x));
    for (const double x : {-kRasterSnap_px, kRasterSnap_px})
        for (const double y : {-kRasterSnap_px, kRasterSnap_px})
            if (!tracer.sees_plane(consumer, centre + glm::dvec2(x, y), hits.triangle[pixel])) return false;
    return true;
}

}  // namespace

Exactness exactness(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                    const LightTruth& truth, std::span<const float> measured) {
    Exactness found;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        if (!truth.scored[i]) continue;
        ++found.scored;
        found.ambiguous += truth.ambiguous[i];
        if (truth.ambiguous[i]) continue;
        ++(truth.visibility[i] > 0.0f ? found.lit : found.dark);
        if (measured[i] == truth.visibility[i]) continue;
        ++(is_one_surface(tracer, hits, consumer, i) ? found.wrong : found.other_surface);
    }
    return found;
}

}  // namespace gnomon::oracle
