#include "sample_game/support/scene/unique_names.h"

namespace gnomon::game {
namespace {

/// A file's name may have 255 characters: this leaves room for ".pfm" and any number (LightNames).
constexpr std::size_t kLongestName = 200;

bool is_plain(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
}

}  // namespace

std::string LightNames::next(std::string_view node_name, std::string_view light_name, std::size_t index) {
    std::string name(!node_name.empty() ? node_name : light_name);
    if (name.empty()) name = "light" + std::to_string(index);
    if (name.size() > kLongestName) name.resize(kLongestName);
    for (char& c : name)
        if (!is_plain(c)) c = '_';
    std::string unique = name;
    for (std::size_t repeat = 1; !taken_.insert(unique).second; ++repeat) unique = name + "." + std::to_string(repeat);
    return unique;
}

}  // namespace gnomon::game
