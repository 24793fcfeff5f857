#include "bench/text/format_number.h"

#include <cmath>
#include <cstdio>

namespace gnomon::bench {
namespace {

std::string three_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

std::string percent_words(double share) {
    constexpr double kPercent = 100.0;
    return three_digits(kPercent * share) + " %";
}

std::string count_words(double count) { return std::to_string(std::llround(count)); }

std::string factor_words(double factor) { return three_digits(factor); }

}  // namespace gnomon::bench
