#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

namespace gnomon::oracle {

/// Numbers of casters, summed over a demand's views. `listed`: casters that a view lists. `needed`: casters among these
/// that darken a sampled point of the view, by their bounds. The rest are listed needlessly, or no sample met them.
struct CasterNeed {
    int listed = 0, needed = 0;
};

/// Counts the need of casters at `samples` points of each receiver of the demand, spread over its bounds evenly
/// (Halton's sequence).
CasterNeed caster_need(const SceneSnapshot& scene, const shadow::ShadowFrame& frame, std::uint32_t demand, int samples);

}  // namespace gnomon::oracle
