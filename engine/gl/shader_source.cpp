#include "engine/gl/shader_source.h"

#include <algorithm>
#include <cstdint>
#include <optional>

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

/// Returns the path in a line  #include "path" ; nothing for other lines.
std::optional<std::string_view> included_path(std::string_view line) {
    line = without_leading_blanks(line);
    if (!take(line, "#")) return std::nullopt;
    line = without_leading_blanks(line);
    if (!take(line, "include")) return std::nullopt;
    line = without_leading_blanks(line);
    if (!take(line, "\"")) return std::nullopt;
    const std::size_t end = line.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    return line.substr(0, end);
}

class Expansion {
public:
    explicit Expansion(std::span<const ShaderFile> files) : files_(files), states_(files.size(), State::unseen) {}

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
    std::vector<State> states_;
};

}  // namespace

Result<std::string> expand_shader(std::span<const ShaderFile> files, std::string_view path,
                                  std::span<const std::string> defines) {
    Expansion expansion(files);
    expansion.text = "#version 450 core\n";
    for (const std::string& define : defines) expansion.text.append("#define ").append(define).append("\n");
    if (auto error = expansion.add(path, {}, 0)) return *std::move(error);
    return std::move(expansion.text);
}

}  // namespace gnomon::gl
