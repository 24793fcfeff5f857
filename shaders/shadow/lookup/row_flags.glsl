// Flags of the light's row. Every name is 0 or 1: program_defines() in systems/shadow/frame/shader_key.h.
const bool kIsSun = LIGHT_DIRECTIONAL == 1;
const bool kIsSpot = LIGHT_SPOT == 1;
#if LIGHT_AREA
const int kRectangleShape = 1, kDiscShape = 2, kSphereShape = 3, kTubeShape = 4;
const int kShape = LIGHT_RECTANGLE * kRectangleShape + LIGHT_DISC * kDiscShape + LIGHT_SPHERE * kSphereShape + LIGHT_TUBE * kTubeShape;
const bool kSquarePlaces = kShape == kRectangleShape || kShape == kTubeShape;   // places of a source are those of a square
const bool kOfMiddle = SHADOW_OF_MIDDLE == 1;   // the filter sees the source's middle alone
#endif
const bool kReadsDepths = SHADOW_DEPTHS == 1;     // the filter reads stored depths; others read results of comparing
const bool kReadsMoments = SHADOW_MOMENTS == 1;   // the filter reads a prefiltered map
const bool kFootprint = SHADOW_FOOTPRINT == 1;     // it reads as many of its texels as a pixel covers
const bool kReadsTaps = !kReadsDepths && !kReadsMoments;
const bool kFades = SHADOW_FADES == 1;            // a first lookup fades into a second one
const bool kManualBias = SHADOW_MANUAL_BIAS == 1; // any BiasMode other than the automatic one
const bool kAsksRays = SHADOW_RAYS == 1;          // rays are tested against the casters' triangles, from surfaces with
                                                  // their exact place
