#pragma once
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

/// Faces of casters that a light draws into its maps. Only meshes that are known to be solid have sides to choose from
/// (closed, wound outward, opaque and single-sided throughout). Of all others both sides are drawn, because light would
/// shine through a single one. So are both sides of a solid whose box holds the light.
enum class CasterFaces : std::uint8_t { automatic, front, back, both };

inline constexpr std::size_t kMaxCascades = 8;

/// Settings of a light's shadow. Add this to a Light's entity and the light casts shadows; remove it and its maps are
/// freed. A light's size belongs to Light. How filters, maps and fits work belongs to ShadowTuning, which nobody needs.
struct LightShadow {
    /// Whether the light casts shadows.
    bool enabled = true;
    /// Filter that reads the map. `automatic`: triangles, which measures best (docs/accuracy.md), or exact where
    /// max_error_px is set and no map keeps it otherwise.
    ShadowFilter filter = ShadowFilter::automatic;
    /// Distance that a shadow's edge may be off on screen, pixels. 0: 1, as far as maps of the usual size keep it.
    float max_error_px = 0.0f;
    /// Edge of one map, cascade or cube face, texels. 0: chosen by the system.
    std::uint32_t resolution_px = 0;
    /// Number of a sun's cascades, at most kMaxCascades. 0: as few as serve, one to four.
    std::uint32_t cascades = 0;
    /// Distance that an edge may be off further where a map shows casters at an earlier place, pixels. The map need not
    /// be drawn whenever one moves (docs/economy.md). 0: it is. Needs BiasMode::automatic.
    float refresh_error_px = 0.0f;
    /// Faces of solid casters in the maps. `automatic`: front, which measures best (docs/accuracy.md).
    CasterFaces caster_faces = CasterFaces::automatic;
    /// Layers of casters and receivers that this light's shadows join, a bit each (shadow_layers.h).
    ShadowLayers layers = kAllShadowLayers;
    bool operator==(const LightShadow&) const = default;
};

}  // namespace gnomon
