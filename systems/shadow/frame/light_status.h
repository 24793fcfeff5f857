#pragma once
#include "gnomon/frame.h"

namespace gnomon::shadow {

/// Outcome of one light up to the present stage. Every stage adds to it, none removes anything. The report is made from
/// it.
class LightStatus {
public:
    /// Leaves the light without a shadow. The first reason is reported.
    void skip(Reason reason) {
        if (skip_ == Reason::none) skip_ = reason;
    }
    /// Notes a degradation. The latest is reported, because a failed pass matters more than a clamped setting.
    void degrade(Reason reason) { note_ = reason; }
    /// Takes the light's maps out of use in this frame. `rays`: rays replace them; otherwise the light has no shadow.
    void lose_maps(Reason reason, bool rays) {
        maps_lost_ = true;
        if (rays)
            degrade(reason);
        else
            skip(reason);
    }
    /// Takes the prefiltered maps out of use. The depth map is looked up instead.
    void lose_prefiltered(Reason reason) {
        prefiltered_lost_ = true;
        degrade(reason);
    }
    /// Takes the layers of translucent casters out of use. These cast nothing then.
    void lose_tint(Reason reason) {
        tint_lost_ = true;
        degrade(reason);
    }

    bool is_skipped() const { return skip_ != Reason::none; }
    Reason skipped() const { return skip_; }
    Reason degraded() const { return note_; }
    bool has_lost_maps() const { return maps_lost_; }
    bool has_lost_prefiltered() const { return prefiltered_lost_; }
    bool has_lost_tint() const { return tint_lost_; }

private:
    Reason skip_ = Reason::none, note_ = Reason::none;
    bool maps_lost_ = false, prefiltered_lost_ = false, tint_lost_ = false;
};

}  // namespace gnomon::shadow
