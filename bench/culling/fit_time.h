#pragma once
#include <string>

namespace gnomon::bench {

/// What the fit of one view costs beside the search for what it is fitted to: microseconds by 100 to 10 000 visible
/// receivers, and by as many casters, each with the slope over both (1: linear). Exact fits go around every point that
/// is seen of every receiver; conservative ones take the slice of the view (stable) or the boxes' extents (quantised).
std::string one_fit_table();

}  // namespace gnomon::bench
