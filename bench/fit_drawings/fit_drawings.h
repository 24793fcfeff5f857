#pragma once
#include <filesystem>

#include "bench/common/stage.h"

namespace gnomon::bench {

/// Draws the fits of the stage's lights, from one real frame for each fit of a sun. Errors: "bench.camera",
/// "bench.map"; those of writing a file. Files:
/// - sun_<fit>.svg: seen along the light;
/// - sun_warp.svg: one warped cascade;
/// - spot.svg and point.svg: first light of the kind, if there is one.
std::optional<Error> write_drawings(Stage& stage, const std::filesystem::path& folder);

}  // namespace gnomon::bench
