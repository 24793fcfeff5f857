// What the light's row is compiled for. Every name is 0 or 1: program_defines() in systems/shadow/frame/shader_key.h.
const bool kIsSun = LIGHT_DIRECTIONAL == 1;
const bool kIsSpot = LIGHT_SPOT == 1;
const bool kReadsDepths = SHADOW_DEPTHS == 1;     // stored depths, where other filters read results of comparing
const bool kReadsMoments = SHADOW_MOMENTS == 1;   // a prefiltered map
const bool kFootprint = SHADOW_FOOTPRINT == 1;     // of that what a pixel covers
const bool kReadsTaps = !kReadsDepths && !kReadsMoments;
const bool kFades = SHADOW_FADES == 1;            // a second lookup, which the first one fades into
const bool kManualBias = SHADOW_MANUAL_BIAS == 1; // any BiasMode other than the automatic one
const bool kAsksRays = SHADOW_RAYS == 1;          // the casters' triangles, of surfaces that say where exactly they are
