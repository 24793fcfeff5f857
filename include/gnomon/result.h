#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace gnomon {

/// Reason why a load-time operation failed.
struct Error {
    std::string message;       // one line, fit for a user
    std::string file = {};     // file that it is about; empty: none
    std::string pointer = {};  // JSON pointer of the offending value; empty: none
    std::string rule = {};     // stable identifier, such as "accessor.out_of_range"
};

/// Joins file, pointer, rule and message into one line; leaves out empty ones.
inline std::string to_line(const Error& error) {
    std::string line;
    if (!error.file.empty()) line += error.file + ": ";
    if (!error.pointer.empty()) line += error.pointer + ": ";
    line += error.message;
    if (!error.rule.empty()) line += " [" + error.rule + "]";
    return line;
}

/// Value or Error. For load time only: frame code reports through flags instead.
template <class T>
class Result {
public:
    /// Contains a value.
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    /// Contains an error.
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    /// Returns whether there is a value.
    explicit operator bool() const { return state_.index() == 0; }
    /// Returns the value. Without one it throws std::bad_variant_access.
    T& value() & { return std::get<0>(state_); }
    /// Returns the value, as the one above does.
    const T& value() const& { return std::get<0>(state_); }
    /// Moves the value out.
    T&& value() && { return std::get<0>(std::move(state_)); }
    /// Returns the error. With a value it throws std::bad_variant_access.
    const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<T, Error> state_;
};

}  // namespace gnomon

namespace gnomon::gl {

/// Why the device could not do something. Nothing is mapped, so that no null pointer can occur.
enum class Failure : std::uint8_t {
    none,               // it could
    out_of_memory,      // no memory on the device
    invalid_value,      // an argument that the device refuses
    incomplete_target,  // no drawing into these textures
    compile_failed,     // a shader does not compile
    link_failed,        // a program does not link
    context_lost        // the context is gone: make everything again
};
/// Returns the failure's code, such as "out_of_memory".
const char* to_text(Failure failure);

}  // namespace gnomon::gl
