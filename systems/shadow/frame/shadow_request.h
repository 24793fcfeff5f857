#pragma once
#include <cstdint>
#include <glm/vec4.hpp>

#include "components/light_shadow.h"
#include "engine/gl/device.h"
#include "systems/report.h"
#include "systems/shadow/frame/fit_history.h"

namespace gnomon::shadow {

/// What of a light's filter settings holds: what is absurd is left out, what its map cannot bear is cut.
struct FilterSettings {
    std::uint32_t size = 3, taps = 16;
    /// E without the spread: what a program is compiled with.
    float reach_texel = 0.5f;
    /// In metres where above 0, else in texels; 0 of a filter that has none. Never more than most_spread_texel.
    float spread_m = 0.0f, spread_texel = 0.0f, most_spread_texel = 0.0f;
    float doubles_m = 0.0f;
    float cell_m = 1.0f;
    /// Size of the source: metres, and the tangent of a sun's angular radius. Both 0 of a filter that does not ask.
    float source_radius_m = 0.0f, sun_radius_tan = 0.0f;
    /// Bound on E: what a map's border leaves room for.
    float widest_texel = 0.5f;
    /// What of E cannot move an edge.
    float still_texel = 0.0f;
    /// What a map's border is made for, twice over: for what is read beside a point and for what the bias moves it. Of
    /// a penumbra the first alone, hence half.
    float border_texel = 0.5f;
    bool cut = false;  // not all is as asked for
};

/// What a prefiltered map is made and read with: a light's settings as its filter's format bears them.
struct PrefilterSettings {
    gl::Format format = gl::Format::r32f;
    /// As shaders/shadow/filters have them. x, y: exponents of the two warps; z: MomentStore::least; w: 1 if moments
    /// are stored in 16 bits.
    glm::vec4 settings{0.0f};
    float bleeding = 0.0f;
    std::uint32_t levels = 1, anisotropy = 1;
    bool sampler_anisotropy = true;  // whether that is the sampler's; if not, the lookup's: see kinds/point.glsl
    /// Most texels that a pixel is taken to cover along a side; 1: the map is read as finely as it is.
    float footprint_texel = 1.0f;
    /// What that adds to E.
    float reach_texel = 0.0f;
    bool cut = false;  // not all is as asked for
    bool operator==(const PrefilterSettings&) const = default;
};

/// What a light's maps are, and how they are read.
struct MapSettings {
    ShadowFilter filter = ShadowFilter::hard;
    DepthFormat depth_format = DepthFormat::d32f;
    FilterSettings filtering{};       // settings of the filter
    PrefilterSettings moments{};      // of filters with FilterRow::moments
    std::uint32_t resolution_px = 0;  // edge of the map or of a cube face that views are fitted for
    std::uint32_t reduced_px = 0;     // edge of the map where a budget leaves less than that; 0: resolution_px
    std::uint32_t view_count = 0;     // layers of the map
    float cascade_blend = 0.0f;       // share of a cascade that fades into the next
};

/// Returns the edge of the light's maps in this frame, texels.
inline std::uint32_t map_edge_px(const MapSettings& map) {
    return map.reduced_px > 0 ? map.reduced_px : map.resolution_px;
}

/// Bounds within which the fits choose a light's maps.
struct MapLimits {
    std::uint32_t max_px = 0;     // edge: the fit takes fewer texels where these meet the target (accuracy_target.h)
    std::uint32_t device_px = 0;  // the device's limit on that edge
    std::uint32_t max_views = 0;  // cascades of a sun, where their number is the fit's to choose; else 0
};

/// How a light projects onto its maps.
struct ProjectionRequest {
    int faces_eighths = 0;         // spot: share of cube faces against one view (projection/spot_cube_transition.h)
    LampAim aim = {};              // far lamp: one view of what is seen of what it lights (projection/far_lamp_aim.h)
    bool perspective_sun = false;  // one view from an eye instead of cascades
    float warp = 0.0f;             // sun: greatest warp of its maps (fitting/directional/fit_lispsm.h); 0: none
    double near_m = 0.0, far_m = 0.0;  // depth range, from the light or a sun's eye; 0: fitted
};

/// How a light uses rays.
struct RayUse {
    bool used = false;       // for pixels of which its map, if any, is not certain
    bool only = false;       // for all pixels: it has no map
    bool fell_back = false;  // the ray budget leaves none: another filter stands in for its own
};

/// Struct 2. What one light asks for. Stages from the fits on hand on a copy with what they chose.
struct ShadowRequest {
    Reason skip = Reason::none;  // why the light wants no shadow at all
    Reason note = Reason::none;  // a degradation that the request itself causes (resolution_clamped, …)
    MapSettings map;
    MapLimits limits;
    ProjectionRequest projection;
    RayUse rays;
};

/// Says whether a light with a shadow looks up a map.
inline bool has_map(const ShadowRequest& request) { return !request.rays.only; }

}  // namespace gnomon::shadow
