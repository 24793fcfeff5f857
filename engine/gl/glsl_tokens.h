#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/result.h"

namespace gnomon::gl {

enum class GlslKind : std::uint8_t { name, number, symbol };

/// Token of GLSL without comments and directives. Names include keywords; symbols are operators and punctuation.
struct GlslToken {
    GlslKind kind = GlslKind::symbol;
    std::string text;
    bool starts_line = false;  // first of its line
    bool after_blank = false;  // blanks stand before it on its line
    std::uint32_t indent = 0;  // blanks before it, if it is the first of its line
    bool is(std::string_view what) const { return text == what; }
};

/// Takes a text apart, and runs its preprocessor: comments and inactive lines are gone, object-like macros expanded.
/// #version, #line and #pragma are dropped. #if takes numbers, names, defined, !, && and ||.
/// Errors (rule "glsl.preprocessor"): other directives, macros with arguments, an #if without its #endif.
Result<std::vector<GlslToken>> glsl_tokens(std::string_view text);

/// Writes tokens as text, in the lines that they came in.
std::string glsl_text(std::span<const GlslToken> tokens);

}  // namespace gnomon::gl
