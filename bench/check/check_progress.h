#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace gnomon::bench {

/// Called before each step with what it is, which of how many ("programs", 3,
/// 900).
using CheckProgress = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

}  // namespace gnomon::bench
