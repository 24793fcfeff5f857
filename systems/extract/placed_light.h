#pragma once
#include "gnomon/components.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Returns kind, place, range, cone and source size of a light, and nothing else: what rays to it depend on. A cone
/// ends at 90 degrees. A basis without a direction counts as none.
LightItem placed(const Light& light, const WorldTransform& world);

}  // namespace gnomon
