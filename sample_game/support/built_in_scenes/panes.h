#pragma once
#include <cstddef>
#include <vector>

namespace gnomon::game {

/// Makes a scene of coloured glass as binary glTF: a leaded window, and two panes that overlap, with opaque balls above
/// and below. Light: a sun and a spot. Camera: "main". Same bytes every time.
std::vector<std::byte> make_panes();

}  // namespace gnomon::game
