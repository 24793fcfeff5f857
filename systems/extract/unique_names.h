#pragma once
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon {

/// Makes names unique, because reports and files refer to lights by name: a repeated name gets .1, .2, …
void make_names_unique(std::vector<LightItem>& lights);

}  // namespace gnomon
