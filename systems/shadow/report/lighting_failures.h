#pragma once
#include "systems/report.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::shadow {

/// Adds to the report what became of lights in the frame's pictures. A light that a picture shows otherwise than by its
/// own row is described as it is there; of several pictures, one with a failure is described.
void add_outcome(const LightingOutcome& outcome, FrameReport& report);

}  // namespace gnomon::shadow
