#pragma once
#include <string>

namespace gnomon::bench {

/// What the shadow stages cost on one core beside 10 000 and 1 000 000 still casters of which the camera sees equally
/// many: in a still scene, with one mover, and while the camera walks. A table for people; no device draws anything.
std::string update_cost_table();

}  // namespace gnomon::bench
