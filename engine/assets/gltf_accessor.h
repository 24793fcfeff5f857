#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/assets/gltf_document.h"

namespace gnomon::assets::gltf {

/// Checks every bufferView and accessor against its buffer, also those that nothing uses. Throws Failure.
void validate_ranges(Document& document);

/// The bytes of a bufferView.
std::span<const std::byte> view_bytes(const Document& document, int view, const std::string& pointer);

/// All components of all elements, sparse values applied, normalised integers mapped to [0, 1] or [-1, 1].
/// Non-finite numbers are an error.
std::vector<float> read_floats(const Document& document, int accessor);

/// The same with whatever floats the file holds. Integers count as normalised if `normalised` says so or the file does.
std::vector<float> read_any_floats(const Document& document, int accessor, bool normalised = false);

/// All elements of an index accessor; restart values are an error.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor);

}  // namespace gnomon::assets::gltf
