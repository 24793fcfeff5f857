#include "engine/gl/shader_source.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <regex>

namespace gnomon::gl {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view without_leading_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    return text;
}

bool take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

/// Returns what follows  #include  in a line; nothing for other lines.
std::optional<std::string_view> included(std::string_view line) {
    line = without_leading_blanks(line);
    if (!take(line, "#")) return std::nullopt;
    line = without_leading_blanks(line);
    if (!take(line, "include")) return std::nullopt;
    return line;
}

/// Returns the text between the quotes that a text starts with; nothing if it starts with none.
std::optional<std::string_view> quoted(std::string_view text) {
    text = without_leading_blanks(text);
    if (!take(text, "\"")) return std::nullopt;
    const std::size_t end = text.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    return text.substr(0, end);
}

/// Returns the name that a text starts with after a blank; nothing if it starts with none.
std::optional<std::string_view> name_after_blank(std::string_view text) {
    const std::string_view rest = without_leading_blanks(text);
    if (rest.size() == text.size() || rest.empty() || rest.front() < 'A' || rest.front() > 'Z') return std::nullopt;
    return rest.substr(0, rest.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"));
}

/// Returns whether a define names a file:  NAME "path" .
bool names_file(std::string_view define) { return define.find('"') != std::string_view::npos; }

class Expansion {
public:
    Expansion(std::span<const ShaderFile> files, std::span<const std::string> defines)
        : files_(files), defines_(defines), states_(files.size(), State::unseen) {}

    std::optional<Error> add(std::string_view path, std::string_view from, std::size_t from_line) {
        const auto file =
            std::find_if(files_.begin(), files_.end(), [&](const ShaderFile& f) { return f.path == path; });
        if (file == files_.end()) return missing(path, from, from_line);
        const auto number = static_cast<std::size_t>(file - files_.begin());
        if (states_[number] == State::open) return cycle(path, from, from_line);
        if (states_[number] == State::done) return std::nullopt;
        states_[number] = State::open;
        if (auto error = add_lines(*file, number)) return error;
        states_[number] = State::done;
        return std::nullopt;
    }

    std::string text;

private:
    enum class State : std::uint8_t { unseen, open, done };

    std::optional<Error> add_lines(const ShaderFile& file, std::size_t number) {
        begin_line(1, number, file.path);
        std::string_view rest = file.text;
        for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
            const std::size_t end = rest.find('\n');
            const std::string_view line = rest.substr(0, end);
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
            if (const auto path = included_path(line)) {
                if (auto error = add(*path, file.path, line_number)) return error;
                begin_line(line_number + 1, number, file.path);
            } else {
                text.append(line).append("\n");
            }
        }
        return std::nullopt;
    }

    /// Returns the path that a line includes, in quotes or by the name of a define. Returns the name itself if no
    /// define gives it a path, and nothing if the line includes no file.
    std::optional<std::string_view> included_path(std::string_view line) const {
        const auto rest = included(line);
        if (!rest) return std::nullopt;
        if (const auto path = quoted(*rest)) return path;
        const auto name = name_after_blank(*rest);
        if (!name) return std::nullopt;
        for (const std::string_view define : defines_)
            if (define.starts_with(*name) && define.substr(name->size()).starts_with(' '))
                if (const auto path = quoted(define.substr(name->size()))) return path;
        return name;
    }

    void begin_line(std::size_t line, std::size_t number, std::string_view path) {
        text.append("#line ").append(std::to_string(line)).append(" ").append(std::to_string(number));
        text.append("  // ").append(path).append("\n");
    }

    static std::string where(std::string_view from, std::size_t line) {
        return from.empty() ? std::string{} : " (included at line " + std::to_string(line) + ")";
    }
    static Error missing(std::string_view path, std::string_view from, std::size_t line) {
        return {std::string{"no shader file \""}.append(path).append("\"") + where(from, line),
                std::string{from},
                {},
                "shader.missing"};
    }
    static Error cycle(std::string_view path, std::string_view from, std::size_t line) {
        return {std::string{"\""}.append(path).append("\" includes itself") + where(from, line),
                std::string{from},
                {},
                "shader.cycle"};
    }

    std::span<const ShaderFile> files_;
    std::span<const std::string> defines_;
    std::vector<State> states_;
};

}  // namespace

Result<std::string> expand_shader(std::span<const ShaderFile> files, std::string_view path,
                                  std::span<const std::string> defines) {
    Expansion expansion(files, defines);
    expansion.text = "#version 450 core\n";
    for (const std::string& define : defines)
        if (!names_file(define)) expansion.text.append("#define ").append(define).append("\n");
    if (auto error = expansion.add(path, {}, 0)) return *std::move(error);
    return std::move(expansion.text);
}

std::string with_paths(const std::string& log, std::span<const ShaderFile> files) {
    // At the start of a line, or behind what a device or a compiler puts before the message.
    static const std::regex place(R"((^|\n|\): |ERROR: )(\d{1,6})(?=[:(]\d))");
    std::string text;
    auto rest = log.begin();
    for (std::sregex_iterator at(log.begin(), log.end(), place), end; at != end; ++at) {
        const std::size_t number = std::stoul((*at)[2].str());
        if (number >= files.size()) continue;
        text.append(rest, (*at)[2].first).append(files[number].path);
        rest = (*at)[2].second;
    }
    return text.append(rest, log.end());
}

}  // namespace gnomon::gl
