#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

/// A light, and what its author sets of its shadow.
namespace gnomon {

/// Limits of a light's size: a disk of sky of 30 degrees to either side, and a source as large as a town.
inline constexpr float kMostSunRadius_rad = 0.523598776f, kMostSourceRadius_m = 1.0e4f;

enum class LightKind : unsigned char { directional, spot, point };

/// A light as in KHR_lights_punctual: it shines along its own -Z (directional, spot).
struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 colour{1.0f};               // linear, Rec. 709
    float intensity = 100.0f;             // directional: lux; spot and point: candela
    float range_m = 0.0f;                 // spot and point: 0 means unlimited
    float inner_cone_rad = 0.0f;          // spot: half angle of full intensity, in [0, outer)
    float outer_cone_rad = 0.785398163f;  // spot: half angle where light ends, in (0, pi/2]
    /// Radius of the source that shines, metres, 0 to kMostSourceRadius_m. 0: a point, with hard shadows. Filters that
    /// soften by the source read it: pcss, pcss_moments, exact_soft.
    float source_radius_m = 0.0f;  // spot and point
    /// Angular radius of the disk in the sky, radians, 0 to kMostSunRadius_rad. The real sun: 0.00465. 0: a point.
    float sun_radius_rad = 0.0f;  // directional
};

/// Bits of up to eight shadow layers. Lights, casters and receivers each have a set, by default all layers.
/// - A caster darkens under a light only if their layers have a bit in common (LightShadow::layers).
/// - A receiver is darkened by a light only if their layers have a bit in common. Otherwise the light shines on it
///   unoccluded.
/// Casters and receivers are not compared with each other, because all casters of a light share its map.
using ShadowLayers = std::uint8_t;
inline constexpr ShadowLayers kAllShadowLayers = 0xff;

/// How a light's map is read; docs/filters.md compares all. `automatic`: the accuracy target chooses one.
enum class ShadowFilter : std::uint8_t {
    hard,
    hardware_2x2,
    pcf_grid,
    pcf_bilinear,
    poisson,
    poisson_rotated,
    poisson_stratified,
    cube_grid,
    cube_directions,
    sharp_4x4,
    triangles,
    exponential,
    vsm,
    evsm2,
    evsm4,
    moments,
    pcss,
    pcss_moments,
    exact,
    exact_soft,
    count,
    automatic
};

/// Faces of casters that a light draws into its maps. The choice affects only solid meshes: closed, wound outward,
/// opaque and single-sided throughout. Both sides of other meshes are drawn, because light would shine through a single
/// one. A solid with the light inside its bounding box has both sides drawn as well.
enum class CasterFaces : std::uint8_t { automatic, front, back, both };

inline constexpr std::size_t kMaxCascades = 8;

/// Settings of a light's shadow. Add this to a Light's entity and the light casts shadows; remove it and its maps are
/// freed. The source's size is a field of Light. Optional settings of filters, maps and fits are in ShadowTuning.
struct LightShadow {
    /// Switch of the light's shadows.
    bool enabled = true;
    /// Filter that reads the map. `automatic`: triangles, which measures best (docs/accuracy.md). It becomes exact
    /// where max_error_px is set and no map with triangles meets it.
    ShadowFilter filter = ShadowFilter::automatic;
    /// Largest allowed error of a shadow's edge on screen, pixels. 0: 1, as far as maps of default size meet it.
    float max_error_px = 0.0f;
    /// Edge of one map, cascade or cube face, texels. 0: chosen by the system.
    std::uint32_t resolution_px = 0;
    /// Number of a sun's cascades, at most kMaxCascades. 0: as few as meet the target, one to four.
    std::uint32_t cascades = 0;
    /// Additional error allowed to edges of a stale map, pixels. A map that shows moved casters at their old place is
    /// kept within this bound (docs/economy.md). 0: a map is drawn whenever a caster moves. Needs BiasMode::automatic.
    float refresh_error_px = 0.0f;
    /// Faces of solid casters in the maps. `automatic`: front, which measures best (docs/accuracy.md).
    CasterFaces caster_faces = CasterFaces::automatic;
    /// Layers of the casters and receivers that take part in this light's shadows, a bit each.
    ShadowLayers layers = kAllShadowLayers;
    bool operator==(const LightShadow&) const = default;
};

}  // namespace gnomon
