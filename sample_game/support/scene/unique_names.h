#pragma once
#include <string>
#include <string_view>
#include <unordered_set>

namespace gnomon::game {

/// Names of lights, unique and fit for file names. Longer names are cut to 200 characters. Characters outside
/// [A-Za-z0-9._-] become '_'. A name that is taken gets the first free suffix of ".1", ".2", ...
class LightNames {
public:
    /// Returns the first of `node_name`, `light_name`, "light<index>" that is not empty, made fit and unique.
    std::string next(std::string_view node_name, std::string_view light_name, std::size_t index);

private:
    std::unordered_set<std::string> taken_;
};

}  // namespace gnomon::game
