#pragma once
#include <string>
#include <string_view>
#include <unordered_set>

namespace gnomon::game {

/// Names of lights, unique and fit for file names: what is longer than 200 characters is cut there, characters outside
/// [A-Za-z0-9._-] become '_', a name that is taken gets ".1", ".2", the first that is free.
class LightNames {
public:
    /// The first of `node_name`, `light_name`, "light<index>" that is not empty, made fit and unique.
    std::string next(std::string_view node_name, std::string_view light_name, std::size_t index);

private:
    std::unordered_set<std::string> taken_;
};

}  // namespace gnomon::game
