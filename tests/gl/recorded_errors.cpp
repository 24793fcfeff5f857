#include "tests/gl/recorded_errors.h"

#include <fstream>
#include <sstream>

namespace gnomon::test {
namespace {

constexpr const char* kDeviceKey = "device ";

struct Count {
    const char* name;
    std::size_t ErrorCounts::*value;
};
constexpr Count kErrors[] = {
    {"wrong", &ErrorCounts::wrong}, {"acne", &ErrorCounts::acne}, {"leak", &ErrorCounts::leak}};

std::string named(const ErrorsByRow::key_type& key) { return key.first + ", \"" + key.second + "\": "; }

template <class Differs>
std::vector<std::string> changes(const ErrorsByRow& recorded, const ErrorsByRow& found, const Differs& differs) {
    std::vector<std::string> lines;
    for (const auto& [key, counts] : found) {
        const auto before = recorded.find(key);
        if (before == recorded.end()) continue;
        for (const Count& count : kErrors) {
            const std::size_t was = before->second.*count.value, is = counts.*count.value;
            if (differs(was, is))
                lines.push_back(named(key) + count.name + " " + std::to_string(was) + " -> " + std::to_string(is) +
                                " px");
        }
    }
    return lines;
}

}  // namespace

RecordedErrors read_errors(const std::filesystem::path& file) {
    RecordedErrors errors;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with(kDeviceKey)) errors.device = line.substr(std::string(kDeviceKey).size());
        std::istringstream words(line);
        ErrorCounts counts;
        std::string light, row;
        if (!(words >> counts.scored >> counts.wrong >> counts.acne >> counts.leak >> light)) continue;
        std::getline(words >> std::ws, row);
        errors.rows[{light, row}] = counts;
    }
    return errors;
}

void write_errors(const std::filesystem::path& file, const RecordedErrors& errors, const std::string& about) {
    std::ofstream stream(file);
    stream << "# " << about << " Written by GNOMON_RECORD_ERRORS=1 gl_truth --gtest_filter=*ErrorGate.*\n"
           << kDeviceKey << errors.device << "\n# scored wrong acne leak light row\n";
    for (const auto& [key, counts] : errors.rows)
        stream << counts.scored << ' ' << counts.wrong << ' ' << counts.acne << ' ' << counts.leak << ' ' << key.first
               << ' ' << key.second << '\n';
}

std::vector<std::string> what_rose(const ErrorsByRow& recorded, const ErrorsByRow& found) {
    std::vector<std::string> lines = changes(recorded, found, [](std::size_t was, std::size_t is) { return is > was; });
    for (const auto& [key, counts] : found) {
        const auto before = recorded.find(key);
        if (before == recorded.end())
            lines.push_back(named(key) + "was never recorded");
        else if (before->second.scored != counts.scored)
            lines.push_back(named(key) + std::to_string(before->second.scored) + " -> " +
                            std::to_string(counts.scored) + " px are scored: the truth is another");
    }
    for (const auto& [key, counts] : recorded)
        if (!found.contains(key)) lines.push_back(named(key) + "is missing");
    return lines;
}

std::vector<std::string> what_fell(const ErrorsByRow& recorded, const ErrorsByRow& found) {
    return changes(recorded, found, [](std::size_t was, std::size_t is) { return is < was; });
}

}  // namespace gnomon::test
