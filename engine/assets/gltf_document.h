#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/assets/gltf_file.h"

namespace gnomon::assets::gltf {

/// One buffer of the file. `available` is false for a placeholder that an extension was to fill.
struct BufferData {
    Bytes storage;
    std::span<const std::byte> bytes;  // into storage, or into the GLB's BIN chunk
    bool available = false;
};

/// A parsed and checked file: every index resolves, every range lies within its buffer.
struct Document {
    std::filesystem::path folder;
    nlohmann::json json;    // as written; tinygltf drops what it does not know
    tinygltf::Model model;  // without buffers, images and primitives' indices: no bytes, URI or file
    std::vector<BufferData> buffers;
    std::vector<std::string> warnings;
    std::size_t suppressed_warnings = 0;
    std::size_t decoded_bytes = 0;  // against kMaxDecodedBytes

    void warn(std::string line);
    /// Warns of what is outside the letter of the format and was taken all the same: place, what was taken, rule.
    void take(const char* rule, const std::string& pointer, const std::string& message);
    /// Accounts for memory that the scene will keep. False, and nothing charged, if the budget does not allow it.
    bool try_charge(std::size_t bytes);
    /// The same; throws Failure.
    void charge(std::size_t bytes, const std::string& pointer);
    bool uses_extension(const std::string& name) const;
};

/// Parses `bytes` (glTF or GLB), loads the buffers and validates everything that Document promises.
/// `bytes` must outlive the document. Throws Failure.
Document parse_document(std::span<const std::byte> bytes, const std::filesystem::path& folder, bool must_be_glb);

}  // namespace gnomon::assets::gltf
