#pragma once
#include <string>

namespace gnomon::bench {

/// Returns a table of the time of the shadow stages on one core beside 10 000 and 1 000 000 still casters. The camera
/// sees equally many of both. Rows: a still scene, one mover, and a walking camera. No device draws anything.
std::string update_cost_table();

}  // namespace gnomon::bench
