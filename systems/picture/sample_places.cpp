#include "systems/picture/sample_places.h"

#include <cmath>

namespace gnomon::picture {

glm::dvec2 sample_place_px(std::uint32_t index) {
    constexpr double kPlastic = 1.32471795724474602596;  // real root of x^3 = x + 1
    const auto place = [&](double step) {
        const double along = 0.5 + step * static_cast<double>(index);
        return along - std::floor(along) - 0.5;
    };
    return {place(1.0 / kPlastic), place(1.0 / (kPlastic * kPlastic))};
}

}  // namespace gnomon::picture
