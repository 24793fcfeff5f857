#pragma once
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/culling/contribution_culling.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/report/draw_times.h"

namespace gnomon::shadow {

/// What a report is made from.
struct ReportInputs {
    const DrawnViews& drawn;
    const ReceiverCasterSets& sets;
    const MapStore& maps;
    const DrawTimes& times;
    const DimLights& dim;
    bool has_rays = false;           // what rays walk is on the device
    std::span<const double> cpu_us;  // one per light
};

/// Says what became of each light and of each view that its map has room for, and the numbers behind it: fills
/// report.lights, which counts what was drawn already, and report.views.
void explain_lights(const SceneSnapshot& scene, const ReportInputs& in, FrameReport& report);

}  // namespace gnomon::shadow
