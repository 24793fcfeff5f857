#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "gnomon/result.h"

namespace gnomon::bench {

/// Writes pixels as a PNG, top row first. Error: rule "output.write", naming the file.
std::optional<Error> write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgba);

}  // namespace gnomon::bench
