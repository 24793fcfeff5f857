#include "engine/gl/glsl_library.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace gnomon::gl {

namespace {

using Tokens = std::span<const GlslToken>;

Error library_error(std::string what) { return {std::move(what), {}, {}, "glsl.library"}; }

bool opens(const GlslToken& token) { return token.is("(") || token.is("[") || token.is("{"); }
bool closes(const GlslToken& token) { return token.is(")") || token.is("]") || token.is("}"); }

/// Returns the place after the bracket that closes the one at `at`.
std::size_t after_bracket(Tokens tokens, std::size_t at) {
    int depth = 0;
    for (; at < tokens.size(); ++at) {
        depth += opens(tokens[at]) ? 1 : 0;
        depth -= closes(tokens[at]) ? 1 : 0;
        if (depth == 0) return at + 1;
    }
    return at;
}

/// Returns the length of the first top-level declaration: to its semicolon, or to the end of a function's body.
std::size_t declaration_length(Tokens tokens) {
    for (std::size_t at = 0; at < tokens.size();) {
        if (tokens[at].is(";")) return at + 1;
        const bool body = tokens[at].is("{") && at > 0 && tokens[at - 1].is(")");
        at = opens(tokens[at]) ? after_bracket(tokens, at) : at + 1;
        if (body) return at;
    }
    return tokens.size();
}

bool is_qualifier(const GlslToken& token) {
    constexpr std::array<std::string_view, 16> kQualifiers = {
        "const", "uniform", "buffer",   "readonly", "writeonly", "coherent", "restrict", "shared",
        "in",    "out",     "volatile", "precise",  "highp",     "mediump",  "lowp",     "flat"};
    return std::find(kQualifiers.begin(), kQualifiers.end(), token.text) != kQualifiers.end();
}

enum class Shape { function, structure, block, variables };

/// A top-level declaration taken apart.
struct Parsed {
    Shape shape = Shape::variables;
    bool is_opaque = false;              // a uniform or buffer
    std::vector<std::size_t> declared;   // places of the declared names
    std::size_t body = 0, body_end = 0;  // places after { and of } of a struct or block
};

/// Returns the place after layout(…) and qualifiers. Notes uniforms and buffers.
std::size_t after_qualifiers(Tokens tokens, bool& is_opaque) {
    std::size_t at = 0;
    while (at < tokens.size()) {
        if (tokens[at].is("layout")) {
            at = after_bracket(tokens, at + 1);
        } else if (is_qualifier(tokens[at])) {
            is_opaque = is_opaque || tokens[at].is("uniform") || tokens[at].is("buffer");
            ++at;
        } else {
            break;
        }
    }
    return at;
}

/// Adds the names of a list such as  a = 1, b[2];  that starts at `at`.
void add_declarators(Tokens tokens, std::size_t at, Parsed& parsed) {
    bool is_next = true;
    while (at < tokens.size() && !tokens[at].is(";")) {
        if (is_next && tokens[at].kind == GlslKind::name) {
            parsed.declared.push_back(at);
            is_next = false;
        }
        is_next = is_next || tokens[at].is(",");
        at = opens(tokens[at]) ? after_bracket(tokens, at) : at + 1;
    }
}

/// Adds the names of a block's members, which are top-level names where the block has no name for its instance.
void add_members(Tokens tokens, Parsed& parsed) {
    for (std::size_t at = parsed.body; at < parsed.body_end;) {
        std::size_t end = at;
        while (end < parsed.body_end && !tokens[end].is(";")) ++end;
        bool ignored = false;
        const std::size_t type = at + after_qualifiers(tokens.subspan(at, end - at), ignored);
        add_declarators(tokens.subspan(0, end), type + 1, parsed);
        at = end + 1;
    }
}

std::optional<Parsed> parse(Tokens tokens) {
    Parsed parsed;
    const std::size_t start = after_qualifiers(tokens, parsed.is_opaque);
    if (start + 1 >= tokens.size()) return std::nullopt;
    const bool is_struct = tokens[start].is("struct");
    const std::size_t brace = is_struct ? start + 2 : start + 1;
    if (is_struct || tokens[brace].is("{")) {
        if (brace >= tokens.size() || !tokens[brace].is("{")) return std::nullopt;
        parsed.shape = is_struct ? Shape::structure : Shape::block;
        parsed.body = brace + 1;
        parsed.body_end = after_bracket(tokens, brace) - 1;
        if (is_struct) {
            parsed.declared = {start + 1};
        } else {
            add_declarators(tokens, parsed.body_end + 1, parsed);
            if (parsed.declared.empty()) add_members(tokens, parsed);
        }
        return parsed;
    }
    std::size_t name = start + 1;  // after the type
    while (name < tokens.size() && tokens[name].is("[")) name = after_bracket(tokens, name);
    if (name + 1 < tokens.size() && tokens[name + 1].is("(")) {
        parsed.shape = Shape::function;
        parsed.declared = {name};
        return parsed;
    }
    add_declarators(tokens, name, parsed);
    return parsed.declared.empty() ? std::nullopt : std::optional(parsed);
}

/// Returns which names of a declaration may refer to top-level ones: none after a dot, no members of structs, none
/// within layout().
std::vector<bool> may_refer(Tokens tokens, const Parsed& parsed) {
    std::vector<bool> refers(tokens.size());
    for (std::size_t at = 0; at < tokens.size(); ++at)
        refers[at] = tokens[at].kind == GlslKind::name && !(at > 0 && tokens[at - 1].is("."));
    bool ignored = false;
    for (std::size_t at = 0; at < after_qualifiers(tokens, ignored); ++at) refers[at] = false;
    bool is_type = true;
    for (std::size_t at = parsed.body; at < parsed.body_end; ++at) {
        if (tokens[at].is("[")) {
            at = after_bracket(tokens, at) - 1;
            continue;
        }
        if (tokens[at].kind == GlslKind::name && !is_qualifier(tokens[at])) refers[at] = std::exchange(is_type, false);
        is_type = is_type || tokens[at].is(";");
    }
    return refers;
}

}  // namespace

std::string GlslLibrary::free_name(const std::string& name) const {
    std::string free = prefix_ + name;
    for (int n = 2; by_name_.contains(free); ++n) free = prefix_ + name + "_" + std::to_string(n);
    return free;
}

void GlslLibrary::call_elements(std::vector<GlslToken>& tokens) const {
    for (const Elements& elements : elements_)
        for (std::size_t at = 0; at + 3 < tokens.size(); ++at) {
            const bool is_element = tokens[at].is(elements.object) && tokens[at + 1].is(".") &&
                                    tokens[at + 2].is(elements.array) && tokens[at + 3].is("[");
            if (!is_element || (at > 0 && tokens[at - 1].is("."))) continue;
            tokens[after_bracket(tokens, at + 3) - 1].text = ")";
            tokens[at + 3].text = "(";
            tokens[at].text = elements.function;
            tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                         tokens.begin() + static_cast<std::ptrdiff_t>(at) + 3);
        }
}

Result<GlslNames> GlslLibrary::add(std::string_view text) {
    const auto read = glsl_tokens(text);
    if (!read) return read.error();
    std::vector<GlslToken> all = read.value();
    call_elements(all);
    GlslNames names;
    Tokens rest = all;
    while (!rest.empty()) {
        const Tokens tokens = rest.first(declaration_length(rest));
        rest = rest.subspan(tokens.size());
        if (tokens.size() == 1) continue;  // a lone semicolon
        const auto parsed = parse(tokens);
        if (!parsed) return library_error("no declaration: " + glsl_text(tokens));
        const auto is_replaced = [&](std::size_t at) { return replaced_.contains(tokens[at].text); };
        if (std::any_of(parsed->declared.begin(), parsed->declared.end(), is_replaced)) {
            if (!std::all_of(parsed->declared.begin(), parsed->declared.end(), is_replaced))
                return library_error("replaced in part: " + glsl_text(tokens));
            if (parsed->shape == Shape::block)
                blocks_.try_emplace(tokens[parsed->body - 2].text,
                                    tokens.begin() + static_cast<std::ptrdiff_t>(parsed->body),
                                    tokens.begin() + static_cast<std::ptrdiff_t>(parsed->body_end));
            continue;
        }
        if (parsed->shape == Shape::block || parsed->is_opaque)
            return library_error("a uniform or block that is not replaced: " + glsl_text(tokens));
        if (parsed->shape == Shape::function && !tokens.back().is("}"))
            return library_error("a prototype: " + glsl_text(tokens));

        Declaration made;
        made.tokens.assign(tokens.begin(), tokens.end());
        const std::vector<bool> refers = may_refer(tokens, *parsed);
        std::set<std::string, std::less<>> own;
        for (const std::size_t at : parsed->declared) {
            if (names.contains(tokens[at].text)) return library_error(tokens[at].text + " is declared twice");
            own.insert(tokens[at].text);
        }
        for (std::size_t at = 0; at < tokens.size(); ++at) {
            if (!refers[at] || own.contains(tokens[at].text)) continue;
            GlslToken& token = made.tokens[at];
            if (const auto replacement = replaced_.find(token.text); replacement != replaced_.end()) {
                token.text = replacement->second;
            } else if (const auto known = names.find(token.text); known != names.end()) {
                token.text = known->second;
                made.needs.insert(known->second);
            }
        }
        std::string contents;
        for (const GlslToken& token : made.tokens) contents.append(token.text).append(" ");
        const auto [known, is_new] = by_contents_.try_emplace(std::move(contents), declarations_.size());
        if (!is_new) {
            const Declaration& same = declarations_[known->second];
            for (std::size_t i = 0; i < parsed->declared.size(); ++i)
                names[tokens[parsed->declared[i]].text] = same.names[i];
            continue;
        }
        for (const std::size_t at : parsed->declared) {
            const std::string& name = tokens[at].text;
            made.names.push_back(free_name(name));
            by_name_[made.names.back()] = declarations_.size();
            names[name] = made.names.back();
        }
        for (std::size_t at = 0; at < tokens.size(); ++at)
            if (refers[at] && own.contains(tokens[at].text)) made.tokens[at].text = names[tokens[at].text];
        for (const std::size_t at : parsed->declared) made.tokens[at].text = names[tokens[at].text];
        declarations_.push_back(std::move(made));
    }
    return names;
}

std::vector<GlslLibrary::Member> GlslLibrary::members(std::string_view block) const {
    std::vector<Member> members;
    const auto found = blocks_.find(block);
    if (found == blocks_.end()) return members;
    Tokens rest = found->second;
    while (!rest.empty()) {
        std::size_t length = 0;
        while (length < rest.size() && !rest[length].is(";")) ++length;
        bool ignored = false;
        const std::size_t type = after_qualifiers(rest.first(length), ignored);
        if (type + 1 < length) {
            const std::string final = prefix_ + rest[type].text;
            members.push_back({by_name_.contains(final) ? final : rest[type].text, rest[type + 1].text,
                               type + 2 < length && rest[type + 2].is("[")});
        }
        rest = rest.subspan(std::min(length + 1, rest.size()));
    }
    return members;
}

/// Returns which declarations names need, directly or not.
std::vector<bool> GlslLibrary::needed(const std::set<std::string, std::less<>>& roots) const {
    std::vector<bool> needed(declarations_.size());
    std::vector<std::string> open(roots.begin(), roots.end());
    while (!open.empty()) {
        const auto found = by_name_.find(open.back());
        open.pop_back();
        if (found == by_name_.end() || needed[found->second]) continue;
        needed[found->second] = true;
        const auto& needs = declarations_[found->second].needs;
        open.insert(open.end(), needs.begin(), needs.end());
    }
    return needed;
}

std::string GlslLibrary::text(const std::set<std::string, std::less<>>& roots,
                              const std::set<std::string, std::less<>>& before) const {
    const std::vector<bool> wanted = needed(roots), known = needed(before);
    std::string text;
    for (std::size_t i = 0; i < declarations_.size(); ++i)
        if (wanted[i] && !known[i]) text.append(glsl_text(declarations_[i].tokens)).append("\n");
    return text;
}

}  // namespace gnomon::gl
