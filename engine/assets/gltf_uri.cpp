#include <array>
#include <cctype>
#include <cstdint>

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

std::string percent_decoded(std::string_view text, const std::string& pointer) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : kNotADigit;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : kNotADigit;
        if (high == kNotADigit || low == kNotADigit) fail("uri.percent", pointer, "a broken percent escape");
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
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

bool has_parent_step(std::string_view path) {
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
        if (path.substr(begin, end - begin) == "..") return true;
        begin = end + 1;
    }
    return false;
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

std::filesystem::path relative_path_of_uri(std::string_view uri, const std::string& pointer) {
    if (uri.empty()) fail("uri.empty", pointer, "an empty URI");
    if (has_scheme(uri)) fail("uri.scheme", pointer, "a URI with a scheme: " + printable(uri));
    const std::string decoded = percent_decoded(uri, pointer);
    for (const char c : decoded) {
        if (static_cast<unsigned char>(c) < ' ') fail("uri.control_character", pointer, "a control character");
    }
    if (decoded.front() == '/' || decoded.front() == '\\') fail("uri.absolute", pointer, "an absolute path");
    if (has_parent_step(decoded)) fail("uri.escapes_folder", pointer, "a path with \"..\"");
    return {decoded};
}

bool is_data_uri(std::string_view uri) { return uri.starts_with(kDataScheme); }

Bytes decode_data_uri(std::string_view uri, const std::string& pointer) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) fail("uri.data", pointer, "a data URI without a comma");
    const std::string_view header = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    if (header.ends_with(kBase64Mark)) return decode_base64(body, pointer);
    const std::string plain = percent_decoded(body, pointer);
    Bytes bytes(plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) bytes[i] = static_cast<std::byte>(plain[i]);
    return bytes;
}

}  // namespace gnomon::assets::gltf
