#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_file.h"

namespace gnomon::assets::gltf {
namespace {

constexpr std::string_view kDataScheme = "data:";
constexpr std::string_view kBase64Mark = ";base64";
constexpr int kNotADigit = -1;

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return kNotADigit;
}

/// Decodes %XX. A '%' without two digits stays unchanged and sets `broken`.
std::string percent_decoded(std::string_view text, bool& broken) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : kNotADigit;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : kNotADigit;
        if (high == kNotADigit || low == kNotADigit) {
            broken = true;
            decoded += '%';
            continue;
        }
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

/// Decodes %XX in data, where a broken escape is an error.
std::string data_decoded(std::string_view text, const std::string& pointer) {
    bool broken = false;
    std::string decoded = percent_decoded(text, broken);
    if (broken) fail("uri.percent", pointer, "a broken percent escape");
    return decoded;
}

bool has_scheme(std::string_view uri) {
    if (uri.empty() || std::isalpha(static_cast<unsigned char>(uri[0])) == 0) return false;
    for (const char c : uri) {
        if (c == ':') return true;
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') return false;
    }
    return false;
}

/// Returns true if ".." leads above the path's start at any step, with either separator.
bool leaves_folder(std::string_view path) {
    int depth = 0;
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
        const std::string_view step = path.substr(begin, end - begin);
        if (step == "..") {
            if (--depth < 0) return true;
        } else if (!step.empty() && step != ".") {
            ++depth;
        }
        begin = end + 1;
    }
    return false;
}

void check_path(std::string_view path, const std::string& pointer) {
    if (path.empty()) fail("uri.empty", pointer, "an empty URI");
    for (const char c : path) {
        if (static_cast<unsigned char>(c) < ' ') fail("uri.control_character", pointer, "a control character");
    }
    if (path.front() == '/' || path.front() == '\\') fail("uri.absolute", pointer, "an absolute path");
    if (leaves_folder(path)) fail("uri.escapes_folder", pointer, "a path that \"..\" leads out of the folder");
}

constexpr std::array<std::int8_t, 256> base64_table() {
    std::array<std::int8_t, 256> table{};
    for (auto& entry : table) entry = kNotADigit;
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
        table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    }
    return table;
}

Bytes decode_base64(std::string_view text, const std::string& pointer) {
    static constexpr auto kTable = base64_table();
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) fail("uri.base64", pointer, "the base64 text is cut short");
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int digit = kTable[static_cast<unsigned char>(c)];  // NOLINT(bugprone-signed-char-misuse): -1 means none
        if (digit == kNotADigit) fail("uri.base64", pointer, "a character that is not base64");
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> bit_count) & 0xFFU));
        }
    }
    return bytes;
}

}  // namespace

std::vector<UriReading> readings_of_uri(std::string_view uri, const std::string& pointer) {
    if (uri.empty()) fail("uri.empty", pointer, "an empty URI");
    if (has_scheme(uri)) fail("uri.scheme", pointer, "a URI with a scheme: " + printable(uri));
    std::vector<UriReading> readings;
    const auto read_as = [&](std::string path, const char* rule, const char* message) {
        check_path(path, pointer);
        readings.push_back({std::filesystem::path(path).lexically_normal(), rule, message});
        if (path.find('\\') == std::string::npos) return;
        std::replace(path.begin(), path.end(), '\\', '/');
        readings.push_back({std::filesystem::path(std::move(path)).lexically_normal(), "uri.backslash",
                            "a path with '\\', taken as '/'"});
    };
    const auto decoded = [&](std::string_view text, const char* rule, const char* message) {
        bool broken = false;
        std::string path = percent_decoded(text, broken);
        if (broken) return read_as(std::move(path), "uri.percent", "a '%' that escapes nothing, taken as it is");
        read_as(std::move(path), rule, message);
    };
    decoded(uri, nullptr, nullptr);
    if (uri.find('%') != std::string_view::npos)
        read_as(std::string{uri}, "uri.escaped_name", "a file whose own name holds the escape");
    const std::size_t end = uri.find_first_of("?#");
    if (end != std::string_view::npos && end > 0)
        decoded(uri.substr(0, end), "uri.query", "what follows '?' or '#' is left out");
    return readings;
}

bool is_data_uri(std::string_view uri) { return uri.starts_with(kDataScheme); }

Bytes decode_data_uri(std::string_view uri, const std::string& pointer) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) fail("uri.data", pointer, "a data URI without a comma");
    const std::string_view header = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    const bool base64 = header.ends_with(kBase64Mark);
    if (base64 && body.find('%') == std::string_view::npos) return decode_base64(body, pointer);
    const std::string plain = data_decoded(body, pointer);
    if (base64) return decode_base64(plain, pointer);
    Bytes bytes(plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) bytes[i] = static_cast<std::byte>(plain[i]);
    return bytes;
}

}  // namespace gnomon::assets::gltf
