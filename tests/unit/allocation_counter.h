#pragma once
#include <cstddef>

namespace gnomon {

/// Returns how often this executable has called operator new. Link tests/unit/allocation_counter.cpp to count.
std::size_t allocation_count();

}  // namespace gnomon
