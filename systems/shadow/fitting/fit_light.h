#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/jobs.h"
#include "systems/extract/sampled_depths.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/stage_storage.h"

namespace gnomon::shadow {

/// Inputs of the fits, beside the scene.
struct FitInputs {
    std::span<const ShadowRequest> requests;  // one per light
    const ReceiverCasterSets& sets;
    std::span<const glm::dvec3> lamps_ws_m;  // one per light (lamp_offsets.h); empty: the lights' own positions
    const SampledDepths& sampled_depths;     // depths of an earlier picture; optional
    const History& previous;                 // fit history that the frame before left; empty: none
    std::span<const std::uint64_t> moving;   // as DynamicCasters::moving()
    bool budget_active = false;              // a budget is active, or rays lack memory: another filter is for later
    Jobs* jobs = nullptr;                    // threads that share the lights; null: the calling one does all
};

/// Most changes of a light's map size in one fit. The first follows the present maps' error. The second corrects for
/// the filter's border, a larger share of a smaller map.
inline constexpr std::uint32_t kMostSizes = 2;
/// Fits for one number of views: the first, one for each other size, and one more where these were too small.
inline constexpr std::uint32_t kFitsPerCount = kMostSizes + 2;
/// Numbers of cascades that are compared: 1, 2, 4; and the chosen one once more.
inline constexpr std::uint32_t kCountsTried = 4;
/// Bound on the fits of one light in one frame (FitChoice::fits). The default filter is fitted twice, each time with
/// other numbers of cascades. The filter that replaces it is fitted once, without a target.
inline constexpr std::uint32_t kMaxFits = 2 * (1 + kCountsTried) * kFitsPerCount + 1;

/// Fit of one light: appends its views with their casters and records the choice in FittedViews::lights.
class LightFit {
public:
    LightFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, StageScratch& scratch,
             FittedViews& out);

    /// Fits for the request as it stands and replaces what an earlier run appended. `recount`: also compares other
    /// numbers of a sun's cascades, where the system chooses. Returns why there are no views; Reason::none: there are.
    Reason run(const LightFitHistory& previous, bool recount, LightFitHistory& next);
    /// Replaces the request and the sets that follow from its size.
    void request_anew(const ShadowRequest& request);

    const ShadowRequest& request() const { return out_.lights[index_].request; }
    std::span<const ShadowView> views() const;

private:
    struct ArraySizes {
        std::size_t receivers, casters, points, error_points, hulls, outlines;
    };
    static ArraySizes sizes_of(const ReceiverCasterSets& sets);
    ShadowRequest& request() { return out_.lights[index_].request; }
    void forget_views();
    bool fit_and_count(const LightFitHistory& previous, bool recount, LightFitHistory& next);
    bool fit_once(const LightFitHistory& previous, LightFitHistory& next);
    bool fit_size(const LightFitHistory& previous, LightFitHistory& next);
    bool has_met_target() const;
    double target_px() const;
    bool has_casters_by_depth(const ShadowView& view) const;
    bool count_moves(const LightFitHistory& previous, LightFitHistory& next) const;
    bool choose_count(const LightFitHistory& previous, LightFitHistory& next);
    bool fit_count(std::uint32_t count, const ShadowRequest& usual, const LightFitHistory& previous,
                   LightFitHistory& next);
    void select_sets_again();
    Reason select_casters(bool turns);

    const SceneSnapshot& scene_;
    const FitInputs& inputs_;
    const LightItem& light_;
    std::uint32_t index_;
    StageScratch& scratch_;
    FittedViews& out_;
    std::size_t first_view_, first_caster_;
    ArraySizes first_resized_;  // lengths of FittedViews::resized_sets without this light
};

/// Returns a light's history without its fits, so that the next fit starts as its first.
LightFitHistory without_fits(const LightFitHistory& previous);

}  // namespace gnomon::shadow
