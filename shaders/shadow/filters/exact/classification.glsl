// Certainty of the light's map of sheets about a place, as the light's middle sees it.
#include "shadow/filters/exact/classify.glsl"

// Returns whether the receiver's own surface is drawn into the map, as are all surfaces that cast and are seen. A
// blended one is not.
bool receiver_casts(uvec2 receiver) {
#ifdef BLENDED_RECEIVER
    return false;
#else
    return receiver != kNoReceiver && (cast_layers(instance_record(receiver.x)) & uint(light.to_light.w + 0.5)) != 0u;
#endif
}
