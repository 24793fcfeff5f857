#include "engine/gl/glsl_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <utility>

namespace gnomon::gl {

namespace {

bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool continues_name(char c) { return starts_name(c) || is_digit(c); }

Error preprocessor_error(std::string what) { return {std::move(what), {}, {}, "glsl.preprocessor"}; }

/// Replaces comments by a blank, and joins lines that end in a backslash. Line breaks within comments stay.
std::string without_comments(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("//")) {
            i = std::min(text.find('\n', i), text.size());
        } else if (rest.starts_with("/*")) {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size());
            out.push_back(' ');
            out.append(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                           text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
                       '\n');
            i = std::min(end + 2, text.size());
        } else if (rest.starts_with("\\\n")) {
            i += 2;
        } else {
            out.push_back(text[i++]);
        }
    }
    return out;
}

std::size_t number_length(std::string_view text) {
    std::size_t n = 0;
    while (n < text.size()) {
        const bool exponent_sign = (text[n] == '+' || text[n] == '-') && n > 0 &&
                                   (text[n - 1] == 'e' || text[n - 1] == 'E') && !text.starts_with("0x");
        if (!continues_name(text[n]) && text[n] != '.' && !exponent_sign) break;
        ++n;
    }
    return n;
}

std::size_t symbol_length(std::string_view text) {
    constexpr std::array<std::string_view, 21> kLong = {
        "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
        "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="};
    const auto found =
        std::find_if(kLong.begin(), kLong.end(), [&](std::string_view symbol) { return text.starts_with(symbol); });
    return found == kLong.end() ? 1 : found->size();
}

/// Takes one line without directives apart.
std::vector<GlslToken> tokens_of_line(std::string_view line) {
    std::vector<GlslToken> tokens;
    std::uint32_t blanks = 0;
    for (std::size_t i = 0; i < line.size();) {
        if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
            ++i;
            ++blanks;
            continue;
        }
        const std::string_view rest = line.substr(i);
        GlslToken token{GlslKind::symbol, {}, tokens.empty(), blanks > 0, tokens.empty() ? blanks : 0};
        std::size_t length = 0;
        if (starts_name(rest.front())) {
            token.kind = GlslKind::name;
            while (length < rest.size() && continues_name(rest[length])) ++length;
        } else if (is_digit(rest.front()) || (rest.front() == '.' && rest.size() > 1 && is_digit(rest[1]))) {
            token.kind = GlslKind::number;
            length = number_length(rest);
        } else {
            length = symbol_length(rest);
        }
        token.text = rest.substr(0, length);
        tokens.push_back(std::move(token));
        i += length;
        blanks = 0;
    }
    return tokens;
}

/// State of the preprocessor over the lines of a text.
class Preprocessor {
public:
    std::optional<Error> take(std::string_view line) {
        std::vector<GlslToken> tokens = tokens_of_line(line);
        if (!tokens.empty() && tokens.front().is("#")) return directive(tokens);
        if (!active()) return std::nullopt;
        std::set<std::string, std::less<>> open;
        for (const GlslToken& token : tokens) expand(token, open, out);
        return std::nullopt;
    }
    bool is_closed() const { return branches_.empty(); }

    std::vector<GlslToken> out;

private:
    struct Branch {
        bool outer = false;  // the lines around it are active
        bool taken = false;  // an earlier branch was
        bool now = false;
    };

    bool active() const { return branches_.empty() || (branches_.back().outer && branches_.back().now); }

    /// Appends a token with macros expanded; a macro is not expanded within itself.
    void expand(const GlslToken& token, std::set<std::string, std::less<>>& open, std::vector<GlslToken>& into) const {
        const auto macro = token.kind == GlslKind::name ? macros_.find(token.text) : macros_.end();
        if (macro == macros_.end() || open.contains(token.text)) {
            into.push_back(token);
            return;
        }
        open.insert(token.text);
        const std::size_t first = into.size();
        for (const GlslToken& part : macro->second) expand(part, open, into);
        open.erase(token.text);
        if (into.size() == first) return;
        into[first].starts_line = token.starts_line;
        into[first].after_blank = token.after_blank;
        into[first].indent = token.indent;
    }

    std::optional<Error> directive(const std::vector<GlslToken>& line) {
        const std::string name = line.size() > 1 ? line[1].text : std::string{};
        const std::span<const GlslToken> rest = std::span(line).subspan(std::min<std::size_t>(2, line.size()));
        if (name == "ifdef" || name == "ifndef") {
            if (rest.empty()) return preprocessor_error("#" + name + " without a name");
            return begin(macros_.contains(rest.front().text) == (name == "ifdef"));
        }
        if (name == "if") return begin_if(rest);
        if (name == "elif" || name == "else") return next_branch(name, rest);
        if (name == "endif") {
            if (branches_.empty()) return preprocessor_error("#endif without #if");
            branches_.pop_back();
            return std::nullopt;
        }
        if (!active()) return std::nullopt;
        if (name == "define") return define(rest);
        if (name == "undef" && !rest.empty()) {
            macros_.erase(rest.front().text);
            return std::nullopt;
        }
        if (name == "version" || name == "line" || name == "pragma" || name.empty()) return std::nullopt;
        return preprocessor_error("#" + name + " is not supported");
    }

    std::optional<Error> begin(bool now) {
        branches_.push_back({active(), now, now});
        return std::nullopt;
    }
    std::optional<Error> begin_if(std::span<const GlslToken> condition) {
        if (!active()) return begin(false);
        const auto value = holds(condition);
        return value ? begin(*value) : preprocessor_error("an #if that is no logic of names and numbers");
    }
    std::optional<Error> next_branch(const std::string& name, std::span<const GlslToken> condition) {
        if (branches_.empty()) return preprocessor_error("#" + name + " without #if");
        Branch& branch = branches_.back();
        std::optional<bool> now = true;
        if (name == "elif" && branch.outer && !branch.taken) now = holds(condition);
        if (!now) return preprocessor_error("an #elif that is no logic of names and numbers");
        branch.now = !branch.taken && *now;
        branch.taken = branch.taken || branch.now;
        return std::nullopt;
    }
    std::optional<Error> define(std::span<const GlslToken> rest) {
        if (rest.empty() || rest.front().kind != GlslKind::name) return preprocessor_error("#define without a name");
        if (rest.size() > 1 && rest[1].is("(") && !rest[1].after_blank)
            return preprocessor_error("the macro " + rest.front().text + " has arguments");
        macros_[rest.front().text] = {rest.begin() + 1, rest.end()};
        return std::nullopt;
    }

    /// Returns the value of  a || b && !c  with names, numbers, defined and parentheses; nothing for other conditions.
    std::optional<bool> holds(std::span<const GlslToken> condition) const {
        std::size_t at = 0;
        const auto value = any_of(condition, at);
        return value && at == condition.size() ? value : std::nullopt;
    }
    std::optional<bool> any_of(std::span<const GlslToken> c, std::size_t& at) const {
        auto value = all_of(c, at);
        while (value && at < c.size() && c[at].is("||")) {
            const auto next = all_of(c, ++at);
            value = next ? std::optional(*value || *next) : std::nullopt;
        }
        return value;
    }
    std::optional<bool> all_of(std::span<const GlslToken> c, std::size_t& at) const {
        auto value = one_of(c, at);
        while (value && at < c.size() && c[at].is("&&")) {
            const auto next = one_of(c, ++at);
            value = next ? std::optional(*value && *next) : std::nullopt;
        }
        return value;
    }
    std::optional<bool> one_of(std::span<const GlslToken> c, std::size_t& at) const {
        if (at >= c.size()) return std::nullopt;
        const GlslToken& token = c[at++];
        if (token.is("!")) {
            const auto value = one_of(c, at);
            return value ? std::optional(!*value) : std::nullopt;
        }
        if (token.is("(")) {
            const auto value = any_of(c, at);
            return value && at < c.size() && c[at++].is(")") ? value : std::nullopt;
        }
        if (token.is("defined")) return is_defined(c, at);
        if (token.kind == GlslKind::symbol) return std::nullopt;
        std::set<std::string, std::less<>> open;
        std::vector<GlslToken> value;
        expand(token, open, value);
        if (value.size() == 1 && value.front().kind == GlslKind::number) return value.front().text != "0";
        return value.size() == 1 && value.front().text == token.text ? std::optional(false) : std::nullopt;
    }
    std::optional<bool> is_defined(std::span<const GlslToken> c, std::size_t& at) const {
        const bool bracketed = at < c.size() && c[at].is("(");
        at += bracketed ? 1 : 0;
        if (at >= c.size()) return std::nullopt;
        const bool value = macros_.contains(c[at++].text);
        if (bracketed && (at >= c.size() || !c[at++].is(")"))) return std::nullopt;
        return value;
    }

    std::map<std::string, std::vector<GlslToken>, std::less<>> macros_;
    std::vector<Branch> branches_;
};

/// Returns whether two tokens would become one without a blank between: names, numbers, or symbols such as - and -.
bool would_join(char last, char next) {
    if (continues_name(last)) return continues_name(next);
    return std::string_view("+-<>=!&|^*/%").find(last) != std::string_view::npos &&
           symbol_length(std::string{last, next}) > 1;
}

}  // namespace

Result<std::vector<GlslToken>> glsl_tokens(std::string_view text) {
    const std::string plain = without_comments(text);
    Preprocessor preprocessor;
    std::string_view rest = plain;
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        if (auto error = preprocessor.take(rest.substr(0, end))) return *std::move(error);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    if (!preprocessor.is_closed()) return preprocessor_error("an #if without its #endif");
    return std::move(preprocessor.out);
}

std::string glsl_text(std::span<const GlslToken> tokens) {
    std::string text;
    for (const GlslToken& token : tokens) {
        if (token.starts_line && !text.empty()) text.append("\n").append(token.indent, ' ');
        const bool joins = !text.empty() && would_join(text.back(), token.text.front());
        if (!token.starts_line && (token.after_blank || joins)) text.push_back(' ');
        text.append(token.text);
    }
    return text;
}

}  // namespace gnomon::gl
