#pragma once
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/core/result.h"

namespace gnomon::assets::gltf {

/// Thrown inside the loader only; load_gltf turns it into a Result.
struct Failure {
    Error error;
};

[[noreturn]] void fail(std::string rule, std::string pointer, std::string message);

/// A warning's line about what is outside the letter of the format and was taken all the same, as an error's line has
/// it.
std::string taken(std::string rule, std::string pointer, std::string message);

/// JSON pointer from keys and indices: pointer("accessors", 3, "sparse") is "/accessors/3/sparse".
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

/// Text from a file, fit for a one-line message: printable ASCII, shortened.
std::string printable(std::string_view text);

}  // namespace gnomon::assets::gltf
