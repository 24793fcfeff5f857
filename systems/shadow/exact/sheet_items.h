#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/exact/caster_surfaces.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// A triangle or an edge that the passes of sheets draw. Matches SheetItem in shaders/shadow/exact/bounds.vert
/// (std430).
struct SheetItem {
    std::uint32_t instance = 0;         // slot of its record
    std::uint32_t a = 0, b = 0, c = 0;  // vertices of the common buffer; of an edge c is a
    bool operator==(const SheetItem&) const = default;
};
static_assert(sizeof(SheetItem) == 16);

/// What one view draws over its sheets.
struct SheetItems {
    std::vector<SheetItem> triangles;  // opaque ones that depart from their depth by more than the floor
    std::vector<SheetItem> contours;   // edges where a sheet ends as this light sees it
    std::vector<SheetItem> masked;
    void clear() {
        triangles.clear();
        contours.clear();
        masked.clear();
    }
};

/// By how much a surface may depart from its depth at a texel's middle within that texel without being drawn: what the
/// map of departures is cleared to, as depth. Orthographic maps have one, for planes that the light meets at atan 4
/// from their normal: steeper ones are few. In a perspective view what is far would bear what is near departs by: 0.
struct SheetFloor {
    double departure = 0.0;  // of such a plane, without margins
    float cleared = 0.0f;    // with them
};
SheetFloor sheet_floor(const ShadowView& view, std::uint32_t size_px);

/// Appends what the instance of that surface brings to the view. A facet seen so nearly edge-on that double's and
/// float's rounding could turn it has its edges among the contours whatever is beside it.
class SheetGatherer {
public:
    void append(const GpuScene& gpu, const CasterSurface& surface, const InstanceItem& item, const ShadowView& view,
                std::uint32_t size_px, SheetItems& items);

private:
    std::vector<std::int8_t> facing_;  // per facet: 1 toward the light, -1 away, 0 not known
};

}  // namespace gnomon::shadow
