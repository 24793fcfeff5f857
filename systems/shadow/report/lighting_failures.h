#pragma once
#include "gnomon/frame.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::shadow {

/// Adds to the report what became of lights in the frame's pictures. If a picture shows a light otherwise than by its
/// own row, the report describes that picture. Among several pictures it describes one with a failure.
void add_outcome(const LightingOutcome& outcome, FrameReport& report);

}  // namespace gnomon::shadow
