#include "tests/oracle/caster_need.h"

#include <vector>

#include "tests/oracle/fit_oracle.h"

namespace gnomon::oracle {
namespace {

/// Returns the i-th number of Halton's sequence, which fills [0, 1) evenly.
double halton(int i, int base) {
    double value = 0.0, share = 1.0;
    for (; i > 0; i /= base) {
        share /= base;
        value += share * (i % base);
    }
    return value;
}

std::vector<Vector> visible_points(const SceneSnapshot& scene, const shadow::ShadowFrame& frame, std::uint32_t demand,
                                   int samples) {
    std::vector<Vector> points;
    const LightItem& light = scene.lights[demand];
    for (const std::uint32_t r : frame.fitted.sets_of(frame.sets, demand).receivers()) {
        const math::Aabb& box = scene.instances[r].bounds_ws;
        for (int i = 1; i <= samples; ++i) {
            const glm::dvec3 share(halton(i, 2), halton(i, 3), halton(i, 5));
            const Vector p = exact(box.min + (box.max - box.min) * share);
            if (!reaches(light, p, 0)) continue;
            for (const ConsumerItem& consumer : scene.consumers)
                if (sees(consumer, p, 0)) {
                    points.push_back(p);
                    break;
                }
        }
    }
    return points;
}

}  // namespace

CasterNeed caster_need(const SceneSnapshot& scene, const shadow::ShadowFrame& frame, std::uint32_t demand, int samples) {
    CasterNeed need;
    const std::vector<Vector> points = visible_points(scene, frame, demand, samples);
    const LightItem& light = scene.lights[demand];
    const Real size_px = frame.fitted.lights[demand].request.map.resolution_px;
    std::vector<Vector> previous;
    for (const shadow::ShadowView& view : frame.fitted.views) {
        if (view.light != demand) continue;
        previous.clear();
        for (const Vector& p : points)
            if (holds(view, p, size_px, 0)) previous.push_back(p);
        need.listed += static_cast<int>(view.casters.count);
        for (std::uint32_t c = view.casters.first; c < view.casters.first + view.casters.count; ++c) {
            const math::Aabb& box = scene.instances[frame.fitted.casters[c]].bounds_ws;
            for (const Vector& p : previous) {
                if (!darkens(light, box, p, 0)) continue;
                ++need.needed;
                break;
            }
        }
    }
    return need;
}

}  // namespace gnomon::oracle
