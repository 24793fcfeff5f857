#pragma once
#include <array>
#include <cstdint>

#include "components/light_shadow.h"

namespace gnomon {

/// Source of randomness of filters that differ from point to point. `screen`: the pixel; the pattern stays on the
/// screen when the camera moves. `world`: the cell of the world in which the point lies; the pattern stays there.
enum class FilterSeed : std::uint8_t { screen, world };

/// How the offset against self-shadowing is found. `automatic` derives the smallest offset that keeps a plane from
/// shadowing itself. The others are there to compare with, a function each in shaders/shadow/lookup/bias/manual.glsl;
/// docs/bias.md has the formulas.
enum class BiasMode : std::uint8_t {
    automatic,
    constant,           // offset_m along the light
    slope,              // and offset_texel texels times the tangent of the angle between normal and light
    normal_offset,      // offset_m along the light, offset_texel texels times the sine along the normal
    receiver_plane,     // each tap against the receiver's plane there, offset_m and offset_texel of its slope added
    tutorial_constant,  // 0.005 of the map's depth; of a point light, metres
    tutorial_cosine,    // max(0.05 (1 - n.l), 0.005) of it
    tutorial_tangent,   // 0.005 tan(acos(n.l)) of it, 0 to 0.01
    count
};

/// How a light projects onto its map. A sun's map is orthographic, a spot's and a point's perspective. A sun can have
/// one perspective view instead. What a kind cannot do is reported (projection_unsupported), and its own is used.
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

/// How a map stores depth, reversed: 32-bit float, or 24- or 16-bit fixed point. Fixed point takes less memory and
/// loses precision far from a spot or a point; the automatic bias grows by what is lost (docs/settings.md).
enum class DepthFormat : std::uint8_t { d32f, d24, d16 };

/// Inner settings of a light's shadow, by what they tune. A second component beside LightShadow that nobody needs:
/// without it the defaults hold, and without LightShadow it does nothing.
struct ShadowTuning {
    /// The footprint of a filter: taps, spread and seeds.
    struct Kernel {
        /// Edge of pcf filters, and of the blur of prefiltered maps, texels; odd, 1 to 31.
        std::uint32_t size_texel = 3;
        /// Number of taps of the Poisson filters and of each disk of pcss, 1 to 32.
        std::uint32_t taps = 16;
        /// Half-width of the Poisson and cube filters, texels, at most 16 and an eighth of the map's edge.
        float spread_texel = 2.0f;
        /// The same across the light, metres, with the same limits. 0: spread_texel holds.
        float spread_m = 0.0f;
        /// Distance from the camera at which that half-width has doubled, metres. 0: it is constant.
        float doubles_m = 0.0f;
        /// Source of randomness of poisson_rotated, poisson_stratified and the pcss filters.
        FilterSeed seed = FilterSeed::world;
        /// Edge of a cell of FilterSeed::world, metres, above 0.
        float cell_m = 0.02f;
        /// Whether filters of many taps take five first, and the others only if those differ.
        bool early_bail = false;
        /// Rays of exact_soft from each pixel in a penumbra, 1 to 256.
        std::uint32_t penumbra_rays = 16;
        bool operator==(const Kernel&) const = default;
    };
    /// Prefiltered maps, exponential to moments and pcss_moments.
    struct Moments {
        /// Bits of a channel, 16 or 32.
        std::uint32_t bits = 32;
        /// Exponent of exponential's and evsm's warp. 0: as much as serves and the format bears.
        float exponent = 0.0f;
        /// Exponent of evsm4's second warp. 0: 5, as far as the format bears it.
        float negative_exponent = 0.0f;
        /// Share of light that counts as dark, 0 to 0.9: light of several casters leaks less.
        float bleeding = 0.2f;
        /// Number of levels of mipmaps, 1 to 4.
        std::uint32_t levels = 1;
        /// Number of samples along a pixel's footprint, 1 to 16.
        std::uint32_t anisotropy = 1;
        bool operator==(const Moments&) const = default;
    };
    /// The offset against self-shadowing.
    struct Bias {
        BiasMode mode = BiasMode::automatic;
        /// Offset along the light of a mode that takes it, metres, at least 0. What is no such number counts as the
        /// default.
        float offset_m = 0.0f;
        /// Offset of a mode that takes it, texels, at least 0. What is no such number counts as the default.
        float offset_texel = 1.0f;
        bool operator==(const Bias&) const = default;
    };
    /// The views from the light.
    struct Projection {
        LightProjection kind = LightProjection::automatic;
        /// Distance of a sun's eye from the middle of what is seen, toward the light, metres. A perspective view looks
        /// from the eye. 0: so far that eye_angle_rad holds all that is seen.
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
        /// How they follow the camera; docs/fits.md compares the three.
        ShadowFit fit = ShadowFit::quantised;
        /// Where they end along the view.
        CascadeSplits splits = CascadeSplits::practical;
        /// Mixture of practical, seen and sampled splits, 0 (uniform) to 1 (logarithmic).
        float split_lambda = 0.7f;
        /// Ends of CascadeSplits::manual, metres along the view, rising. 0 ends the list. One cascade more than
        /// distances.
        std::array<float, kMaxCascades - 1> split_m{};
        /// Share of a cascade that fades into the next one, 0 to 0.5.
        float blend = 0.1f;
        /// Limit of how far texels of tight maps may grow with the distance from the camera: 0 (not) to 1, as
        /// light-space perspective shadow maps do. Within the limit a map is warped as far as it gains (docs/fits.md).
        float warp = 0.0f;
        bool operator==(const Cascades&) const = default;
    };
    /// How maps are stored and drawn.
    struct Maps {
        DepthFormat depth_format = DepthFormat::d32f;
        /// How the faces of a point light's cube are drawn.
        CubeRoute cube_route = CubeRoute::automatic;
        bool operator==(const Maps&) const = default;
    };
    /// What is kept from one frame to the next.
    struct Reuse {
        /// Whether maps are kept while nothing changes. false: every view is drawn in every frame, to the same bits.
        bool economy = true;
        /// Whether what pixels see of the light is kept while nothing changes, and read instead of looked up. The
        /// picture is the same to the bit; 4 bytes per pixel that the light reaches, while that pays. Needs economy.
        bool keep_visibility = true;
        bool operator==(const Reuse&) const = default;
    };
    Kernel kernel = {};
    Moments moments = {};
    Bias bias = {};
    Projection projection = {};
    Cascades cascades = {};
    Maps maps = {};
    Reuse reuse = {};
    bool operator==(const ShadowTuning&) const = default;
};

}  // namespace gnomon
