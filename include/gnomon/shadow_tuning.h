#pragma once
#include <array>
#include <cstdint>

#include "gnomon/light.h"

namespace gnomon {

/// Largest ShadowTuning::Kernel::size_texel; more is cut, as with all limits here, and reported (filter_cut).
inline constexpr std::uint32_t kMostFilterSize = 31;
/// Largest ShadowTuning::Kernel::taps.
inline constexpr std::uint32_t kMostFilterTaps = 32;
/// Largest ShadowTuning::Kernel::penumbra_rays.
inline constexpr std::uint32_t kMostPenumbraRays = 256;
/// Largest half-width of a spread, texels. A wider one costs a map too much border, and needs too much bias.
inline constexpr float kMostSpread_texel = 16.0f;
/// Largest ShadowTuning::Moments::levels.
inline constexpr std::uint32_t kMostMomentLevels = 4;
/// Largest ShadowTuning::Moments::anisotropy.
inline constexpr std::uint32_t kMostMomentAnisotropy = 16;
/// Largest share of light that may count as dark. Beyond it almost no penumbra remains.
inline constexpr float kMostMomentBleeding = 0.9f;

/// Seed of filters with a random pattern of taps. `screen`: the pixel; the pattern stays on the screen when the camera
/// moves. `world`: the cell of the world in which the point lies; the pattern stays on the surface.
enum class FilterSeed : std::uint8_t { screen, world };

/// Formula of the offset against self-shadowing. `automatic` derives the smallest offset that keeps a plane from
/// shadowing itself. The others serve comparison; docs/explanation/bias.md has their formulas.
enum class BiasMode : std::uint8_t {
    automatic,          // derived per pixel; nothing to set
    constant,           // offset_m along the light
    slope,              // constant, plus offset_texel texels times the tangent of the angle between normal and light
    normal_offset,      // offset_m along the light, offset_texel texels times the sine along the normal
    receiver_plane,     // each tap against the receiver's plane there, plus offset_m and offset_texel of its slope
    tutorial_constant,  // 0.005 of the map's depth range; for a point light, 0.005 m
    tutorial_cosine,    // max(0.05 (1 - n.l), 0.005) of the depth range
    tutorial_tangent,   // 0.005 tan(acos(n.l)) of the depth range, clamped to [0, 0.01]
    count
};

/// Projection of a light onto its map. `automatic`: orthographic for a sun, perspective for spots and points. A sun can
/// have one perspective view instead. A projection that the kind of light cannot have is reported
/// (projection_unsupported) and replaced by the automatic one.
enum class LightProjection : std::uint8_t { automatic, orthographic, perspective };

/// How the faces of a point light's cube are drawn. `six_passes`: one pass per face. `layered_vertex` and
/// `layered_geometry`: one pass for all; that shader stage chooses the layer. The maps are the same to the bit.
/// `automatic`: the route that measured fastest. A route that the device lacks becomes six_passes.
enum class CubeRoute : std::uint8_t { automatic, six_passes, layered_vertex, layered_geometry };

/// How a sun's cascades follow the camera.
/// - `tight`: the smallest rectangle around the visible receivers, fitted in every frame.
/// - `stable`: a constant size around each slice of the view, snapped to its own texels, whatever receivers are
///   visible.
/// - `quantised`: around the visible receivers, along the light's own axes, in steps. The map stays until they leave
///   it.
enum class ShadowFit : std::uint8_t { tight, stable, quantised };

/// Where a sun's cascades end along the view.
/// - `practical`: mixture of logarithmic and uniform splits by split_lambda.
/// - `seen`: the same mixture over the depths that receivers cover, by their bounding boxes.
/// - `sampled`: texels are smallest at the depths where pixels of an earlier picture lie.
/// - `manual`: split_m.
enum class CascadeSplits : std::uint8_t { practical, uniform, logarithmic, manual, seen, sampled };

/// How a map stores reversed depth: 32-bit float, or 24- or 16-bit fixed point. Fixed point takes less memory and loses
/// precision far from a spot or a point light. The automatic bias grows by that loss (docs/reference/settings.md).
enum class DepthFormat : std::uint8_t { d32f, d24, d16 };

/// Optional settings of a light's shadow, grouped by what they tune: a second component beside LightShadow. Without it
/// the defaults apply. Without LightShadow it has no effect.
struct ShadowTuning {
    /// The footprint of a filter: taps, spread and seeds.
    struct Kernel {
        /// Edge of the pcf filters and of the blur of prefiltered maps, texels; odd, 1 to 31.
        std::uint32_t size_texel = 3;
        /// Number of taps of the Poisson filters and of each disk of pcss, 1 to 32.
        std::uint32_t taps = 16;
        /// Half-width of the Poisson and cube filters, texels, at most 16 and an eighth of the map's edge.
        float spread_texel = 2.0f;
        /// Half-width across the light, metres, with the same limits in texels. 0: spread_texel applies.
        float spread_m = 0.0f;
        /// Distance from the camera at which that half-width has doubled, metres. 0: it is constant.
        float doubles_m = 0.0f;
        /// Seed of poisson_rotated, poisson_stratified, pcss, soft_triangles and exact_soft.
        FilterSeed seed = FilterSeed::world;
        /// Edge of a cell of FilterSeed::world, metres, above 0.
        float cell_m = 0.02f;
        /// Early exit: filters of many taps take five first, and the others only if these differ.
        bool early_bail = false;
        /// Rays of exact_soft from each pixel in a penumbra, 1 to 256.
        std::uint32_t penumbra_rays = 16;
        bool operator==(const Kernel&) const = default;
    };
    /// Prefiltered maps: filters exponential to moments, and pcss_moments.
    struct Moments {
        /// Bits of a channel, 16 or 32.
        std::uint32_t bits = 32;
        /// Exponent of the warp of exponential, evsm2 and evsm4. 0: the default of the filter and format.
        float exponent = 0.0f;
        /// Exponent of evsm4's second warp. 0: 5, or less where the format overflows sooner.
        float negative_exponent = 0.0f;
        /// Share of light that counts as dark, 0 to 0.9. More reduces leaks where several casters overlap.
        float bleeding = 0.2f;
        /// Number of levels of mipmaps, 1 to 4.
        std::uint32_t levels = 1;
        /// Number of samples along a pixel's footprint, 1 to 16.
        std::uint32_t anisotropy = 1;
        bool operator==(const Moments&) const = default;
    };
    /// The offset against self-shadowing.
    struct Bias {
        /// Formula of the offset. Change it to compare with other engines' shadows.
        BiasMode mode = BiasMode::automatic;
        /// Offset along the light in modes that use it, metres, at least 0. Negative or NaN: the default.
        float offset_m = 0.0f;
        /// Offset in modes that use it, texels, at least 0. Negative or NaN: the default.
        float offset_texel = 1.0f;
        bool operator==(const Bias&) const = default;
    };
    /// The views from the light.
    struct Projection {
        /// Projection onto the map. Change it for a sun from one eye.
        LightProjection kind = LightProjection::automatic;
        /// Distance of a sun's eye from the middle of the visible receivers, toward the light, metres. A perspective
        /// view looks from the eye. 0: the distance at which eye_angle_rad contains all of them.
        float eye_distance_m = 0.0f;
        /// Full opening angle of a sun's perspective view, radians; above 0, at most 160 degrees.
        float eye_angle_rad = 0.785398163f;
        /// Start of every view's depth range, metres from the light or a sun's eye. Receivers before it are lit,
        /// casters before it still cast. 0: fitted.
        float near_m = 0.0f;
        /// End of every view's depth range, metres from the light or a sun's eye. Receivers beyond it are lit, casters
        /// beyond it cast nothing. 0: fitted.
        float far_m = 0.0f;
        bool operator==(const Projection&) const = default;
    };
    /// A sun's cascades; their number is LightShadow::cascades.
    struct Cascades {
        /// Fit of the cascades' maps; docs/explanation/fits.md compares the three.
        ShadowFit fit = ShadowFit::quantised;
        /// Where cascades end. `practical` is logarithmic where the number of cascades is chosen by the system.
        CascadeSplits splits = CascadeSplits::practical;
        /// Mixture of practical, seen and sampled splits, 0 (uniform) to 1 (logarithmic).
        float split_lambda = 0.7f;
        /// Splits of CascadeSplits::manual, metres along the view, rising. 0 ends the list. There is one cascade more
        /// than splits.
        std::array<float, kMaxCascades - 1> split_m{};
        /// Share of a cascade that fades into the next one, 0 to 0.5.
        float blend = 0.1f;
        /// Limit of the perspective warp of tight maps, 0 (no warp) to 1 (as light-space perspective shadow maps). A
        /// warp lets texels grow with the distance from the camera. The fit takes as much as gains accuracy
        /// (docs/explanation/fits.md).
        float warp = 0.0f;
        bool operator==(const Cascades&) const = default;
    };
    /// How maps are stored and drawn.
    struct Maps {
        /// Format of depths. Change it to halve the memory of short ranges.
        DepthFormat depth_format = DepthFormat::d32f;
        /// Route of a cube's faces. Change it only if another one measures faster on your device.
        CubeRoute cube_route = CubeRoute::automatic;
        /// Draws of all meshes that need the same state as one command. false: a command per draw, to the same bits.
        /// Change it only to compare what commands cost.
        bool multi_draw = true;
        /// Texels of maps with triangles name theirs by one number of 32 bits, where that holds all triangles and
        /// instances of the scene. false: by two, to the same picture, in half as many bytes again. Change it only to
        /// compare.
        bool short_references = true;
        /// Casters are drawn as coarser meshes (assets::add_proxies()) where that moves no edge by more than a share of
        /// a pixel. Change it for scenes of many triangles.
        bool proxies = false;
        bool operator==(const Maps&) const = default;
    };
    /// Results kept from one frame to the next.
    struct Reuse {
        /// Reuse of unchanged maps. false: every view is drawn in every frame, to the same bits.
        bool economy = true;
        /// Reuse of the visibility per pixel while nothing changes, instead of a lookup. The picture is the same to the
        /// bit. Takes 4 bytes per pixel in the light's range, and is dropped where it gains nothing. Needs economy.
        bool keep_visibility = true;
        bool operator==(const Reuse&) const = default;
    };
    Kernel kernel = {};          // taps and spread of filters
    Moments moments = {};        // prefiltered maps
    Bias bias = {};              // offset against self-shadowing
    Projection projection = {};  // views from the light
    Cascades cascades = {};      // where a sun's maps lie
    Maps maps = {};              // how maps are stored and drawn
    Reuse reuse = {};            // what is kept from frame to frame
    bool operator==(const ShadowTuning&) const = default;
};

}  // namespace gnomon
