#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace gnomon {

/// Reason why a load-time operation failed. `message` is one line, fit for a user. `file` names the file. `pointer` is
/// the JSON pointer of the offending value, empty if there is none. `rule` is a stable identifier such as
/// "accessor.out_of_range".
struct Error {
    std::string message;
    std::string file = {};
    std::string pointer = {};
    std::string rule = {};
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
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }
    T& value() & { return std::get<0>(state_); }
    const T& value() const& { return std::get<0>(state_); }
    T&& value() && { return std::get<0>(std::move(state_)); }
    const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<T, Error> state_;
};

}  // namespace gnomon

namespace gnomon::gl {

/// Why the device could not do something. Nothing is mapped, so that no null pointer can occur.
enum class Failure : std::uint8_t {
    none,
    out_of_memory,
    invalid_value,
    incomplete_target,
    compile_failed,
    link_failed,
    context_lost
};
const char* to_text(Failure failure);

}  // namespace gnomon::gl
