#include "bench/area_table/lobe_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <span>
#include <utility>

#include "systems/lighting/area_table.h"
#include "tests/long_run.h"

/// The checked-in table of area lights' lobes, against the program that writes it and the surface's own lobes.
namespace gnomon::bench {
namespace {

constexpr double kPi = glm::pi<double>();

constexpr LobePart kParts[] = {LobePart::reflected, LobePart::grazing};

FittedLobe in_table(LobePart part, std::uint32_t column, std::uint32_t row) {
    const lighting::AreaLobes& lobes = lighting::area_lobes()[row * kLobesAcross + column];
    const lighting::AreaLobe& lobe = part == LobePart::reflected ? lobes.reflected : lobes.grazing;
    return {lobe.lean, lobe.along, lobe.across, lobe.skew, lobe.size};
}

/// Integrates over the hemisphere, in steps that are finer toward the mirrored direction.
template <class Value>
double over_hemisphere(Value value) {
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double z = (i + 0.5) / kSteps, angle_rad = 2.0 * kPi * (k + 0.5) / kSteps, across = std::sqrt(1.0 - z * z);
            sum += value(glm::dvec3(across * std::cos(angle_rad), across * std::sin(angle_rad), z));
        }
    return sum * 2.0 * kPi / (kSteps * kSteps);
}

TEST(LobeTable, HasAnEntryPerRoughnessAndAngle) {
    EXPECT_EQ(lighting::area_lobes().size(), std::size_t{kLobesAcross} * kLobesAcross);
}

TEST(LobeTable, IsWhatTheProgramFits) {
    for (const LobePart part : kParts) for (const auto& [column, row] : {std::pair(31u, 0u), {20u, 0u}, {8u, 0u}}) {
        const FittedLobe checked_in = in_table(part, column, row);
        const FittedLobe fitted = fit_lobe(part, alpha_of(column), cosine_of(row), std::array{in_table(part, std::min(column + 1, 31u), row)});
        EXPECT_NEAR(fitted.along, checked_in.along, 0.02 * checked_in.along) << column;
        EXPECT_NEAR(fitted.size, checked_in.size, 1e-3 * checked_in.size);
    }
}

constexpr std::uint32_t kColumns[] = {24u, 16u, 31u};
constexpr std::size_t kCompared = kSanitized ? 1 : std::size(kColumns);  // an integral over the hemisphere for each

TEST(LobeTable, ReflectsWhatTheSurfaceDoes) {
    for (const LobePart part : kParts)
        for (const std::uint32_t column : std::span(kColumns).first(kCompared))
            for (const std::uint32_t row : {0u, 12u, 24u, 30u}) {
                const double alpha = alpha_of(column), cosine = cosine_of(row);
                const FittedLobe lobe = in_table(part, column, row);
                const double all =
                    over_hemisphere([&](const glm::dvec3& l) { return lobe_at(part, alpha, cosine, l); });
                const double fitted =
                    over_hemisphere([&](const glm::dvec3& l) { return fitted_at(lobe, alpha, cosine, l); });
                EXPECT_NEAR(fitted, 1.0, 0.01) << "a density";
                // Its size is by the share of the lobe above the surface, which is at least a half.
                // The grazing part is a tail of the places at which the program takes it, a thousand in all.
                const double off = part == LobePart::reflected ? 0.01 : 0.03;
                EXPECT_GE(lobe.size, (1.0 - off) * all) << column << " " << row;
                EXPECT_LE(lobe.size, 2.0 * (1.0 + off) * all) << column << " " << row;
            }
}

TEST(LobeTable, HasTheShapeOfTheSurfacesLobe) {
    for (const LobePart part : kParts)
        for (const std::uint32_t column : std::span(kColumns).first(kCompared))
            for (const std::uint32_t row : {0u, 12u, 24u}) {
                const double alpha = alpha_of(column), cosine = cosine_of(row);
                const FittedLobe lobe = in_table(part, column, row), other = in_table(part, column, row + 6);
                const double all =
                    over_hemisphere([&](const glm::dvec3& l) { return lobe_at(part, alpha, cosine, l); });
                const auto apart = [&](const FittedLobe& with) {
                    return over_hemisphere([&](const glm::dvec3& l) {
                        return 0.5 *
                               std::abs(lobe_at(part, alpha, cosine, l) / all - fitted_at(with, alpha, cosine, l));
                    });
                };
                EXPECT_LT(apart(lobe), part == LobePart::reflected ? 0.14 : 0.2) << column << " " << row;
                if (row > 0) {
                    EXPECT_GT(apart(other), apart(lobe)) << "the control: a lobe of another angle";
                }
            }
}

}  // namespace
}  // namespace gnomon::bench
