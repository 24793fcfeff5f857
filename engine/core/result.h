#pragma once
#include <string>
#include <utility>
#include <variant>

namespace gnomon {

/// Why a load-time operation failed. `message` is one line, fit for a user.
/// For files: `file` names it, `pointer` is the JSON pointer of the offending value ("" if none),
/// `rule` is a stable identifier such as "accessor.out_of_range".
struct Error {
    std::string message;
    std::string file = {};
    std::string pointer = {};
    std::string rule = {};
};

/// One line: file, pointer, rule and message, those that are not empty.
inline std::string to_line(const Error& error) {
    std::string line;
    if (!error.file.empty()) line += error.file + ": ";
    if (!error.pointer.empty()) line += error.pointer + ": ";
    line += error.message;
    if (!error.rule.empty()) line += " [" + error.rule + "]";
    return line;
}

/// A value or an Error. Load time only: frame code reports through flags instead.
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
