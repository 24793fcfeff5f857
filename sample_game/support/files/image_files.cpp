#include "sample_game/support/files/image_files.h"

#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

namespace gnomon::game {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error cannot_write(const std::filesystem::path& file, int error_number) {
    return {.message = std::string("cannot write: ") + std::generic_category().message(error_number),
            .file = file.string(),
            .rule = "output.write"};
}

std::uint32_t little_endian(std::uint32_t value) {
    if constexpr (std::endian::native == std::endian::little) return value;
    return value >> 24 | (value >> 8 & 0xff00u) | (value << 8 & 0xff0000u) | value << 24;
}

}  // namespace

std::optional<Error> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    File out(std::fopen(file.c_str(), "wb"));
    if (!out) return cannot_write(file, errno);
    if (std::fwrite(bytes.data(), 1, bytes.size(), out.get()) != bytes.size()) return cannot_write(file, errno);
    if (std::fclose(out.release()) != 0) return cannot_write(file, errno);
    return std::nullopt;
}

std::optional<Error> write_pfm(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                               std::span<const float> values) {
    if (values.size() != std::size_t{width} * height)
        return Error{.message = "cannot encode the picture", .file = file.string(), .rule = "output.write"};
    // A negative scale stands for little-endian.
    const std::string header = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    std::vector<std::byte> bytes(header.size() + values.size_bytes());
    std::memcpy(bytes.data(), header.data(), header.size());
    std::byte* at = bytes.data() + header.size();
    for (const float value : values) {
        const std::uint32_t bits = little_endian(std::bit_cast<std::uint32_t>(value));
        std::memcpy(at, &bits, sizeof bits);
        at += sizeof bits;
    }
    return write_file(file, bytes);
}

std::optional<Error> check_writable(const std::filesystem::path& file) {
    std::error_code ignored;
    const bool existed = std::filesystem::exists(file, ignored);
    if (!File(std::fopen(file.c_str(), "ab"))) return cannot_write(file, errno);
    if (!existed) std::filesystem::remove(file, ignored);
    return std::nullopt;
}

std::optional<Error> make_writable_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) {
        const std::string why = error ? error.message() : std::string("not a folder");
        return Error{.message = "cannot make the folder: " + why, .file = folder.string(), .rule = "output.folder"};
    }
    if (check_writable(folder / ".gnomon-write-check"))
        return Error{.message = "cannot write into the folder", .file = folder.string(), .rule = "output.folder"};
    return std::nullopt;
}

}  // namespace gnomon::game
