#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/glsl_tokens.h"
#include "gnomon/result.h"

namespace gnomon::gl {

/// Names by which a text's own top-level names are called in a library.
using GlslNames = std::map<std::string, std::string, std::less<>>;

/// Joins several GLSL texts into one, in which all of them can be called. Top-level names (functions, structs,
/// constants, variables) get a prefix. Where two texts declare the same name with other contents, the second gets a
/// number as well. What they declare alike stands there once.
/// Members after a dot and members of structs keep their names. A local name that hides a top-level one is renamed with
/// it, which changes nothing.
class GlslLibrary {
public:
    /// Creates an empty library. `replaced`: names with the text that stands in their place. Their declarations are
    /// dropped: uniform blocks and samplers, which a joined program has once.
    GlslLibrary(std::string prefix, std::map<std::string, std::string, std::less<>> replaced)
        : prefix_(std::move(prefix)), replaced_(std::move(replaced)) {}

    /// Makes elements of an array into calls: `object`.`array`[i] becomes `function`(i). Call it before add().
    void replace_elements(std::string object, std::string array, std::string function) {
        elements_.push_back({std::move(object), std::move(array), std::move(function)});
    }

    /// Adds a text with its includes resolved (expand_shader()). Returns its names.
    /// Errors: those of glsl_tokens(); overloads and prototypes, and blocks or samplers that are not replaced (rule
    /// "glsl.library").
    Result<GlslNames> add(std::string_view text);

    /// Member of a block: final name of its type, its own name.
    struct Member {
        std::string type, name;
        bool is_array = false;
        bool operator==(const Member&) const = default;
    };
    /// Returns the members of a dropped block; none if there was none of that name.
    std::vector<Member> members(std::string_view block) const;

    /// Returns the declarations that `roots` (final names) need, in order. It leaves out what `before` needs.
    std::string text(const std::set<std::string, std::less<>>& roots,
                     const std::set<std::string, std::less<>>& before = {}) const;

private:
    struct Declaration {
        std::vector<std::string> names;            // final
        std::set<std::string, std::less<>> needs;  // final names that it refers to
        std::vector<GlslToken> tokens;
    };

    struct Elements {
        std::string object, array, function;
    };

    void call_elements(std::vector<GlslToken>& tokens) const;
    std::vector<bool> needed(const std::set<std::string, std::less<>>& roots) const;
    std::string free_name(const std::string& name) const;

    std::string prefix_;
    std::map<std::string, std::string, std::less<>> replaced_;
    std::vector<Elements> elements_;
    std::vector<Declaration> declarations_;
    std::map<std::string, std::size_t, std::less<>> by_contents_;  // into declarations_
    std::map<std::string, std::size_t, std::less<>> by_name_;      // final name, into declarations_
    std::map<std::string, std::vector<GlslToken>, std::less<>> blocks_;
};

}  // namespace gnomon::gl
