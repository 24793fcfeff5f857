#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/assets/gltf_file.h"

namespace gnomon::assets::gltf {

/// Buffer of the file. `available` is false for a placeholder for an extension to fill.
struct BufferData {
    Bytes storage;
    std::span<const std::byte> bytes;  // into storage, or into the GLB's BIN chunk
    bool available = false;
};

/// A parsed and checked file: every index resolves, every range lies within its buffer.
struct Document {
    std::filesystem::path folder;
    nlohmann::json json;    // as written; tinygltf drops unknown members
    tinygltf::Model model;  // without buffers, images and indices of primitives: no bytes, URI or file
    std::vector<BufferData> buffers;
    std::vector<std::string> warnings;
    std::size_t suppressed_warnings = 0;
    std::size_t decoded_bytes = 0;  // counts against kMaxDecodedBytes

    void warn(std::string line);
    /// Warns of an accepted violation of the format: place, interpretation, rule.
    void take(const char* rule, const std::string& pointer, const std::string& message);
    /// Accounts for memory that the scene will keep. Returns false and charges nothing if the budget does not allow it.
    bool try_charge(std::size_t bytes);
    /// Accounts for memory likewise, but throws Failure.
    void charge(std::size_t bytes, const std::string& pointer);
    bool uses_extension(const std::string& name) const;
};

/// Parses `bytes` (glTF or GLB), loads the buffers and validates what Document guarantees. `bytes` must outlive the
/// document. Throws Failure.
Document parse_document(std::span<const std::byte> bytes, const std::filesystem::path& folder, bool must_be_glb);

}  // namespace gnomon::assets::gltf
