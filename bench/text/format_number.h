#pragma once
#include <string>

namespace gnomon::bench {

/// A share of 0 to 1 in per cent with three significant digits: "0.0643 %".
std::string percent_words(double share);
/// "42": a count that is kept as a number.
std::string count_words(double count);
/// "1.31": a factor with three significant digits.
std::string factor_words(double factor);

}  // namespace gnomon::bench
