#pragma once
#include <string>
#include <string_view>
#include <type_traits>

#include "gnomon/result.h"

namespace gnomon::assets::gltf {

/// Exception inside the loader only; load_gltf turns it into a Result.
struct Failure {
    Error error;
};

[[noreturn]] void fail(std::string rule, std::string pointer, std::string message);

/// Formats the warning for an accepted violation of the format, in the form of an error's line.
std::string taken(std::string rule, std::string pointer, std::string message);

/// Builds a JSON pointer from keys and indices: pointer("accessors", 3, "sparse") gives "/accessors/3/sparse".
template <class... Parts>
std::string pointer(const Parts&... parts) {
    std::string text;
    const auto append = [&text](const auto& part) {
        text += '/';
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(part)>>) {
            text += std::to_string(part);
        } else {
            text += part;
        }
    };
    (append(parts), ...);
    return text;
}

/// Makes text from a file fit for a one-line message: printable ASCII, shortened.
std::string printable(std::string_view text);

}  // namespace gnomon::assets::gltf
