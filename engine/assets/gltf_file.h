#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The door: bytes from disk and from URIs, GLB framing, JSON depth. Everything here throws Failure.
namespace gnomon::assets::gltf {

using Bytes = std::vector<std::byte>;

/// Reads a whole regular file of at most `max_bytes`.
Bytes read_file(const std::filesystem::path& file, std::size_t max_bytes, const std::string& pointer);

/// The file that a relative URI names, inside `folder` after all links are followed.
std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& folder,
                                  const std::string& pointer);

/// The decoded path of a relative URI: no scheme, not absolute, no "..", no control characters.
std::filesystem::path relative_path_of_uri(std::string_view uri, const std::string& pointer);

bool is_data_uri(std::string_view uri);
Bytes decode_data_uri(std::string_view uri, const std::string& pointer);

struct Framing {
    std::string_view json;
    std::span<const std::byte> binary;  // the BIN chunk
    bool has_binary = false;
};

bool has_glb_magic(std::span<const std::byte> bytes);
Framing split_glb(std::span<const std::byte> bytes);

/// Refuses JSON text that nests too deeply or holds too many values, before any parser sees it.
void check_json_text(std::string_view json);

}  // namespace gnomon::assets::gltf
