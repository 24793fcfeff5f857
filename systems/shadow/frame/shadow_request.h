#pragma once
#include <cstdint>
#include <glm/vec4.hpp>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "gnomon/light.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/triangle_references.h"

namespace gnomon::shadow {

/// Effective filter settings of a light: invalid values are replaced by defaults, and large ones cut to fit its map.
struct FilterSettings {
    std::uint32_t size = 3, taps = 16;
    /// Kernel radius E without the spread, texels: a constant of the compiled program.
    float reach_texel = 0.5f;
    /// Spread in metres; where that is 0, in texels. 0: the filter has none. At most most_spread_texel texels.
    float spread_m = 0.0f, spread_texel = 0.0f, most_spread_texel = 0.0f;
    float doubles_m = 0.0f;
    float cell_m = 1.0f;
    /// Size of the source: metres, and the tangent of a sun's angular radius. Both 0: the filter does not depend on it.
    float source_radius_m = 0.0f, sun_radius_tan = 0.0f;
    /// Largest E with spread or penumbra, texels, for which a map's border leaves room.
    float widest_texel = 0.5f;
    /// Part of E that is read but cannot move a shadow's edge, texels.
    float still_texel = 0.0f;
    /// Half of a map's border, texels (border_px). A border needs E once for the texels read beside a point, and once
    /// for the bias that moves the point. A penumbra counts only in the first, so that half of it is added here.
    float border_texel = 0.5f;
    bool cut = false;  // some setting differs from the light's
};

/// Effective settings of a prefiltered map, within the range of its filter's format.
struct PrefilterSettings {
    gl::Format format = gl::Format::r32f;
    /// Uniform of shaders/shadow/filters. x, y: exponents of the two warps; z: MomentStore::least; w: 1 if moments are
    /// stored in 16 bits.
    glm::vec4 settings{0.0f};
    float bleeding = 0.0f;
    std::uint32_t levels = 1, anisotropy = 1;
    bool sampler_anisotropy = true;  // true: the sampler does it; false: the lookup does (kinds/point.glsl)
    /// Largest footprint of a pixel along a side, texels. 1: the finest level is read alone.
    float footprint_texel = 1.0f;
    /// Part of E that the footprint adds, texels.
    float reach_texel = 0.0f;
    bool cut = false;  // some setting differs from the light's
    bool operator==(const PrefilterSettings&) const = default;
};

/// Format, size and filter of a light's maps.
struct MapSettings {
    ShadowFilter filter = ShadowFilter::hard;
    DepthFormat depth_format = DepthFormat::d32f;
    FilterSettings filtering{};       // settings of the filter
    PrefilterSettings moments{};      // filters with FilterRow::moments only
    std::uint32_t resolution_px = 0;  // edge of the map or of a cube face that views are fitted for
    std::uint32_t reduced_px = 0;     // edge of the map where a budget reduces it; 0: resolution_px
    std::uint32_t view_count = 0;     // layers of the map
    float cascade_blend = 0.0f;       // share of a cascade that fades into the next
    TriangleReferences references{};  // filters with FilterStorage::triangle_ids only
};

/// Returns the edge of the light's maps in this frame, texels.
inline std::uint32_t map_edge_px(const MapSettings& map) {
    return map.reduced_px > 0 ? map.reduced_px : map.resolution_px;
}

/// Limits within which the fits choose a light's maps.
struct MapLimits {
    std::uint32_t max_px = 0;     // edge; the fit takes fewer texels where these meet the target (accuracy_target.h)
    std::uint32_t device_px = 0;  // the device's limit on that edge
    std::uint32_t max_views = 0;  // cascades of a sun where the fit chooses their number; else 0
};

/// How a light projects onto its maps.
struct ProjectionRequest {
    int cube_blend_eighths = 0;    // spot: weight of cube faces against one view (projection/spot_cube_transition.h)
    FarLampAim aim = {};           // far lamp: one view of its visible receivers (projection/far_lamp_aim.h)
    bool perspective_sun = false;  // one view from an eye instead of cascades
    float warp = 0.0f;             // sun: largest warp of its maps (fitting/directional/fit_lispsm.h); 0: none
    double near_m = 0.0, far_m = 0.0;  // depth range, from the light or a sun's eye; 0: fitted
};

/// How a light uses rays.
struct RayUse {
    bool used = false;       // rays trace the pixels that its map, if any, leaves undecided
    bool only = false;       // rays trace all pixels: it has no map
    bool fell_back = false;  // the ray budget has no room: another filter replaces its own
};

/// Struct 2. Request of one light. The fits and later stages pass on a copy with their choices.
struct ShadowRequest {
    Reason skip = Reason::none;  // why the light needs no shadow
    Reason note = Reason::none;  // degradation that the request itself causes (resolution_clamped, …)
    MapSettings map;
    MapLimits limits;
    ProjectionRequest projection;
    RayUse rays;
};

/// Returns true if a light with a shadow looks up a map.
inline bool has_map(const ShadowRequest& request) { return !request.rays.only; }

}  // namespace gnomon::shadow
