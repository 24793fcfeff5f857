#pragma once
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/culling/contribution_culling.h"
#include "systems/shadow/frame/types.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/report/draw_times.h"

namespace gnomon::shadow {

/// What became of each light and of each view that its map has room for, and the numbers behind it: fills
/// report.lights, which counts what was drawn already, and report.views. `rays`: what rays walk is on the device.
void explain_lights(const SceneSnapshot& scene, const ShadowFrame& frame, const MapStore& maps, const DrawTimes& times,
                    const DimLights& dim, bool rays, FrameReport& report);

}  // namespace gnomon::shadow
