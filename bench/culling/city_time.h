#pragma once
#include <string>

namespace gnomon::bench {

/// Returns a table of the time of the shadow stages in the built-in city, milliseconds per stage, while its traffic
/// moves. Rows: a standing camera and a driving one, on one thread and on as many as share a frame's lights. No device
/// draws anything.
std::string city_time_table();

}  // namespace gnomon::bench
