#pragma once
#include "tests/stability/hard_cases_world.h"

namespace gnomon::hard {

/// Long triangles that reach from next to the receivers to far before the near plane.
void pancakes(World& world);
/// Where depths are compared alone they are flattened onto it, and nowhere else.
void pancakes_are_made_where_depths_are_compared_alone();

}  // namespace gnomon::hard
