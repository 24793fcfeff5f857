// One light over its screen rectangle: what its map is certain of, pixel by pixel. All other pixels are listed for
// rays. Pixels go in step: tracing at once would cost their neighbours as much.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "lighting/gbuffer/surface_position.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#include "lighting/trace/ray_list_layout.glsl"
#include "lighting/trace/ray_list.glsl"
layout(early_fragment_tests) in;   // by depth: there is a surface
layout(location = 0) out uint verdict_out;

int verdict_of(ivec2 pixel, Surface surface) {
    LightSample incoming = light_at(surface.position_ca);
    if (is_unreached(surface.geometric_normal, incoming)) return kCertainlyDark;
    SurfacePlace place = unpacked_place(surface.place);
    if (!takes_shadow(received_layers(instance_record(place.instance)))) return kCertainlyLit;
    SeenPlace seen = seen_place(pixel, place);
#if LIGHT_AREA
    // The map sees from the source's middle: it is certain of nothing that turns away from it.
    if (!(dot(surface.geometric_normal, incoming.to_light) > 0.0)) return kUncertain;
#endif
    return certainty(seen.position_ca, seen.error_m, receiver_of(place));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int verdict = verdict_of(pixel, read_surface(pixel));
    verdict_out = uint(verdict);
    // It is a loop, because software devices run what is in an if for every pixel, but no round of a loop that none
    // needs.
    for (int lists = verdict == kUncertain ? 1 : 0; lists > 0; --lists) {
        uint place = atomicAdd(ray_count, 1u);
        listed_pixels[place] = uint(pixel.x) | uint(pixel.y) << 16;
        verdict_out = kListed + place;
    }
}
