#pragma once
#include <filesystem>
#include <optional>

#include "bench/accuracy/accuracy.h"

namespace gnomon::bench {

/// Writes folder/<name>_truth.png, _measured.png and _error.png for each light. A source with a size also has
/// _soft.png, the truth, and _soft_error.png. Areas have _area.png and _area_error.png. Light behind translucent
/// casters has _tint.png, _tint_measured.png and _tint_error.png. Errors: those of write_png and make_writable_folder.
/// Colours of _error.png:
/// - green: lit in both; dark: shadow in both;
/// - red: false shadow; blue: false light;
/// - yellow: not covered by the measured picture;
/// - white: ambiguous; grey: not scored; black: no surface.
/// The other errors are shares: dark to green by the truth, toward red for missing light, toward blue for excess.
std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder);

}  // namespace gnomon::bench
