#pragma once
#include <filesystem>
#include <optional>

#include "bench/accuracy/accuracy.h"

namespace gnomon::bench {

/// Writes folder/<name>_truth.png, _measured.png and _error.png for each light. Errors: those of write_png and
/// make_writable_folder.
/// Colours of _error.png:
/// - green: lit in both; dark: shadow in both;
/// - red: false shadow; blue: false light;
/// - yellow: not covered by the measured picture;
/// - white: ambiguous; grey: not scored; black: no surface.
std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder);

}  // namespace gnomon::bench
