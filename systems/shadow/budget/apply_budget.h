#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/budget/allocate_quality.h"
#include "systems/shadow/budget/update_scheduler.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// One per light: bytes of the map of a light that waits for room on the device; empty: it does not wait.
using WaitingBytes = std::span<const std::optional<std::uint64_t>>;

/// Keeps all lights within a budget. What each was left in the last frame is in the fits' History; its demand starts
/// from that, so that it is fitted for the maps that it gets. After the fits, which say what each is worth, it is
/// settled anew: who has to give up something does so in the same frame, who is given more is so in the next.
class BudgetStage {
public:
    /// Once per frame in which the stages run, first.
    void begin(const BudgetLimits& limits, const CostFactors& factors) {
        limits_ = limits;
        factors_ = factors;
    }
    bool is_active() const { return !(limits_ == BudgetLimits{}); }
    const BudgetLimits& limits() const { return limits_; }

    /// After decide_demand().
    void apply(const SceneSnapshot& scene, const History& held, std::vector<ShadowDemand>& demands);
    /// After fit_views(): sets sets[i].skip to over_budget, or what is granted of the demand; writes next_history.
    /// `waiting_bytes`: MapStore::waiting_bytes(); those lights keep what they got, until the store tries again.
    void decide(const SceneSnapshot& scene, const GpuScene& gpu, const History& held, WaitingBytes waiting_bytes,
                ShadowFrame& frame);
    /// After MapStore::assign_slots(): has views wait where all that are due would take more than the budget leaves for
    /// drawing in one frame.
    void spread_draws(const GpuScene& gpu, const SceneSnapshot& scene, ShadowFrame& frame);
    /// After that: how much of each light changes.
    void note_changes(const SceneSnapshot& scene, ShadowFrame& frame) const;
    /// Fills LightReport::budget.
    void report(FrameReport& report) const;

    /// Whether begin() with these would decide anew in a frame in which nothing else changed.
    bool is_moved_by(const BudgetLimits& limits, const CostFactors& factors) const;

private:
    std::uint64_t collect(const SceneSnapshot& scene, const GpuScene& gpu, WaitingBytes waiting_bytes,
                          ShadowFrame& frame);
    LightLoad load_of(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, std::uint32_t d,
                      std::size_t first_view, std::size_t end_view, const HeldLight& next) const;
    void weigh(const SceneSnapshot& scene, const ShadowFrame& frame);
    void grant(const LightLoad& load, const Grant& grant, ShadowDemand& demand, PotentialSets& sets) const;

    BudgetLimits limits_;
    CostFactors factors_, decided_factors_;
    std::vector<ShadowDemand> wanted_;    // one per light, as asked for
    std::vector<LightLoad> loads_;        // of lights that would have maps
    std::vector<Grant> grants_;           // one per load
    std::vector<std::uint32_t> demands_;  // one per load: index of its demand
    std::vector<std::size_t> held_;       // one per load: index into History::lights
    std::vector<BudgetReport> outcomes_;  // one per load
    BudgetScratch scratch_;
    double lookups_ns_ = 0.0;  // of all loads, as granted
    std::vector<DueView> due_;
};

}  // namespace gnomon::shadow
