#pragma once
#include "gnomon/frame.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/culling/contribution_culling.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/maps/tint_maps.h"
#include "systems/shadow/report/draw_times.h"

namespace gnomon::shadow {

/// Inputs of a report.
struct ReportInputs {
    const DrawnViews& drawn;
    const ReceiverCasterSets& sets;
    const MapCache& maps;
    const TintMaps& tints;
    const DrawTimes& times;
    const ContributionCulling& dim;
    bool has_rays = false;           // the casters' trees are on the device
    std::span<const double> cpu_us;  // one per light
};

/// Explains each light and each view that its map has room for, with the numbers behind it. Fills report.views, and
/// report.lights, which already counts draws.
void explain_lights(const SceneSnapshot& scene, const ReportInputs& in, FrameReport& report);

}  // namespace gnomon::shadow
