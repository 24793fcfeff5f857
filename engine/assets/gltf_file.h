#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Input of the loader: bytes from disk and URIs, GLB framing, JSON depth. Every function here throws Failure.
namespace gnomon::assets::gltf {

using Bytes = std::vector<std::byte>;

/// Reads a whole regular file of at most `max_bytes`.
Bytes read_file(const std::filesystem::path& file, std::size_t max_bytes, const std::string& pointer);

using Notes = std::vector<std::string>;  // lines of taken() (gltf_error.h)

/// Resolves a relative URI to a file inside `folder`, after following all links. Takes the first reading of the URI
/// that exists, and notes it if it is not the standard one.
std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& folder, const std::string& pointer,
                                  Notes& notes);

/// Reading of a relative URI as a path. `rule` is null for the standard reading.
struct UriReading {
    std::filesystem::path path;  // normalised, lexically inside the folder
    const char* rule = nullptr;
    const char* message = nullptr;
};

/// Returns the readings of a relative URI, the standard one first. Variants: escapes decoded or not, text after '?' or
/// '#' kept or not, '\\' or '/'. Rejects schemes, absolute paths, ".." that leaves the folder, and control characters.
std::vector<UriReading> readings_of_uri(std::string_view uri, const std::string& pointer);

bool is_data_uri(std::string_view uri);
Bytes decode_data_uri(std::string_view uri, const std::string& pointer);

struct Framing {
    std::string_view json;
    std::span<const std::byte> binary;  // BIN chunk
    bool has_binary = false;
    Notes notes;
};

bool has_glb_magic(std::span<const std::byte> bytes);
Framing split_glb(std::span<const std::byte> bytes);

/// Refuses JSON text that nests too deeply or holds too many values, before any parser sees it.
void check_json_text(std::string_view json);

}  // namespace gnomon::assets::gltf
