#pragma once

#include <regex.h>

#include <string>

namespace gnomon::bench {

/// A regular expression of a command line, in POSIX's extended syntax. An empty one matches every text.
/// POSIX's, since std::regex takes seconds to compile, and fails with GCC 12's warnings under the sanitizers.
class Pattern {
public:
    explicit Pattern(const std::string& text)
        : everything_(text.empty()),
          valid_(everything_ || regcomp(&compiled_, text.c_str(), REG_EXTENDED | REG_NOSUB) == 0) {}
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;
    ~Pattern() {
        if (valid_ && !everything_) regfree(&compiled_);
    }

    /// Returns false where the text is no regular expression. Then nothing may be matched.
    bool is_valid() const { return valid_; }
    /// Returns true where a part of the text matches.
    bool matches(const std::string& text) const {
        return everything_ || regexec(&compiled_, text.c_str(), 0, nullptr, 0) == 0;
    }

private:
    bool everything_;
    regex_t compiled_{};
    bool valid_;
};

}  // namespace gnomon::bench
