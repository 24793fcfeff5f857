#pragma once
#include <cstdint>
#include <span>

#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/projection/light_range.h"

namespace gnomon::shadow {

/// Receivers of one camera within one light frustum.
struct SeenReceivers {
    std::uint32_t camera = 0;                    // index into SceneSnapshot::consumers
    std::span<const std::uint32_t> items;        // rising indices into SceneSnapshot::instances
    std::span<const math::Plane> sides, core;    // planes of the light frustum; ReceiverVolume::core
};

/// Appends corners to ReceiverCasterSets::error_points_ws: of surfaces from the camera's nearest one on, of each box of
/// air from kAirShare of its way on. A camera in the air would otherwise need texels as fine as its near plane.
void append_error_points(const SceneSnapshot& scene, const SeenReceivers& seen, const LightReach& reach,
                         SetScratch& scratch, ReceiverCasterSets& out);

}  // namespace gnomon::shadow
