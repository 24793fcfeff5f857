#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// How many pixels each row of a small sweep gets wrong, as it was recorded: the regression gate's memory.
namespace gnomon::test {

struct ErrorCounts {
    std::size_t scored = 0, wrong = 0;
    std::size_t acne = 0, leak = 0;  // false shadow and false light away from every true edge
    bool operator==(const ErrorCounts&) const = default;
};

/// By the names of light and row.
using ErrorsByRow = std::map<std::pair<std::string, std::string>, ErrorCounts>;

struct RecordedErrors {
    std::string device;
    ErrorsByRow rows;
};

/// Nothing, if the file cannot be read.
RecordedErrors read_errors(const std::filesystem::path& file);
void write_errors(const std::filesystem::path& file, const RecordedErrors& errors);

/// A line for each count that is higher than recorded, and for what cannot be compared: a row that is in one of the two
/// alone, or whose scored pixels are others, for which the truth has changed.
std::vector<std::string> what_rose(const ErrorsByRow& recorded, const ErrorsByRow& found);
/// A line for each count that is lower.
std::vector<std::string> what_fell(const ErrorsByRow& recorded, const ErrorsByRow& found);

}  // namespace gnomon::test
