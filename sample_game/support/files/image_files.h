#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/result.h"

namespace gnomon::game {

/// Writes a greyscale float32 PFM, little-endian. `values` and the file: bottom row first. Errors of the writers: rule
/// "output.write", naming the file.
std::optional<Error> write_pfm(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                               std::span<const float> values);

struct Pfm {
    glm::uvec2 size_px{0, 0};
    std::vector<float> values;  // bottom row first
};
/// Reads what write_pfm() writes. Errors: rule "input.read", naming the file, for anything else: colours, big-endian
/// numbers, another length.
Result<Pfm> read_pfm(const std::filesystem::path& file);

std::optional<Error> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Checks that `file` can be written, without changing it. It leaves no file where there was none.
std::optional<Error> check_writable(const std::filesystem::path& file);

/// Makes `folder` (and those above it) and checks that a file can be made in it. Error: rule "output.folder".
std::optional<Error> make_writable_folder(const std::filesystem::path& folder);

}  // namespace gnomon::game
