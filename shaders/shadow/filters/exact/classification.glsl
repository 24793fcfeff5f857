// What the light's map of sheets is certain of, as its middle sees the place.
#include "shadow/filters/exact/classify.glsl"

// Whether the receiver's own surface is drawn into the map, as what is seen of all that casts is; a blended one is not.
bool receiver_casts(uvec2 receiver) {
#ifdef BLENDED_RECEIVER
    return false;
#else
    return receiver != kNoReceiver && (cast_layers(instance_record(receiver.x)) & uint(light.to_light.w + 0.5)) != 0u;
#endif
}
