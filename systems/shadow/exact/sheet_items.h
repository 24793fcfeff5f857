#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/exact/caster_surfaces.h"
#include "systems/shadow/exact/flat_facets.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// A triangle or an edge that the passes of sheets draw. Matches SheetItem in shaders/shadow/exact/sheet_item.glsl
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

/// Appends what the instance of that surface brings to the view's map, but for what lies beside it. A facet seen so
/// nearly edge-on that double's and float's rounding could turn it has its edges among the contours whatever is beside
/// it.
class SheetGatherer {
public:
    void append(const GpuScene& gpu, const CasterSurface& surface, const InstanceItem& item, const ShadowView& view,
                std::uint32_t size_px, SheetItems& items);

private:
    struct Placed {
        double distance_m = 0.0;  // along the view (perspective)
        std::uint8_t beyond = 0;  // a bit per side of the map beyond which it lies, and one for behind the light
    };
    void place(const std::vector<assets::Vertex>& vertices, const CasterSurface& surface, const InstanceItem& item,
               const ShadowView& view, std::uint32_t size_px);
    std::vector<std::int8_t> facing_;  // per facet: 1 toward the light, -1 away, 0 not known
    std::vector<Placed> placed_;       // per vertex of the mesh
};

}  // namespace gnomon::shadow
