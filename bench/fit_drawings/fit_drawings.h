#pragma once
#include <filesystem>

#include "bench/common/stage.h"

namespace gnomon::bench {

/// Draws how the fits of the stage's lights lie, from one real frame for each fit of a sun: sun_<fit>.svg, along the
/// light; sun_warp.svg, of one warped cascade; spot.svg and point.svg, from the first light of the kind, where there is
/// one. Errors: "bench.camera", "bench.map"; those of writing a file.
std::optional<Error> write_drawings(Stage& stage, const std::filesystem::path& folder);

}  // namespace gnomon::bench
