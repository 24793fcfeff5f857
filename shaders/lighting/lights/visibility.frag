// One light over its screen rectangle: its visibility alone. VISIBLE_SHARE, LEAVE_UNDECIDED: as in light.frag.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include VISIBLE_SHARE
layout(location = 0) out float visibility_out;

void main() {
    Surface surface = read_surface(ivec2(gl_FragCoord.xy));
    if (!surface.exists) discard;
    float visible = visible_share(surface, light_at(surface.position_ca));
#ifdef LEAVE_UNDECIDED
    if (shadow_undecided) discard;
#endif
    visibility_out = visible;
}
