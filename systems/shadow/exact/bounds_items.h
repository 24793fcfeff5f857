#pragma once
#include <cstdint>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/exact/error_margins.h"
#include "systems/shadow/exact/facet_depth_range.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Triangle or edge that the passes of conservative maps draw. Matches BoundsItem in
/// shaders/shadow/passes/bounds/bounds_item.glsl (std430).
struct BoundsItem {
    std::uint32_t instance = 0;         // slot of its record
    std::uint32_t a = 0, b = 0, c = 0;  // vertices of the common buffer; an edge has c = a
    bool operator==(const BoundsItem&) const = default;
};
static_assert(sizeof(BoundsItem) == 16);

/// Items that one view draws over its conservative map.
struct BoundsItems {
    enum Kind : std::uint8_t {
        triangles,  // opaque ones with a depth slope above the floor
        contours,   // silhouette edges: a surface ends there as this light sees it
        masked,
        kinds
    };
    /// Items by size. `large` ones are drawn as quads, six vertices each; `small` ones as points, one vertex each. A
    /// small item lies before the light, within a square of kSmall_texel. A point of most_point_px() then covers all
    /// texels that it may overlap.
    std::vector<BoundsItem> large[kinds], small[kinds];
    void clear() {
        for (auto& items : large) items.clear();
        for (auto& items : small) items.clear();
    }
};

/// Gatherer of one view's items: appends what an instance brings to the map, except items beside it. A facet may be so
/// nearly edge-on that rounding of doubles and floats could turn it. All of its edges then count as silhouette edges.
class BoundsGatherer {
public:
    /// Sets the device's limit on points (DeviceInfo). Below most_point_px(), all items are large.
    explicit BoundsGatherer(std::uint32_t max_point_px) : draws_points_(max_point_px >= most_point_px()) {}
    bool draws_points() const { return draws_points_; }

    void append(const GpuScene& gpu, const CasterTopology& surface, const InstanceItem& item, const ShadowView& view,
                std::uint32_t size_px, BoundsItems& items);

private:
    struct Placed {
        double distance_m = 0.0;   // along the view (perspective)
        glm::vec2 at_texel{0.0f};  // place in the map, if is_placed
        bool is_placed = false;    // before the light, and float is off by less than kSmallMoved_texel there
        std::uint8_t beyond = 0;   // a bit per side of the map beyond which it lies, and one for behind the light
    };
    void place(const std::vector<assets::Vertex>& vertices, const CasterTopology& surface, const InstanceItem& item,
               const ShadowView& view, std::uint32_t size_px);
    bool is_small(const Placed& a, const Placed& b, const Placed& c) const;
    bool draws_points_;
    std::vector<std::int8_t> facing_;  // per facet: 1 toward the light, -1 away, 0 unknown
    std::vector<Placed> placed_;       // per vertex of the mesh
};

}  // namespace gnomon::shadow
