#pragma once
#include <string>

namespace gnomon::bench {

/// Returns a table of the time of one view's fit, microseconds, without the search for receivers and casters. It goes
/// from 100 to 10 000 visible receivers, and as many casters, each with its slope (1: linear). Exact fits enclose every
/// visible point of every receiver. Conservative ones take the slice of the view (stable) or the boxes' extents
/// (quantised).
std::string one_fit_table();

}  // namespace gnomon::bench
