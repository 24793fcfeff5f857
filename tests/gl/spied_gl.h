#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Stands between the executor and the driver while it lives, in the loader's table of functions, and lists every call
/// with its numbers. One at a time.
class SpiedGl {
public:
    SpiedGl();
    ~SpiedGl();
    SpiedGl(const SpiedGl&) = delete;
    SpiedGl& operator=(const SpiedGl&) = delete;

    /// Returns the names of all functions that are listed.
    static std::vector<std::string> names();
    /// Returns the calls since the last take(), each as "glEnable(3042)"; pointers are "*".
    std::vector<std::string> take();
};

/// Counts the calls of functions with names that begin like this.
std::size_t count_calls(const std::vector<std::string>& calls, std::string_view name);

/// Returns the names of the functions in order, repeated ones once with their number: "glDisable x21".
std::vector<std::string> names_of(const std::vector<std::string>& calls);

}  // namespace gnomon
