#include <algorithm>

#include "tests/gl/truth_scenes.h"

// Shadow edges are where the prediction says they may be.
namespace gnomon {
namespace {

constexpr std::size_t kLeastPlaces = 500;
/// Receivers steeper toward the light than the bound allows for.
constexpr double kMostBeyond = 0.001;
constexpr double kMostMedianRatio = 3.0;

/// Places whose edge is farther off than predicted. Counted apart (`thin`): where the true shadow, or the light beside
/// it, is itself thinner than the prediction, or the truth is ambiguous there; a texel may miss such a thing altogether.
struct Beyond {
    std::size_t plain = 0, thin = 0;
};
Beyond beyond(const oracle::EdgeDisplacement& edge, double predicted_px) {
    Beyond count;
    for (const auto& place : edge.each)
        if (place.off_px > predicted_px) ++(place.still_px <= 2.0 * predicted_px ? count.thin : count.plain);
    return count;
}

class TruthEdges : public TruthTest {};

TEST_F(TruthEdges, AreNoFartherOffThanPredictedAndThePredictionIsNotIdle) {
    std::vector<double> ratios;
    for (const char* resolution : {"512", "1024", "2048"}) {
        for (const char* camera : {"0", "top"}) {
            bench::StageOptions options;
            options.size_px = {640, 360};
            options.camera = camera;
            options.settings = {std::string("resolution=") + resolution};
            for (const bench::LightAccuracy& light : measure(options).lights) {
                const oracle::EdgeDisplacement& edge = light.metrics.edge;
                if (edge.places < kLeastPlaces) continue;
                const double predicted_px = light.report.predicted_error_px;
                const Beyond count = beyond(edge, predicted_px);
                const double share = static_cast<double>(count.plain) / static_cast<double>(edge.places);
                SCOPED_TRACE(std::string(resolution) + ", " + camera + ", " + light.report.name);
                std::printf("%s %s %s: predicted %.2f px, p99 %.2f px, beyond %zu, of thin things %zu, of %zu\n",
                            resolution, camera, light.report.name.c_str(), predicted_px, edge.p99_px, count.plain,
                            count.thin, edge.places);
                EXPECT_LE(share, kMostBeyond);
                ratios.push_back(predicted_px / std::max(edge.p99_px, 1e-9));
            }
        }
    }
    ASSERT_GE(ratios.size(), 9u);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], kMostMedianRatio);
}

}  // namespace
}  // namespace gnomon
