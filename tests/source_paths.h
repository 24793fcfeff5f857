#pragma once
#include <filesystem>

namespace gnomon::test {

/// The folder of this source tree.
std::filesystem::path source_folder();
/// The folder of scenes that others made; it may be absent.
std::filesystem::path data_folder();

}  // namespace gnomon::test
