#include "engine/assets/gltf_error.h"

#include <cstddef>
#include <utility>

namespace gnomon::assets::gltf {
namespace {
constexpr std::size_t kLongestQuote = 160;
constexpr char kFirstPrintable = ' ';
constexpr char kLastPrintable = '~';
}  // namespace

void fail(std::string rule, std::string pointer, std::string message) {
    throw Failure{Error{std::move(message), {}, std::move(pointer), std::move(rule)}};
}

std::string taken(std::string rule, std::string pointer, std::string message) {
    return to_line(Error{std::move(message), {}, std::move(pointer), std::move(rule)});
}

std::string printable(std::string_view text) {
    const bool shortened = text.size() > kLongestQuote;
    std::string line{text.substr(0, kLongestQuote)};
    for (char& c : line) {
        if (c == '\n') c = ' ';
        if (c < kFirstPrintable || c > kLastPrintable) c = '?';
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return shortened ? line + "..." : line;
}

}  // namespace gnomon::assets::gltf
