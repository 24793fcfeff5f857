#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// What the fits read, beside the scene.
struct FitInputs {
    std::span<const ShadowRequest> requests;  // one per light
    const ReceiverCasterSets& sets;
    std::span<const glm::dvec3> lamps_ws_m;  // one per light (lamp_offsets.h); empty: where the lights are
    const History& held;                     // next history of the frame before; empty: none
    std::span<const std::uint64_t> moving;   // as CasterMotion::moving()
    bool shared_out = false;                 // within a budget: another filter waits for the next frame's shares
};

/// Reused storage of the fits and of the searches that they make; holds nothing between two frames.
struct FitStorage {
    SetScratch sets;
    FitScratch fits;
};

/// How often a light is fitted anew for maps of another size: for what its present ones tell, and once more because a
/// filter's border is a larger share of a smaller map.
inline constexpr std::uint32_t kMostSizes = 2;
/// Fits for one number of views: the first, one for each other size, and one more where these were too small.
inline constexpr std::uint32_t kFitsPerCount = kMostSizes + 2;
/// Numbers of cascades that are tried: 1, 2, 4; and the chosen one once more.
inline constexpr std::uint32_t kCountsTried = 4;
/// Bound on the fits of one light in one frame (FitChoice::fits): the default filter's maps twice, each with another
/// number of cascades, and one by the filter that stands in for them, which has no target to meet.
inline constexpr std::uint32_t kMaxFits = 2 * (1 + kCountsTried) * kFitsPerCount + 1;

/// Fits one light: appends its views with their casters, and says in FittedViews::lights what was chosen.
class LightFit {
public:
    LightFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, FitStorage& storage,
             FittedViews& out);

    /// Fits for the request as it stands; what an earlier run appended goes. `recount`: looks for another number of a
    /// sun's cascades now, where that is the fit's to choose. Returns why there are no views; Reason::none: there are.
    Reason run(const HeldLight& held, bool recount, HeldLight& next);
    /// Replaces the request, and with it the sets that follow from its size.
    void request_anew(const ShadowRequest& request);

    const ShadowRequest& request() const { return out_.lights[index_].request; }
    std::span<const ShadowView> views() const;

private:
    struct ArraySizes {
        std::size_t receivers, casters, points, beams, outlines;
    };
    static ArraySizes sizes_of(const ReceiverCasterSets& sets);
    ShadowRequest& request() { return out_.lights[index_].request; }
    void forget_views();
    bool fit_and_count(const HeldLight& held, bool recount, HeldLight& next);
    bool fit_once(const HeldLight& held, HeldLight& next);
    bool fit_size(const HeldLight& held, HeldLight& next);
    bool meets_target() const;
    bool is_count_due(const HeldLight& held, HeldLight& next) const;
    bool choose_count(const HeldLight& held, HeldLight& next);
    bool fit_count(std::uint32_t count, const ShadowRequest& usual, const HeldLight& held, HeldLight& next);
    void select_sets_again();
    Reason select_casters();

    const SceneSnapshot& scene_;
    const FitInputs& inputs_;
    const LightItem& light_;
    std::uint32_t index_;
    FitStorage& storage_;
    FittedViews& out_;
    std::size_t first_view_, first_caster_;
    ArraySizes first_resized_;  // lengths of FittedViews::resized_sets before this light
};

/// Returns what is held of a light without what it is held for: as if the next fit were its first.
HeldLight without_fits(const HeldLight& held);

}  // namespace gnomon::shadow
