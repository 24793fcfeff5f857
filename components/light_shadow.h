#pragma once
#include <cstddef>
#include <cstdint>

#include "components/shadow_layers.h"

namespace gnomon {

/// Rows of the filter table (systems/shadow/request/filter_table.h), one per file in shaders/shadow/filters.
/// `automatic` is no row: the accuracy target chooses one (systems/shadow/request/filter_choice.h).
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
    /// Layers of the casters and receivers that take part in this light's shadows, a bit each (shadow_layers.h).
    ShadowLayers layers = kAllShadowLayers;
    bool operator==(const LightShadow&) const = default;
};

}  // namespace gnomon
