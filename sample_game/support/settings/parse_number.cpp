#include "sample_game/support/settings/parse_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace gnomon::game {
namespace {

template <class T>
std::optional<T> read_all(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
    const std::optional<double> value = read_all<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> read_count(std::string_view text) { return read_all<std::uint64_t>(text); }

std::string on_one_line(std::string_view text) {
    constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7f;
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(),
        [](char c) {
            const unsigned char code = static_cast<unsigned char>(c);
            return code < kFirstPrintable || code == kDelete;
        },
        '?');
    return line;
}

}  // namespace gnomon::game
