#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/frame.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/budget/allocate_quality.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/light_jobs.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// One per light: bytes of its map while a failed allocation is not yet to be tried again; else empty.
using WaitingBytes = std::span<const std::optional<std::uint64_t>>;

/// Inputs of a budget, beside the scene.
struct BudgetInputs {
    std::span<const ShadowRequest> requests;  // one per light, without limits
    const ReceiverCasterSets& sets;
    const FittedViews& fitted;
    const History& previous;
    WaitingBytes waiting_bytes;  // MapCache::waiting_bytes(); these lights keep their maps until the next try
    Jobs* jobs = nullptr;        // threads that share the lights; null: the calling one does all
};

/// What a budget leaves for drawing maps in one frame, by the cost model.
struct DrawAllowance {
    bool limited = false;
    double room_ns = 0.0;
    double factor = 1.0;  // measured over modelled time of drawing
};

/// Keeps all lights within a budget. The fit history has each light's limits of the last frame. Its request starts from
/// these, so that it is fitted for the maps that it gets. The allocation follows the fits, because they determine each
/// light's error cost. A light that loses quality does so in the same frame, a light that gains it in the next.
class BudgetStage {
public:
    /// Sets the budget and the cost factors. Call it first in each frame in which the stages run. `automatic_bytes`:
    /// limit for apply_automatic(); kNone: there is none.
    void begin(const BudgetLimits& limits, std::uint64_t automatic_bytes, const CostFactors& factors) {
        limits_ = limits;
        automatic_bytes_ = automatic_bytes;
        factors_ = factors;
    }
    /// Applies the automatic limit if lights want more, or still did in the last frame (automatic_limit.h). Call it
    /// after the fits.
    void apply_automatic(const SceneSnapshot& scene, const FittedViews& fitted, const History& previous,
                         std::span<const LightStatus> statuses);
    bool is_active() const { return !(limits_ == BudgetLimits{}); }
    const BudgetLimits& limits() const { return limits_; }
    /// Returns the limit on the bytes of all maps; kNone: there is none. Valid after apply_automatic().
    std::uint64_t map_limit() const { return with_given(limits_.bytes); }
    /// Returns the bytes up to which maps of unseen lights may be kept; kNone: any. Valid after
    /// apply_automatic().
    std::uint64_t keep_limit() const { return std::min(map_limit(), with_given(automatic_bytes_)); }

    /// Decides what is left of each light's request, one entry per light, and writes the lights' limits to `next`. A
    /// light that gets no map is skipped with over_budget.
    void decide(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs, History& next,
                std::vector<BudgetDecision>& decisions, const LightAccounts& accounts);
    DrawAllowance draw_allowance() const;
    /// Updates each light's activity in `next`, once it is known which views are drawn.
    void note_changes(const SceneSnapshot& scene, const DrawnViews& drawn, History& next) const;
    /// Fills LightReport::budget.
    void report(FrameReport& report) const;

    /// Returns whether begin() with these would change decisions in a frame without any other change.
    bool is_moved_by(const BudgetLimits& limits, const CostFactors& factors) const;

private:
    std::uint64_t collect(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs,
                          const History& next, std::span<const LightStatus> statuses);
    LightLoad load_of(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs, std::uint32_t light,
                      const LightFitHistory& next) const;
    static double usual_extent_px(const SceneSnapshot& scene, const BudgetInputs& inputs, std::uint32_t light);
    void weigh(const SceneSnapshot& scene, const BudgetInputs& inputs);
    bool is_any_less() const;
    bool is_automatic() const { return automatic_bytes_ != BudgetLimits::kNone && limits_.bytes == automatic_bytes_; }
    std::uint64_t with_given(std::uint64_t bytes) const {
        return bytes > BudgetLimits::kNone - given_bytes_ ? BudgetLimits::kNone : bytes + given_bytes_;
    }

    BudgetLimits limits_;
    std::uint64_t automatic_bytes_ = BudgetLimits::kNone;
    std::uint64_t given_bytes_ = 0;  // bytes on top of the automatic limit
    CostFactors factors_, decided_factors_;
    std::vector<LightLoad> loads_;        // lights that would have maps
    std::vector<QualityLimits> grants_;   // one per load
    std::vector<std::uint32_t> lights_;   // one per load: index of its light
    std::vector<std::size_t> histories_;  // one per load: index into History::lights
    std::vector<BudgetReport> outcomes_;  // one per load
    BudgetScratch scratch_;
    double lookups_ns_ = 0.0;  // time of all loads' lookups within their limits, ns
};

}  // namespace gnomon::shadow
