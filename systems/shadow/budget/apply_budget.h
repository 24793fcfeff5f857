#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/budget/allocate_quality.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// One per light: bytes of the map of a light that waits for room on the device; empty: it does not wait.
using WaitingBytes = std::span<const std::optional<std::uint64_t>>;

/// What a budget reads, beside the scene.
struct BudgetInputs {
    std::span<const ShadowRequest> requests;  // one per light, as asked for
    const ReceiverCasterSets& sets;
    const FittedViews& fitted;
    const History& held;
    WaitingBytes waiting_bytes;  // MapStore::waiting_bytes(); those lights keep what they got until it tries again
};

/// What a budget leaves for drawing maps in one frame, by its model.
struct DrawAllowance {
    bool limited = false;
    double room_ns = 0.0;
    double factor = 1.0;  // measured over modelled time of drawing
};

/// Keeps all lights within a budget. What each was left in the last frame is in the fits' History; its request starts
/// from that, so that it is fitted for the maps that it gets. After the fits, which say what each is worth, it is
/// settled anew: a light that has to give up something does so in the same frame, one that is given more in the next.
class BudgetStage {
public:
    /// Once per frame in which the stages run, first.
    void begin(const BudgetLimits& limits, const CostFactors& factors) {
        limits_ = limits;
        factors_ = factors;
    }
    bool is_active() const { return !(limits_ == BudgetLimits{}); }
    const BudgetLimits& limits() const { return limits_; }

    /// Decides what is left of each light's request, one entry per light; writes the lights' grants to `next`. A light
    /// that is left nothing is skipped with over_budget.
    void decide(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs, History& next,
                std::vector<BudgetDecision>& decisions, const LightAccounts& accounts);
    DrawAllowance draw_allowance() const;
    /// Notes in `next` how much of each light changes, once it is known what is drawn.
    void note_changes(const SceneSnapshot& scene, const DrawnViews& drawn, History& next) const;
    /// Fills LightReport::budget.
    void report(FrameReport& report) const;

    /// Whether begin() with these would decide anew in a frame in which nothing else changed.
    bool is_moved_by(const BudgetLimits& limits, const CostFactors& factors) const;

private:
    std::uint64_t collect(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs,
                          const History& next, std::span<const LightStatus> statuses);
    LightLoad load_of(const SceneSnapshot& scene, const GpuScene& gpu, const BudgetInputs& inputs, std::uint32_t light,
                      const HeldLight& next) const;
    void weigh(const SceneSnapshot& scene, const BudgetInputs& inputs);

    BudgetLimits limits_;
    CostFactors factors_, decided_factors_;
    std::vector<LightLoad> loads_;        // of lights that would have maps
    std::vector<Grant> grants_;           // one per load
    std::vector<std::uint32_t> lights_;   // one per load: index of its light
    std::vector<std::size_t> held_;       // one per load: index into History::lights
    std::vector<BudgetReport> outcomes_;  // one per load
    BudgetScratch scratch_;
    double lookups_ns_ = 0.0;  // of all loads, as granted
};

/// Writes what each light's last grant leaves of its request to `limited`, one entry per light.
void limit_by_grants(const SceneSnapshot& scene, const History& held, std::span<const ShadowRequest> requests,
                     std::vector<ShadowRequest>& limited);

}  // namespace gnomon::shadow
