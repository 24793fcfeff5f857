#include "bench/text/wrap_lines.h"

namespace gnomon::bench {
namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }

/// Returns where to break text[from, end): the last blank within `columns`, or the first one behind. `end`: nowhere.
std::size_t break_of(const std::string& text, std::size_t from, std::size_t end, std::size_t columns) {
    std::size_t best = end, characters = 0;
    for (std::size_t i = from; i < end; ++i) {
        if (text[i] == ' ' && i > from && (characters <= columns || best == end)) best = i;
        characters += begins_character(text[i]);
        if (characters > columns && best != end) return best;
    }
    return characters > columns ? best : end;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t columns) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t newline = text.find('\n', at);
        const std::size_t end = newline == std::string::npos ? text.size() : newline;
        while (at < end) {
            const std::size_t stop = break_of(text, at, end, columns);
            out.append(text, at, stop - at);
            at = stop;
            if (stop == end) break;
            while (at < end && text[at] == ' ') ++at;
            if (at < end) out += '\n';
        }
        if (newline == std::string::npos) break;
        out += '\n';
        at = newline + 1;
    }
    return out;
}

}  // namespace gnomon::bench
