#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

namespace gnomon::oracle {

/// How many casters the views of a demand list, summed over the views, and how many of them darken a sampled point that
/// is seen in that view. By bounds. The rest are kept needlessly, or were not met by any sample.
struct CasterNeed {
    int listed = 0, needed = 0;
};

/// `samples` points of each receiver of the demand, spread over its bounds evenly (Halton's sequence).
CasterNeed caster_need(const SceneSnapshot& scene, const shadow::ShadowFrame& frame, std::uint32_t demand, int samples);

}  // namespace gnomon::oracle
