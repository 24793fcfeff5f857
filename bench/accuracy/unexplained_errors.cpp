#include "bench/accuracy/unexplained_errors.h"

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::bench {

oracle::FarErrors errors_beyond_texels(const TracedPicture& picture, const EdgeBounds& bounds,
                                       const std::vector<float>& measured) {
    const auto& [tracer, hits, creases, scene, light, truth] = picture;
    const double picture_px = shadow::edge_error_px(0.0, 0.0);
    std::vector<float> allowed_px(hits.count(), 0.0f);
    for (std::size_t i = 0; i < hits.count(); ++i)
        if (truth.scored[i] != 0 && measured[i] != truth.visibility[i])  // others need no bound
            allowed_px[i] =
                static_cast<float>(bounds.at(light, hits.position_rel_m[i], hits.normal_ws[i]).error_px - picture_px);
    return oracle::far_errors({hits.size_px, measured, truth.visibility, truth.scored, truth.ambiguous}, creases,
                              allowed_px,
                              oracle::lit_between(tracer, hits, scene.consumers.front(), scene.lights[light]));
}

}  // namespace gnomon::bench
