#pragma once
#include <filesystem>
#include <optional>

#include "bench/accuracy/accuracy.h"

namespace gnomon::bench {

/// For each light folder/<name>_truth.png, _measured.png and _error.png. Error: green where both say lit, dark where
/// both say shadow, red false shadow, blue false light, yellow not covered by the measured picture, white ambiguous,
/// grey not scored, black no surface. Errors: those of game::write_png and make_writable_folder.
std::optional<Error> write_heat_pictures(const Accuracy& accuracy, const std::filesystem::path& folder);

}  // namespace gnomon::bench
