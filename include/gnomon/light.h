#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

/// A light, and what its author sets of its shadow.
namespace gnomon {

/// Largest Light::sun_radius_rad: a disk of sky of 30 degrees to either side.
inline constexpr float kMostSunRadius_rad = 0.523598776f;
/// Largest Light::source_radius_m: a source as large as a town.
inline constexpr float kMostSourceRadius_m = 1.0e4f;

/// Kind of a light. `directional`: a sun, with parallel rays. `spot`: a cone from a place. `point`: in all directions.
/// The others are area lights: surfaces that shine alike from every place. `rectangle` and `disc` lie in their own XY
/// plane and shine from one side, along -Z. `sphere` shines all round. `tube` is a cylinder along its X axis that
/// shines from its side, not from its ends. Nothing in the way of an area light is part of it: it casts no shadow
/// itself.
enum class LightKind : unsigned char { directional, spot, point, rectangle, disc, sphere, tube };
/// Returns its name, for example "spot".
const char* to_text(LightKind kind);

/// A light as in KHR_lights_punctual: it shines along its own -Z (directional, spot).
///
/// Intensities of real lights, lux of a directional one:
/// - 100 000: sun at noon
/// - 20 000: sun through thin clouds
/// - 1 000: overcast day
/// - 400: sunrise
/// - 0.25: full moon
///
/// Candela of a spot or point light:
/// - 1: candle
/// - 65: bulb of 800 lumens
/// - 1 000: spot in a shop
/// - 20 000: headlight on full beam
/// - 1 000 000: searchlight
///
/// Nits (candela per square metre) of an area light:
/// - 250: screen
/// - 3 000: panel in an office
/// - 10 000: fluorescent tube
/// - 100 000: frosted bulb
///
/// A small source of A square metres and L nits is, from its front, as bright as A * L candela.
struct Light {
    /// Kind of light: the fields below state for which kinds they count.
    LightKind kind = LightKind::point;
    /// Colour, linear, Rec. 709, each at least 0. It scales the intensity; black switches the light off.
    glm::vec3 colour{1.0f};
    /// Strength, at least 0. Directional: lux at the surface; spot and point: candela; area lights: nits. Effect:
    /// brightness, and which lights a budget keeps. 0: the light is off and has no shadow.
    float intensity = 100.0f;
    /// Distance from its position at which any light but a directional one ends, metres. 0: unlimited. Change it to cut
    /// cost: what lies beyond is neither lit nor in the map.
    float range_m = 0.0f;
    /// Half angle of a spot's full intensity, radians, from 0 to below outer_cone_rad. Larger: a harder rim.
    float inner_cone_rad = 0.0f;
    /// Half angle at which a spot's light ends, radians, above 0, at most pi/2. Narrower cones have finer shadows.
    float outer_cone_rad = 0.785398163f;
    /// Radius of a spot's or point's source, metres, 0 to kMostSourceRadius_m. 0: a point, with hard shadows. Read by
    /// the filters pcss, pcss_moments, soft_triangles and exact_soft. Bulb: 0.03; lantern: 0.1; softbox: 0.5. What
    /// shines of a disc, sphere or tube has this radius. Without one, such a light is left out and reported as dropped.
    float source_radius_m = 0.0f;
    /// Angular radius of a sun's disk, radians, 0 to kMostSunRadius_rad. 0: a point. Read by the same filters. The
    /// real sun: 0.00465; a thin cloud before it: 0.05.
    float sun_radius_rad = 0.0f;
    /// Width of a rectangle along its X axis, or length of a tube, metres, above 0, at most 2 * kMostSourceRadius_m.
    /// With any other value the light is left out and reported as dropped. Wider: more light and softer shadows.
    float width_m = 1.0f;
    /// Height of a rectangle along its Y axis, metres, in the same range.
    float height_m = 1.0f;
};

/// Bits of up to eight shadow layers. Lights, casters and receivers each have a set, by default all layers.
/// - A caster darkens under a light only if their layers have a bit in common (LightShadow::layers).
/// - A receiver is darkened by a light only if their layers have a bit in common. Otherwise the light shines on it
///   unoccluded.
/// Casters and receivers are not compared with each other, because all casters of a light share its map.
using ShadowLayers = std::uint8_t;
/// All eight layers: the default of lights, casters and receivers.
inline constexpr ShadowLayers kAllShadowLayers = 0xff;

/// How a light's map is read; the documentation compares all. `automatic`: the accuracy target chooses one.
enum class ShadowFilter : std::uint8_t {
    hard,                // one texel, compared: blocky edges, cheapest
    hardware_2x2,        // one comparison that the sampler blends over 2 x 2 texels
    pcf_grid,            // a square of comparisons: percentage-closer filtering (PCF) as tutorials have it
    pcf_bilinear,        // the same of blended comparisons: smoother with fewer taps
    poisson,             // comparisons in a fixed disk
    poisson_rotated,     // the disk turned by a random angle
    poisson_stratified,  // a random part of the disk
    cube_grid,           // a cube of comparisons, for point lights
    cube_directions,     // twenty directions, for point lights
    sharp_4x4,           // edge of a straight line through 4 x 4 texels: hard and smooth
    triangles,           // edges of the casters' own triangles: the default
    exponential,         // exponential shadow map (ESM)
    vsm,                 // variance shadow map (VSM)
    evsm2,               // exponential variance shadow map, one warp
    evsm4,               // exponential variance shadow map, two warps
    moments,             // four moments (MSM)
    pcss,                // soft by the size of the source: percentage-closer soft shadows
    pcss_moments,        // the same, by moments
    soft_triangles,      // the same, by the part of the source that casters' triangles leave free
    exact,               // no wrong pixel: rays where the map is uncertain
    exact_soft,          // the same for a source with a size
    count,               // number of filters
    automatic            // pcss for area lights; else triangles, or exact where only that meets the targets
};
/// Returns its name, for example "pcf_grid".
const char* to_text(ShadowFilter filter);

/// Faces of casters that a light draws into its maps. The choice affects only solid meshes: closed, wound outward,
/// opaque and single-sided throughout. Both sides of other meshes are drawn, because light would shine through a single
/// one. A solid with the light inside its bounding box has both sides drawn as well.
enum class CasterFaces : std::uint8_t { automatic, front, back, both };

/// Largest number of a sun's cascades.
inline constexpr std::size_t kMaxCascades = 8;

/// Settings of a light's shadow. Add this to a Light's entity and the light casts shadows; remove it and its maps are
/// freed. The source's size is a field of Light. Optional settings of filters, maps and fits are in ShadowTuning.
struct LightShadow {
    /// Switch of the light's shadows. false: the light shines through everything, and its maps are freed.
    bool enabled = true;
    /// Filter that reads the map. `automatic`: pcss for area lights, else triangles, which measures best. It becomes
    /// exact where max_error_px or narrowest_caster_px is set and no map with triangles meets it. Change it for soft
    /// shadows (pcss, soft_triangles, exact_soft), for edges without any error (exact), or for speed (hardware_2x2).
    ShadowFilter filter = ShadowFilter::automatic;
    /// Antialiased edges of `triangles`, `exact` and filters by the source's size but `pcss_moments`: visibility is the
    /// share of a pixel's area that the light reaches. false: by the pixel's middle. Other filters do not depend on it.
    /// Set it where stairs at edges show; it costs time.
    bool antialias = false;
    /// Largest allowed error of a shadow's edge on screen, pixels, 0 to 10 000. 0: 1, as far as maps of default size
    /// meet it. It holds for casters that the map resolves (ResolvedWidth). Smaller: larger maps or a slower filter.
    /// Larger: less memory and time.
    float max_error_px = 0.0f;
    /// Width of the narrowest caster that must count, at its receiver across the light, pixels, 0 to 10 000. 0: any.
    /// Smaller: larger maps, or exact. Set it where fences, leaves or wires must not be lost.
    float narrowest_caster_px = 0.0f;
    /// Edge of one map, cascade or cube face, texels, 16 to the device's limit. 0: chosen for max_error_px. Set it to
    /// fix the memory. Other sizes become the nearest possible one, which is reported (resolution_clamped).
    std::uint32_t resolution_px = 0;
    /// Number of a sun's cascades, 0 to kMaxCascades. 0: as few as meet the target, one to four. More: finer shadows
    /// near the camera, and more draws.
    std::uint32_t cascades = 0;
    /// Additional error allowed to edges of a stale map, pixels, 0 to 100. A map that shows moved casters at their old
    /// place is kept within this bound. 0: a map is drawn whenever a caster moves. Needs BiasMode::automatic. Raise it
    /// where many things move slowly or far away.
    float refresh_error_px = 0.0f;
    /// Faces of solid casters in the maps. `automatic`: front, which measures best. Change it to compare methods.
    CasterFaces caster_faces = CasterFaces::automatic;
    /// Layers of the casters and receivers that take part in this light's shadows, a bit each. Change it so that some
    /// things cast no shadow, or get none, under this light alone.
    ShadowLayers layers = kAllShadowLayers;
    /// Translucent casters tint: what is seen through them is lit in the colour that they let through
    /// (assets::transmits). false: they cast nothing. A light without any in its caster set pays nothing. Switch it
    /// off where smoke, decals or glass need not darken; its layers take up to 96 MiB.
    bool translucent_casters = true;
    bool operator==(const LightShadow&) const = default;
};

/// Memory of a light by what it holds, bytes. With KeptReport::bytes it sums up to LightCounts::bytes.
struct BytesByPart {
    std::uint64_t depths = 0;         // depth maps
    std::uint64_t triangles = 0;      // names of the triangles that texels show
    std::uint64_t prefiltered = 0;    // blurred moments, and scratch storage of the blur
    std::uint64_t bounds = 0;         // conservative maps beside the depths
    std::uint64_t static_copies = 0;  // copies of what static casters leave in the maps
    std::uint64_t tints = 0;          // layers of translucent casters
};

/// Width that a caster must have for a light's maps to resolve it, and a gap between casters for its light. Edges of
/// what is wider are no farther off than predicted. What is narrower may be drawn, broken or missing. Widths are those
/// of the shadow at its receiver, across the light: a slope stretches both it and the texels. 0: any width.
struct ResolvedWidth {
    double px = 0.0;               // where the picture shows texels largest, pixels
    double m = 0.0;                // where texels are largest, metres
    bool keeps_narrowest = false;  // px is at most LightShadow::narrowest_caster_px, or that is 0
    bool operator==(const ResolvedWidth&) const = default;
};

}  // namespace gnomon
