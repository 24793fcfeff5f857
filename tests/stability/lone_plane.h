#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "gnomon/shadow_tuning.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/perspective_view.h"

/// One plane alone in the maps of one light, as a rasteriser would draw it, looked up by the shaders' own text
/// (bench/glsl_on_cpu/shader_structs.inc).
namespace gnomon {

enum class PlaneKind : std::uint8_t { sun, warped_sun, spot, point, count };
const char* plane_kind_name(PlaneKind kind);

/// The shaders' constants that say how far off things may be.
struct PlaneBounds {
    double snap_texel = 0.0, unit_roundoff = 0.0, normal_error_rad = 0.0, rebuilt_relative = 0.0, steep_tangent = 0.0;
};
PlaneBounds plane_bounds();

/// Places are relative to the light's anchor.
struct LonePlane {
    glm::dvec3 normal{0.0}, at_m{0.0};  // unit; a point on the plane
    // How it is drawn.
    glm::dvec2 aside_texel{0.0};  // by how much it is snapped; the sign is the slope's
    bool worst = false;           // every texel rounds up as far as it may; otherwise, either way, by `salt`
    std::uint64_t salt = 0;
    // What its texels show, for filters that read triangles: two of them, quad_at_m ± half_u_m ± half_v_m. None, as
    // where a mask cuts the caster, if these are 0.
    glm::dvec3 quad_at_m{0.0}, half_u_m{0.0}, half_v_m{0.0};
    // What the light pass looks up.
    glm::dvec3 receiver_m{0.0}, receiver_normal{0.0};
    double error_m = 0.0;  // how far the receiver may be off the plane
};

/// Returns the views of a point light's six faces, in order.
std::vector<shadow::ShadowView> cube_views(const glm::dvec3& anchor_ws_m, const shadow::PerspectiveRange& range,
                                           std::uint32_t size_px);

class LonePlaneLookup {
public:
    /// Requires can_judge(filter).
    LonePlaneLookup(PlaneKind kind, ShadowFilter filter, DepthFormat format);
    ~LonePlaneLookup();
    /// Sets the views (cube_views(), or one), the size of their maps, and the camera.
    void set_maps(std::vector<shadow::ShadowView> views, std::uint32_t size_px, const glm::dvec3& camera_ws_m);

    struct Answer {
        bool lit = false;        // wholly
        bool looked_up = false;  // false: lit without a look at the map
    };
    /// Looks the receiver up, with this share of the automatic offset.
    Answer look_up(const LonePlane& plane, double bias_share) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Returns whether a filter's text is compiled in shader_structs.inc. If not, nothing can be judged.
bool can_judge(ShadowFilter filter);

}  // namespace gnomon
