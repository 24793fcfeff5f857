#include "tests/oracle/edge_exceptions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/oracle/answers.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/texel_footprint.h"

namespace gnomon::oracle {
namespace {

constexpr double kStepPx = 0.25;
/// Greatest distance between rays over a footprint, along each of its sides. What is thinner can still lie before a
/// texel's middle, and be all that the map knows of its surroundings.
constexpr double kRayStepTexel = 0.25;
/// Search from a place along its edge. Places lie close together, and so do the steps of their searches. So answers
/// about a pixel are found once.
class Judge {
public:
    Judge(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer, const LightItem& light,
          const LightTruth& truth, const TexelAt& texel_at)
        : tracer_(tracer), hits_(hits), consumer_(consumer), light_(light), truth_(truth), texel_at_(texel_at), answers_(kQuestions * truth.scored.size()) {}

    double bound_px(const EdgeDisplacement::Place& place) const {
        const auto at = [&](std::size_t i) { return texel_at_(hits_.position_rel_m[i], hits_.normal_ws[i]).error_px; };
        return std::max(at(place.dark), at(place.bright));
    }

    enum class Cause { none, truth_ambiguous, sub_texel_caster };
    Cause cause(const EdgeDisplacement::Place& place, double bound_px) const {
        if (!shows(place, bound_px, false)) return Cause::sub_texel_caster;
        return shows(place, bound_px, true) ? Cause::none : Cause::truth_ambiguous;
    }

private:
    /// Returns whether the map must show shadow on the one side of the edge and light on the other.
    bool shows(const EdgeDisplacement::Place& place, double bound_px, bool certain) const {
        return shows(place.middle_px, -place.rise, true, bound_px, certain) &&
               shows(place.middle_px, place.rise, false, bound_px, certain);
    }

    bool shows(const glm::dvec2& from_px, const glm::dvec2& away, bool dark, double bound_px, bool certain) const {
        for (double s = 0.0; s <= bound_px; s += kStepPx)
            if (shows_at(from_px + away * s, dark, certain)) return true;
        return false;
    }

    /// Pictures have values at pixel centres and are read between them: most of a place's share must be whole.
    bool shows_at(const glm::dvec2& at_px, bool dark, bool certain) const {
        const glm::dvec2 base = glm::floor(at_px), f = at_px - base;
        double sure = 0.0;
        for (int dy = 0; dy <= 1; ++dy)
            for (int dx = 0; dx <= 1; ++dx) {
                const double share = (dx ? f.x : 1.0 - f.x) * (dy ? f.y : 1.0 - f.y);
                const auto x = static_cast<std::int64_t>(base.x) + dx, y = static_cast<std::int64_t>(base.y) + dy;
                if (!(share > 0.0) || x < 0 || y < 0 || x >= hits_.size_px.x || y >= hits_.size_px.y) continue;
                const auto pixel = static_cast<std::size_t>(y * hits_.size_px.x + x);
                if (is_whole(pixel, dark) && (!certain || is_certain(pixel))) sure += share;
            }
        return sure > 0.5;
    }

    static constexpr std::size_t kQuestions = 3;  // per pixel: is it certain, all dark, all lit
    bool is_certain(std::size_t pixel) const {
        return answers_.get(kQuestions * pixel, [&] { return shows_one_surface(tracer_, hits_, consumer_, truth_, pixel); });
    }
    bool is_whole(std::size_t pixel, bool dark) const {
        return answers_.get(kQuestions * pixel + (dark ? 1 : 2), [&] { return find_whole(pixel, dark); });
    }

    bool find_whole(std::size_t pixel, bool dark) const {
        if (!truth_.scored[pixel]) return false;
        const glm::dvec3 &middle = hits_.position_rel_m[pixel], &n = hits_.normal_ws[pixel];
        const TexelThere texel = texel_at_(middle, n);
        const Footprint f{middle, texel.u_m, texel.v_m, n, toward(light_, consumer_, hits_, middle)};
        const double least_m = dark ? f.least_m(texel) : 0.0;
        const int to_each_side = static_cast<int>(std::ceil(texel.reach_texel / kRayStepTexel));
        const double step_texel = texel.reach_texel / std::max(to_each_side, 1);
        for (int i = -to_each_side; i <= to_each_side; ++i)
            for (int j = -to_each_side; j <= to_each_side; ++j)
                if (tracer_.blocked(f.at(i * step_texel, j * step_texel), hits_.triangle[pixel], light_, least_m) !=
                    dark)
                    return false;
        return true;
    }

    const ReferenceTracer& tracer_;
    const PrimaryHits& hits_;
    const ConsumerItem& consumer_;
    const LightItem& light_;
    const LightTruth& truth_;
    const TexelAt& texel_at_;
    mutable Answers answers_;
};

}  // namespace

EdgeExceptions edge_exceptions(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                               const LightItem& light, const LightTruth& truth, const EdgeDisplacement& edge,
                               const TexelAt& texel_at) {
    const Judge judge(tracer, hits, consumer, light, truth, texel_at);
    struct Verdict {
        bool beyond = false;
        Judge::Cause cause = Judge::Cause::none;
    };
    std::vector<Verdict> verdicts(edge.each.size());
    parallel_rows(static_cast<std::uint32_t>(verdicts.size()), 0, [&](std::uint32_t i) {
        const EdgeDisplacement::Place& place = edge.each[i];
        const double bound_px = judge.bound_px(place);
        verdicts[i].beyond = place.off_px > bound_px;
        if (verdicts[i].beyond || i % kSampleEvery == 0) verdicts[i].cause = judge.cause(place, bound_px);
    });
    EdgeExceptions exceptions;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        const auto& [beyond, cause] = verdicts[i];
        const bool sampled = i % kSampleEvery == 0;
        if (!beyond && !sampled) continue;
        if (beyond && cause == Judge::Cause::none) exceptions.unexplained_places.push_back(i);
        if (beyond) {
            ++(cause == Judge::Cause::none              ? exceptions.unexplained
               : cause == Judge::Cause::truth_ambiguous ? exceptions.truth_ambiguous
                                                        : exceptions.sub_texel_caster);
        }
        exceptions.sampled += sampled;
        exceptions.excusable += sampled && cause != Judge::Cause::none;
    }
    return exceptions;
}

}  // namespace gnomon::oracle
