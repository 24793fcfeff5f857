#include <cstdio>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <vector>

#include "bench/area_table/lobe_fit.h"

namespace {

using namespace gnomon::bench;

/// Fits all lobes of a part, each from its neighbours of a lower angle and of the next roughness.
std::vector<FittedLobe> all_lobes(LobePart part) {
    std::vector<FittedLobe> lobes(std::size_t{kLobesAcross} * kLobesAcross);
    for (std::uint32_t column = kLobesAcross; column-- > 0;)
        for (std::uint32_t row = 0; row < kLobesAcross; ++row) {
            const std::size_t here = std::size_t{row} * kLobesAcross + column;
            std::vector<FittedLobe> starts;
            if (row > 0) starts.push_back(lobes[here - kLobesAcross]);
            if (column + 1 < kLobesAcross) starts.push_back(lobes[here + 1]);
            lobes[here] = fit_lobe(part, alpha_of(column), cosine_of(row), starts);
        }
    return lobes;
}

}  // namespace

/// Writes systems/lighting/area_table.inc: lobes of all roughnesses and angles.
int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: gnomon_area_table FILE\n";
        return 2;
    }
    std::vector<FittedLobe> lobes[2];
    for (const LobePart part : {LobePart::reflected, LobePart::grazing})
        lobes[static_cast<std::size_t>(part)] = all_lobes(part);
    std::ofstream file(arguments[1]);
    file << std::setprecision(7) << std::showpoint;
    for (std::size_t i = 0; i < lobes[0].size(); ++i) {
        for (const std::vector<FittedLobe>& of : lobes)
            file << (&of == lobes ? "{{" : ", {") << of[i].lean << "f, " << of[i].along << "f, " << of[i].across
                 << "f, " << of[i].skew << "f, " << of[i].size << "f}";
        file << "},\n";
    }
    return file.good() ? 0 : 1;
}
