#pragma once
#include "systems/extract/snapshot.h"
#include "systems/report.h"
#include "systems/shadow/dim_lights.h"
#include "systems/shadow/draw_times.h"
#include "systems/shadow/map_store.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// What became of each light and of each view that its map has room for, and the numbers behind it: fills
/// report.lights, which counts what was drawn already, and report.views. `rays`: what rays walk is on the device.
void explain_lights(const SceneSnapshot& scene, const ShadowFrame& frame, const MapStore& maps, const DrawTimes& times,
                    const DimLights& dim, bool rays, FrameReport& report);

}  // namespace gnomon::shadow
