#include "engine/gl/program_cache.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <random>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

namespace gnomon::gl {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic = {'g', 'n', 'o', 'm', 'o', 'n', 'P', '1'};
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;  // maximum file size; no program is larger

/// Computes the FNV-1a hash, 64 bit (Fowler, Noll, Vo).
std::uint64_t hash_of(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ull;
    return hash;
}

std::string hexadecimal(std::uint64_t number) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[number >> shift & 15u];
    return text;
}

/// Beginning of a file. The identity and the binary follow, and nothing else.
struct Header {
    std::array<char, 8> magic = kMagic;
    std::uint64_t checksum = 0;  // covers everything after it
    std::uint64_t identity_bytes = 0, binary_bytes = 0;
    std::uint64_t format = 0;
};
static_assert(sizeof(Header) == 40);
constexpr std::size_t kUnchecked = offsetof(Header, identity_bytes);

std::vector<std::byte> file_bytes(const std::string& identity, const ProgramCache::Binary& binary) {
    Header header;
    header.identity_bytes = identity.size();
    header.binary_bytes = binary.bytes.size();
    header.format = binary.format;
    std::vector<std::byte> bytes(sizeof header + identity.size() + binary.bytes.size());
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, identity.data(), identity.size());
    std::copy(binary.bytes.begin(), binary.bytes.end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(sizeof header + identity.size()));
    header.checksum = hash_of(std::span(bytes).subspan(kUnchecked));
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

/// Reads a file. Returns nothing if it does not exist, is too large, or is no regular file.
std::vector<std::byte> read(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error) || error) return {};
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > kMostBytes) return {};
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return in ? bytes : std::vector<std::byte>{};
}

}  // namespace

ProgramCache::ProgramCache(fs::path folder, std::string driver)
    : folder_(std::move(folder)), driver_(std::move(driver)) {}

/// Returns a text that is unique to the program.
std::string ProgramCache::identity(const ProgramDesc& desc) const {
    std::string text;
    for (const std::string* part : {&driver_, &desc.vertex, &desc.fragment, &desc.geometry, &desc.compute})
        text += std::to_string(part->size()) + '\n' + *part;
    return text;
}

fs::path ProgramCache::file_of(const std::string& identity) const {
    return folder_ / (hexadecimal(hash_of(std::as_bytes(std::span(identity)))) + ".program");
}

std::optional<ProgramCache::Binary> ProgramCache::find(const ProgramDesc& desc) const {
    if (!is_on()) return std::nullopt;
    const std::string wanted = identity(desc);
    const std::vector<std::byte> bytes = read(file_of(wanted));
    Header header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::uint64_t rest = bytes.size() - sizeof header;
    if (header.magic != kMagic || header.identity_bytes != wanted.size() || header.identity_bytes > rest ||
        header.binary_bytes != rest - header.identity_bytes || header.binary_bytes == 0 ||
        !std::in_range<std::uint32_t>(header.format))
        return std::nullopt;
    if (std::memcmp(bytes.data() + sizeof header, wanted.data(), wanted.size()) != 0) return std::nullopt;
    if (header.checksum != hash_of(std::span(bytes).subspan(kUnchecked))) return std::nullopt;
    const auto binary = std::span(bytes).subspan(sizeof header + wanted.size());
    return Binary{static_cast<std::uint32_t>(header.format), {binary.begin(), binary.end()}};
}

bool ProgramCache::keep(const ProgramDesc& desc, const Binary& binary) const {
    if (!is_on() || binary.bytes.empty()) return false;
    const std::string made_from = identity(desc);
    const std::vector<std::byte> bytes = file_bytes(made_from, binary);
    if (bytes.size() > kMostBytes) return false;
    std::error_code error;
    fs::create_directories(folder_, error);
    // Written under a unique name, then renamed, so that other processes find the whole file or none.
    const fs::path file = file_of(made_from);
    std::random_device random;
    const fs::path part = file.string() + '.' + hexadecimal(std::uint64_t{random()} << 32 | random()) + ".part";
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (out) fs::rename(part, file, error);
    if (out && !error) return true;
    std::error_code ignored;
    fs::remove(part, ignored);
    return false;
}

void ProgramCache::forget(const ProgramDesc& desc) const {
    std::error_code ignored;
    if (is_on()) fs::remove(file_of(identity(desc)), ignored);
}

}  // namespace gnomon::gl
