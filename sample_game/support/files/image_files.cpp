#include "sample_game/support/files/image_files.h"

#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
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

Result<Pfm> read_pfm(const std::filesystem::path& file) {
    const auto refused = [&](const char* why) {
        return Error{.message = why, .file = file.string(), .rule = "input.read"};
    };
    std::ifstream in(file, std::ios::binary);
    if (!in) return refused("cannot be read");
    std::string kind;
    std::uint32_t width = 0, height = 0;
    double scale = 0.0;
    // The last digit of the scale is followed by one line break.
    if (!(in >> kind >> width >> height >> scale) || kind != "Pf" || scale >= 0.0 || in.get() != '\n')
        return refused("no greyscale PFM file with little-endian numbers");
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    Pfm read{{width, height}, {}};
    const std::uint64_t count = std::uint64_t{width} * height;
    if (count == 0 || bytes.size() != count * sizeof(float)) return refused("its length does not fit its size");
    read.values.resize(count);
    for (std::size_t i = 0; i < read.values.size(); ++i) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, bytes.data() + i * sizeof bits, sizeof bits);
        read.values[i] = std::bit_cast<float>(little_endian(bits));
    }
    return read;
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
