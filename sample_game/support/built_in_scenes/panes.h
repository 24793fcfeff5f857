#pragma once
#include <cstddef>
#include <vector>

namespace gnomon::game {

/// Makes a scene of coloured glass as binary glTF: a leaded window, panes that overlap, opaque balls before and behind
/// them, and a shelf of glass that is lit itself. Light: a sun and a spot. Camera: "main". Same bytes every time.
std::vector<std::byte> make_panes();

}  // namespace gnomon::game
