#include "engine/assets/gltf_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"

namespace gnomon::assets::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and read by memcpy");

constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kGlbVersion = 2;
constexpr std::uint32_t kChunkJson = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kChunkBin = 0x004E4942;   // "BIN\0"
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::size_t kChunkAlignment = 4;

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

bool is_inside(const std::filesystem::path& target, const std::filesystem::path& folder) {
    const auto [in_folder, in_target] = std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
    return in_folder == folder.end();
}

/// Strips zeros that some writers use as padding, where the specification has spaces.
std::string_view without_zeros(std::string_view json, Notes& notes) {
    const std::size_t end = json.find_last_not_of('\0');
    if (end == std::string_view::npos || end + 1 == json.size()) return json;
    notes.push_back(taken("glb.json_padding", "", "the JSON chunk ends in zeros, which are left out"));
    return json.substr(0, end + 1);
}

}  // namespace

Bytes read_file(const std::filesystem::path& file, std::size_t max_bytes, const std::string& pointer) {
    std::error_code failed;
    const auto status = std::filesystem::status(file, failed);
    if (!std::filesystem::exists(status)) fail("file.not_found", pointer, "no such file");
    if (!std::filesystem::is_regular_file(status)) fail("file.not_regular", pointer, "not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    if (failed) fail("file.unreadable", pointer, "its size cannot be read");
    if (size > max_bytes) {
        fail("file.too_large", pointer,
             std::to_string(size) + " bytes; at most " + std::to_string(max_bytes) + " are read");
    }
    std::ifstream stream(file, std::ios::binary);
    Bytes bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream || stream.gcount() != static_cast<std::streamsize>(size)) {
        fail("file.unreadable", pointer, "the file cannot be read");
    }
    return bytes;
}

std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& folder, const std::string& pointer,
                                  Notes& notes) {
    const std::vector<UriReading> readings = readings_of_uri(uri, pointer);
    if (folder.empty()) fail("uri.no_base_folder", pointer, "a scene from memory cannot name files");
    std::error_code failed;
    const auto root = std::filesystem::canonical(folder, failed);
    if (failed) fail("uri.not_found", pointer, "the asset's folder does not exist");
    for (const UriReading& reading : readings) {
        auto target = std::filesystem::canonical(root / reading.path, failed);
        if (failed) continue;
        if (!is_inside(target, root)) fail("uri.escapes_folder", pointer, "the file lies outside the asset's folder");
        if (reading.rule != nullptr) notes.push_back(taken(reading.rule, pointer, reading.message));
        return target;
    }
    fail("uri.not_found", pointer, "no such file: " + printable(readings.front().path.string()));
}

bool has_glb_magic(std::span<const std::byte> bytes) {
    return bytes.size() >= sizeof(kGlbMagic) && read_u32(bytes, 0) == kGlbMagic;
}

Framing split_glb(std::span<const std::byte> bytes) {
    if (bytes.size() < kGlbHeaderBytes + kChunkHeaderBytes) fail("glb.truncated", "", "the header is cut short");
    if (read_u32(bytes, 4) != kGlbVersion) {
        fail("glb.version", "", "GLB version " + std::to_string(read_u32(bytes, 4)) + "; only 2 is known");
    }
    const std::size_t length = read_u32(bytes, 8);
    if (length > bytes.size()) fail("glb.truncated", "", "the file is shorter than its header says");

    Framing framing;
    if (length < bytes.size()) {
        framing.notes.push_back(
            taken("glb.length", "", std::to_string(bytes.size() - length) + " bytes after the end are left out"));
    }
    bool has_json = false;
    for (std::size_t at = kGlbHeaderBytes; at < length;) {
        if (length - at < kChunkHeaderBytes && has_json) {
            framing.notes.push_back(taken("glb.chunk_header", "", "too few bytes for a chunk at the end are left out"));
            break;
        }
        if (length - at < kChunkHeaderBytes) fail("glb.chunk_header", "", "a chunk header is cut short");
        const std::size_t chunk = read_u32(bytes, at);
        const std::uint32_t type = read_u32(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (chunk > length - at) fail("glb.chunk_length", "", "a chunk is longer than the file");
        if (chunk % kChunkAlignment != 0) {
            framing.notes.push_back(
                taken("glb.chunk_alignment", "", "a chunk's length is no multiple of 4; taken as it is"));
        }
        const auto content = bytes.subspan(at, chunk);
        if (!has_json && type != kChunkJson) fail("glb.first_chunk", "", "the first chunk is not JSON");
        if (type == kChunkJson) {
            if (has_json) fail("glb.duplicate_chunk", "", "two JSON chunks");
            has_json = true;
            framing.json =
                without_zeros({reinterpret_cast<const char*>(content.data()), content.size()}, framing.notes);
        } else if (type == kChunkBin) {
            if (framing.has_binary) fail("glb.duplicate_chunk", "", "two BIN chunks");
            framing.has_binary = true;
            framing.binary = content;
        }
        at += chunk;
    }
    return framing;
}

void check_json_text(std::string_view json) {
    std::size_t depth = 0;
    std::size_t values = 1;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
            continue;
        }
        if (c == '"') in_string = true;
        if (c == '{' || c == '[') {
            ++values;
            if (++depth > kMaxJsonDepth) {
                fail("json.depth", "", "nested more than " + std::to_string(kMaxJsonDepth) + " levels deep");
            }
        }
        if ((c == '}' || c == ']') && depth > 0) --depth;
        if (c == ',') ++values;
        if (values > kMaxJsonValues) {
            fail("json.too_many_values", "", "more than " + std::to_string(kMaxJsonValues) + " values");
        }
    }
}

}  // namespace gnomon::assets::gltf
