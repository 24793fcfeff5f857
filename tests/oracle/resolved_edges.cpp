#include "tests/oracle/resolved_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/oracle/answers.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/texel_footprint.h"

namespace gnomon::oracle {
namespace {

/// Between rays over a square, along each of its sides.
constexpr double kSquareStepTexel = 0.125;
constexpr double kSampling_texel = 0.5;

class WideSquares {
public:
    WideSquares(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                const LightItem& light, const LightTruth& truth, std::span<const std::uint32_t> pieces,
                const TexelAt& texel_at)
        : tracer_(tracer),
          hits_(hits),
          consumer_(consumer),
          light_(light),
          truth_(truth),
          pieces_(pieces),
          texel_at_(texel_at),
          answers_(kQuestions * truth.scored.size()) {}

    bool is_certain(std::size_t pixel) const {
        return answers_.get(kQuestions * pixel, [&] { return shows_one_surface(tracer_, hits_, consumer_, truth_, pixel); });
    }
    bool is_wide(std::size_t pixel, bool dark) const {
        return answers_.get(kQuestions * pixel + (dark ? 1 : 2), [&] { return find_wide(pixel, dark); });
    }

private:
    static constexpr std::size_t kQuestions = 3;  // per pixel: whether it is certain, wide shadow, wide light

    /// Tries the squares around the pixel, the one around its middle first.
    bool find_wide(std::size_t pixel, bool dark) const {
        const glm::dvec3& middle = hits_.position_rel_m[pixel];
        const TexelThere texel = texel_at_(middle, hits_.normal_ws[pixel]);
        const double side_texel = std::numbers::sqrt2 * (kSampling_texel + texel.reach_texel);
        if (!(glm::length(texel.u_m) > 0.0)) return true;  // in no map: lit
        const Footprint f{middle, texel.u_m, texel.v_m, hits_.normal_ws[pixel],
                          toward(light_, consumer_, hits_, middle)};
        const double least_m = dark ? f.least_m(texel) : 0.0;
        const int steps = std::max(2, static_cast<int>(std::ceil(side_texel / kSquareStepTexel)));
        const int across = 2 * steps + 1;
        enum : std::uint8_t { unknown, same, other };
        std::vector<std::uint8_t> rays(static_cast<std::size_t>(across) * across, unknown);
        const auto piece_at = [&](double u_texel, double v_texel) {
            const std::uint32_t seen =
                tracer_.nearest_to_light(f.at(u_texel, v_texel), hits_.triangle[pixel], light_, least_m);
            return seen == kNoTriangle ? kNoTriangle : pieces_[seen];
        };
        const std::uint32_t own = piece_at(0.0, 0.0);
        if (dark != (own != kNoTriangle)) return false;
        const auto is_same = [&](int i, int j) {
            std::uint8_t& ray = rays[static_cast<std::size_t>(j) * across + i];
            if (ray == unknown)
                ray =
                    piece_at((i - steps) * side_texel / steps, (j - steps) * side_texel / steps) == own ? same : other;
            return ray == same;
        };
        const auto is_whole = [&](int i0, int j0) {
            // Coarse rays first: most squares that are not whole are found so.
            for (const int stride : {std::max(steps / 2, 1), 1})
                for (int j = j0; j <= j0 + steps; j += stride)
                    for (int i = i0; i <= i0 + steps; i += stride)
                        if (!is_same(i, j)) return false;
            return true;
        };
        if (is_whole(steps / 2, steps / 2)) return true;
        for (int j = 0; j <= steps; ++j)
            for (int i = 0; i <= steps; ++i)
                if (is_whole(i, j)) return true;
        return false;
    }

    const ReferenceTracer& tracer_;
    const PrimaryHits& hits_;
    const ConsumerItem& consumer_;
    const LightItem& light_;
    const LightTruth& truth_;
    std::span<const std::uint32_t> pieces_;  // by the tracer's triangle
    const TexelAt& texel_at_;
    mutable Answers answers_;
};

}  // namespace

ResolvedEdges resolved_edges(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                             const LightItem& light, const LightTruth& truth, const EdgeDisplacement& edge,
                             std::span<const std::uint32_t> pieces, const TexelAt& texel_at) {
    const WideSquares squares(tracer, hits, consumer, light, truth, pieces, texel_at);
    enum class Kind : std::uint8_t { resolved, unresolved, ambiguous };
    std::vector<Kind> kinds(edge.each.size(), Kind::resolved);
    constexpr std::size_t kBlock = 64;
    parallel_rows(static_cast<std::uint32_t>((kinds.size() + kBlock - 1) / kBlock), 0, [&](std::uint32_t block) {
        for (std::size_t i = block * kBlock; i < std::min((block + 1) * kBlock, kinds.size()); ++i) {
            const EdgeDisplacement::Place& place = edge.each[i];
            if (!squares.is_certain(place.dark) || !squares.is_certain(place.bright))
                kinds[i] = Kind::ambiguous;
            else if (!squares.is_wide(place.dark, true) || !squares.is_wide(place.bright, false))
                kinds[i] = Kind::unresolved;
        }
    });
    ResolvedEdges out;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == Kind::resolved) out.each.push_back(i);
        out.unresolved += kinds[i] == Kind::unresolved;
        out.ambiguous += kinds[i] == Kind::ambiguous;
    }
    out.places = out.each.size();
    if (out.each.empty()) return out;
    std::sort(out.each.begin(), out.each.end(), [&](std::size_t a, std::size_t b) {
        return edge.each[a].off_px > edge.each[b].off_px || (edge.each[a].off_px == edge.each[b].off_px && a < b);
    });
    const auto all_but = [&](double share) {
        const auto most = static_cast<std::size_t>(std::ceil(share * static_cast<double>(out.places)));
        return edge.each[out.each[std::min(most, out.places - 1)]].off_px;
    };
    out.max_px = edge.each[out.each.front()].off_px;
    out.p99_px = all_but(0.01);
    out.p999_px = all_but(0.001);
    return out;
}

}  // namespace gnomon::oracle
