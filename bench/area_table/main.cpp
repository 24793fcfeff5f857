#include <cstdio>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <vector>

#include "bench/area_table/lobe_fit.h"

/// Writes systems/lighting/area_table.inc: lobes of all roughnesses and angles.
int main(int count, char** arguments) {
    using namespace gnomon::bench;
    if (count != 2) {
        std::cerr << "usage: gnomon_area_table FILE\n";
        return 2;
    }
    std::vector<FittedLobe> lobes(std::size_t{kLobesAcross} * kLobesAcross);
    FittedLobe above;  // first of the column before
    for (std::uint32_t column = kLobesAcross; column-- > 0;) {
        FittedLobe start = above;
        for (std::uint32_t row = 0; row < kLobesAcross; ++row) {
            FittedLobe& lobe = lobes[std::size_t{row} * kLobesAcross + column];
            start = fit_lobe(alpha_of(column), cosine_of(row), start);
            lobe = start;
            if (row == 0) above = lobe;
        }
    }
    std::ofstream file(arguments[1]);
    file << std::setprecision(7) << std::showpoint;
    for (const FittedLobe& l : lobes)
        file << "{" << l.lean << "f, " << l.along << "f, " << l.across << "f, " << l.skew << "f, " << l.reflected << ", "
             << l.grazing << "f},\n";
    return file.good() ? 0 : 1;
}
