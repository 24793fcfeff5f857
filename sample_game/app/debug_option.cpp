#include "sample_game/app/debug_option.h"

#include <algorithm>

#include "gnomon/light.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {
namespace {

constexpr std::uint64_t kMostMaps = kMaxCascades;

std::string spelling(const debug::ViewRow& row) {
    return std::string(row.name) + (row.needs_light ? ":LIGHT[:MAP]" : "[:LIGHT[:MAP]]");
}

Error wrong(const char* flag, const std::string& message, const char* rule) {
    return {.message = std::string(flag) + ": " + on_one_line(message), .rule = rule};
}

/// Takes what comes before the first colon off `text`.
std::string_view take_word(std::string_view& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view word = text.substr(0, colon);
    text.remove_prefix(std::min(colon + 1, text.size()));
    return word;
}

}  // namespace

Result<debug::Request> read_debug_request(std::string_view text) {
    const std::string whole(text);
    const std::ptrdiff_t colons = std::count(text.begin(), text.end(), ':');
    debug::Request request;
    request.view = debug::find_view(take_word(text));
    if (!request.view) return wrong("--debug", "unknown view in '" + whole + "'; --list shows them", "debug.view");
    request.light = std::string(take_word(text));
    const bool all = colons == 0 && !request.view->needs_light;
    if (colons > 2 || (request.light.empty() && !all))
        return wrong("--debug", "'" + whole + "' is not " + spelling(*request.view), "debug.syntax");
    if (colons < 2) return request;
    const auto layer = read_count(text);
    if (!layer || *layer >= kMostMaps)
        return wrong("--debug", "'" + whole + "': the map is a number of 0 to " + std::to_string(kMostMaps - 1),
                     "debug.syntax");
    request.layer = static_cast<std::uint32_t>(*layer);
    return request;
}

std::optional<Error> check_debug_light(const debug::Request& request, const std::vector<std::string>& lights) {
    return request.light.empty() ? std::nullopt : check_shadowed_light("--debug", request.light, lights);
}

std::optional<Error> check_shadowed_light(const char* flag, const std::string& name,
                                          const std::vector<std::string>& lights) {
    if (std::find(lights.begin(), lights.end(), name) != lights.end()) return std::nullopt;
    std::string known;
    for (const std::string& light : lights) known += (known.empty() ? "" : ", ") + light;
    return wrong(flag, "no light '" + name + "' has a shadow; there are: " + (known.empty() ? "none" : known),
                 "debug.light");
}

std::string list_debug_views() {
    std::string text = "Views of --debug:\n";
    for (const debug::ViewRow& row : debug::view_table())
        text += "  " + spelling(row) + "  " + std::string(row.meaning) + "\n";
    return text;
}

}  // namespace gnomon::game
