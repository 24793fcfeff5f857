#pragma once
#include "components/light.h"

namespace gnomon {

/// Returns whether a light's numbers are ones that can shine: finite, not negative, and a cone where it needs one.
bool is_usable(const Light& light);

}  // namespace gnomon
