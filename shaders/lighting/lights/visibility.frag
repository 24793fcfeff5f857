// One light over its screen rectangle: its visibility alone. VISIBLE_SHARE, LEAVE_UNDECIDED: as in light.frag.
// MIDDLES: writes states of edges/middle_state.glsl; what they add to shares. AREAS_ALONE: leaves out areas that no edge
// crosses.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "lighting/edges/middle_state.glsl"
#include VISIBLE_SHARE
layout(location = 0) out float visibility_out;

void main() {
    Surface surface = read_surface(ivec2(gl_FragCoord.xy));
    if (!surface.exists) discard;
    LightSample incoming = light_at(surface.position_ca);
    float visible = visible_share(surface, incoming);
#ifdef LEAVE_UNDECIDED
    if (shadow_undecided) discard;
#endif
#ifdef AREAS_ALONE
    if (!shadow_crossed) discard;
#endif
    visibility_out = visible;
#ifdef MIDDLES
    visibility_out += MIDDLES;
    if (is_unreached(surface.geometric_normal, incoming)) visibility_out = kUnreached;
#endif
}
