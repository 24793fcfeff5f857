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

/// Counts by the names of light and row.
using ErrorsByRow = std::map<std::pair<std::string, std::string>, ErrorCounts>;

struct RecordedErrors {
    std::string device;
    ErrorsByRow rows;
};

/// Returns what a file records; nothing if it cannot be read.
RecordedErrors read_errors(const std::filesystem::path& file);
/// Writes them, below a comment on what they are.
void write_errors(const std::filesystem::path& file, const RecordedErrors& errors, const std::string& about);

/// Returns a line for each count that is higher than recorded, and for each row that cannot be compared. Such a row is
/// in one of the two alone, or has another number of scored pixels, since the truth has changed.
std::vector<std::string> what_rose(const ErrorsByRow& recorded, const ErrorsByRow& found);
/// Returns a line for each count that is lower than recorded.
std::vector<std::string> what_fell(const ErrorsByRow& recorded, const ErrorsByRow& found);

}  // namespace gnomon::test
