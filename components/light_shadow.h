#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "components/shadow_layers.h"

namespace gnomon {

/// Rows of the filter table (systems/shadow/request/filter_table.h), one per shaders/shadow/filters file. `automatic` is none:
/// the accuracy contract chooses one (systems/shadow/request/filter_choice.h).
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

/// Where a filter that differs from point to point takes its randomness from: the pixel, so that it stays on the screen
/// when the camera moves, or the cell of the world in which the point lies, so that it stays there.
enum class FilterSeed : std::uint8_t { screen, world };

/// `automatic` derives the smallest offset that keeps a plane from shadowing itself; the others are there to compare
/// with, a function each in shaders/shadow/lookup/bias/manual.glsl. bias_m and bias_texel are theirs; docs/bias.md has the
/// formulas.
enum class BiasMode : std::uint8_t {
    automatic,
    constant,           // bias_m along the light
    slope,              // and bias_texel texels times the tangent of the angle between normal and light
    normal_offset,      // bias_m along the light, bias_texel texels times the sine along the normal
    receiver_plane,     // each tap against the receiver's plane there, bias_m and bias_texel texels of its slope added
    tutorial_constant,  // 0.005 of the map's depth; of a point light, metres
    tutorial_cosine,    // max(0.05 (1 - n.l), 0.005) of it
    tutorial_tangent,   // 0.005 tan(acos(n.l)) of it, 0 to 0.01
    count
};

/// How a light projects onto its map. A sun's is orthographic, a spot's and a point's perspective; a sun may be given
/// one perspective view instead. What a kind cannot do is reported (projection_unsupported), its own is used.
enum class LightProjection : std::uint8_t { automatic, orthographic, perspective };

/// How the faces of a point light's cube are drawn: a pass each, or all in one whose layer the vertex or the geometry
/// stage chooses. The maps are the same to the bit. `automatic` takes what measured fastest; a route that the device
/// does not have becomes six_passes.
enum class CubeRoute : std::uint8_t { automatic, six_passes, layered_vertex, layered_geometry };

/// How a sun's cascades follow the camera. `tight`: the smallest rectangle around what is seen, fitted anew in every
/// frame. `stable`: a constant size around each slice of the view, snapped to its own texels; what is seen does not
/// matter. `quantised`: around what is seen, in the light's own axes, in steps; it stays until that no longer fits.
enum class ShadowFit : std::uint8_t { tight, stable, quantised };

/// Where a sun's cascades end along the view. `practical` mixes logarithmic and uniform ends by split_lambda; `seen`
/// does the same over those depths alone at which receivers lie, by their bounds; `sampled` makes texels smallest where
/// the pixels of an earlier picture lie; `manual` takes split_m.
enum class CascadeSplits : std::uint8_t { practical, uniform, logarithmic, manual, seen, sampled };

/// Which faces of casters a light draws into its maps. Only meshes that are known to be solid have sides to choose from
/// (closed, wound outward, opaque and single-sided throughout); of all others both are drawn, whatever is asked for,
/// because light would shine through what has one side only. So are solids whose box holds the light.
enum class CasterFaces : std::uint8_t { automatic, front, back, both };

inline constexpr std::size_t kMaxCascades = 8;

/// What LightShadow takes: a disk of sky of 30 degrees to either side, and a source of the size of a town.
inline constexpr float kMostSunRadius_rad = 0.523598776f, kMostSourceRadius_m = 1.0e4f;

/// How a map stores depth, reversed: 32-bit float, or 24- or 16-bit fixed point. Fixed point takes less memory and
/// gives up precision far from a spot or a point; the automatic bias grows by what is lost (docs/settings.md).
enum class DepthFormat : std::uint8_t { d32f, d24, d16 };

/// Add this to a Light's entity and the light casts shadows; remove it and its map is freed.
struct LightShadow {
    bool enabled = true;
    /// `automatic`: triangles, which measures best (docs/accuracy.md), or exact where max_error_px is said and no map
    /// keeps it otherwise.
    ShadowFilter filter = ShadowFilter::automatic;
    std::uint32_t filter_size = 3;   // of pcf and prefiltered maps, texels along an edge; odd, at most 31
    std::uint32_t filter_taps = 16;  // of the Poisson filters; 1 to 32
    /// Half-width of the Poisson and cube filters: in texels of the map, or, where filter_spread_m is above 0, in
    /// metres across the light. At most 16 texels, and an eighth of the map's edge, are taken.
    float filter_spread_texel = 2.0f, filter_spread_m = 0.0f;
    float filter_doubles_m = 0.0f;  // distance from the camera at which that half-width has doubled; 0: it is constant
    FilterSeed filter_seed = FilterSeed::world;  // of poisson_rotated and poisson_stratified
    float filter_cell_m = 0.02f;                 // FilterSeed::world: edge of a cell; above 0
    /// Prefiltered maps (exponential to moments) are blurred by filter_size texels when they are drawn.
    std::uint32_t moment_bits = 32;         // per channel: 16 or 32
    float moment_exponent = 0.0f;           // of exponential and evsm; 0: as much as serves and the format bears
    float moment_negative_exponent = 0.0f;  // of evsm4's second warp; the same
    float moment_bleeding = 0.2f;           // 0 to 0.9: what is lit less counts as dark
    std::uint32_t moment_levels = 1;        // 1 to 4 of mipmaps
    std::uint32_t moment_anisotropy = 1;    // 1 to 16 samples along a pixel's footprint
    /// Size of the light's source, for pcss, pcss_moments and exact_soft, which soften by it: of a spot or a point its
    /// radius in metres, of a sun that of its disk as an angle (the real one's: 0.00465). 0: a point, whose shadows are
    /// hard.
    float source_radius_m = 0.0f, sun_radius_rad = 0.0f;
    std::uint32_t penumbra_rays = 16;  // of exact_soft, from each pixel in a penumbra; 1 to 256
    bool early_bail = false;          // filters of many taps: five first, the others only if those differ
    std::uint32_t resolution_px = 0;  // edge of one map or cube face; 0: chosen by the system
    /// How far a shadow edge may be off on screen. 0, not said: 1, as far as maps of the usual size keep it.
    float max_error_px = 0.0f;
    /// How much farther off it may be because a map shows casters where they were, so that it need not be drawn anew
    /// whenever one moves; 0: it always is. Needs BiasMode::automatic (docs/economy.md).
    float refresh_error_px = 0.0f;
    BiasMode bias = BiasMode::automatic;
    float bias_m = 0.0f;      // of a BiasMode that takes it, >= 0; what is no such number counts as the default
    float bias_texel = 1.0f;  // the same
    LightProjection projection = LightProjection::automatic;
    /// A sun's eye stands this far from the middle of what is seen, toward the light; 0: so far that eye_angle_rad
    /// holds all that is seen. Perspective views look from it, near_m and far_m are counted from it.
    float eye_distance_m = 0.0f;
    float eye_angle_rad = 0.785398163f;  // full opening angle of a sun's perspective view; above 0, at most 160 degrees
    /// Depth range of every view, from the light or a sun's eye; 0: fitted. Receivers outside are lit, casters beyond
    /// far_m cast nothing, casters before near_m still cast.
    float near_m = 0.0f, far_m = 0.0f;
    CubeRoute cube_route = CubeRoute::automatic;
    DepthFormat depth_format = DepthFormat::d32f;
    ShadowFit fit = ShadowFit::quantised;  // of a sun's cascades; docs/fits.md compares them
    std::uint32_t cascades = 0;        // of a sun; 0: as few as serve, one to four; at most kMaxCascades
    CascadeSplits splits = CascadeSplits::practical;
    float split_lambda = 0.7f;  // 0: uniform, 1: logarithmic
    /// CascadeSplits::manual: metres along the view, rising; 0 ends the list. One cascade more than distances.
    std::array<float, kMaxCascades - 1> split_m{};
    float cascade_blend = 0.1f;  // share of a cascade that fades into the next one, 0 to 0.5
    /// Of a sun's tight maps: how far their texels may grow with the distance from the camera, 0 (not) to 1 (as
    /// light-space perspective shadow maps do). Up to there it goes as far as it gains (docs/fits.md).
    float warp = 0.0f;
    CasterFaces caster_faces = CasterFaces::automatic;  // automatic: front, which measures best (docs/accuracy.md)
    ShadowLayers layers = kAllShadowLayers;             // whose shadows fall on whom (shadow_layers.h)
    bool economy = true;                                // false: redraw every view every frame, change nothing else
    /// What pixels see of the light is kept while nothing that it follows from changes, and read instead of looked up;
    /// 4 bytes per pixel that the light reaches, only while that pays. Nothing changes but time. Needs economy.
    bool keep_visibility = true;
    bool operator==(const LightShadow&) const = default;
};

}  // namespace gnomon
