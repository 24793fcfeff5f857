#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::test {

/// Turns any bytes into a glTF file with sound framing (JSON that parses, GLB chunks that fit) and damaged content. The
/// bytes choose a seed document and a list of edits to its values and to its binary part. The same bytes always give
/// the same file.
std::vector<std::byte> mutated_gltf(std::span<const std::uint8_t> choices);

/// Loads the file from memory and aborts if a scene comes out that breaks a promise of scene_data.h.
void load_and_check(std::span<const std::byte> file);

}  // namespace gnomon::test
