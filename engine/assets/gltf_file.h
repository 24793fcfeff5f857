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

using Notes = std::vector<std::string>;  // lines of taken() (gltf_error.h)

/// The file that a relative URI names, inside `folder` after all links are followed: the first of the URI's readings
/// that exists. A reading other than the letter's is noted.
std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& folder, const std::string& pointer,
                                  Notes& notes);

/// One way to read a relative URI as a path. `rule` is null where it is the letter's.
struct UriReading {
    std::filesystem::path path;  // normal, inside the folder as far as its text says
    const char* rule = nullptr;
    const char* message = nullptr;
};

/// The readings of a relative URI, the letter's first: with escapes decoded or left, with or without what follows a
/// '?' or '#', with '\\' or '/'. No scheme, not absolute, no ".." that leaves the folder, no control characters.
std::vector<UriReading> readings_of_uri(std::string_view uri, const std::string& pointer);

bool is_data_uri(std::string_view uri);
Bytes decode_data_uri(std::string_view uri, const std::string& pointer);

struct Framing {
    std::string_view json;
    std::span<const std::byte> binary;  // the BIN chunk
    bool has_binary = false;
    Notes notes;
};

bool has_glb_magic(std::span<const std::byte> bytes);
Framing split_glb(std::span<const std::byte> bytes);

/// Refuses JSON text that nests too deeply or holds too many values, before any parser sees it.
void check_json_text(std::string_view json);

}  // namespace gnomon::assets::gltf
