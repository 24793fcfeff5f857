#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/assets/gltf_document.h"

namespace gnomon::assets::gltf {

/// Checks every bufferView and accessor against its buffer, including unused ones. Throws Failure.
void validate_ranges(Document& document);

/// Returns the bytes of a bufferView.
std::span<const std::byte> view_bytes(const Document& document, int view, const std::string& pointer);

/// Reads all components of all elements, with sparse values applied. Normalised integers map to [0, 1] or [-1, 1].
/// Non-finite numbers are an error.
std::vector<float> read_floats(const Document& document, int accessor);

/// Reads the same, including non-finite floats. Integers are normalised if `normalised` is true or the file marks them
/// so.
std::vector<float> read_any_floats(const Document& document, int accessor, bool normalised = false);

/// Reads all elements of an index accessor; restart values are an error.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor);

}  // namespace gnomon::assets::gltf
