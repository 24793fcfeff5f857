#pragma once
#include "tests/stability/hard_cases_world.h"

namespace gnomon::hard {

/// Makes long triangles that reach from next to the receivers to far before the near plane.
void pancakes(World& world);
/// Checks that filters flatten these triangles onto the near plane if, and only if, they merely compare depths.
void pancakes_are_made_where_depths_are_compared_alone();

}  // namespace gnomon::hard
