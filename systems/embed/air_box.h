#pragma once
#include <glm/mat4x4.hpp>

#include "gnomon/frame.h"
#include "gnomon/shadows.h"
#include "systems/extract/snapshot.h"

namespace gnomon::embed {

/// Returns a box of air as what the scene stores of any caster.
CasterDesc in_air(const AirDesc& desc);

/// Returns why a box of air cannot be placed; DropReason::instances_full, which none has, if it can.
DropReason fault_of_air(const glm::dmat4& world_from_box);

/// Writes the place of a box of air without a fault.
void put_air(const glm::dmat4& world_from_box, InstanceItem& item);

}  // namespace gnomon::embed
