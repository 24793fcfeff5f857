#pragma once
#include <filesystem>

namespace gnomon::test {

/// Returns the folder of this source tree.
std::filesystem::path source_folder();
/// Returns the folder of scenes that others made; it may be absent.
std::filesystem::path data_folder();

}  // namespace gnomon::test
