#include "systems/shadow/projection/light_range.h"

#include "systems/extract/light_facts.h"

namespace gnomon::shadow {

using math::Overlap;

LightReach::LightReach(const LightItem& light) {
    if (light_facts(light.kind).parallel) return;
    position_ws_m_ = light.position_ws_m;
    if (light.range_m > 0.0) {
        range_m_ = light.range_m;
        around_ = {light.position_ws_m - light.range_m, light.position_ws_m + light.range_m};
    }
    if (light_facts(light.kind).cone)
        cone_ = math::planes_around({light.position_ws_m, -light.rotation_ws[2], light.outer_cone_rad});
}

Overlap LightReach::overlap(const math::Aabb& box) const {
    if (range_m_ && math::overlap_ball(position_ws_m_, *range_m_, box) == Overlap::outside) return Overlap::outside;
    if (cone_ && math::overlap(*cone_, box) == Overlap::outside) return Overlap::outside;
    return range_m_ || cone_ ? Overlap::partial : Overlap::inside;
}

std::span<const math::Plane> LightReach::cone() const {
    if (!cone_) return {};
    return *cone_;
}

}  // namespace gnomon::shadow
