#include "systems/shadow/projection/light_range.h"

#include <glm/geometric.hpp>

#include "systems/extract/light_facts.h"

namespace gnomon::shadow {

using math::Overlap;

namespace {

/// Bit of the range's test, beside those of the cone's planes.
constexpr math::OpenTests kRangeTest = math::OpenTests{1} << 32;
static_assert(math::kConeSides + 1 <= 32);

}  // namespace

math::Plane shone_side(const LightItem& light) {
    const glm::dvec3& back = light.rotation_ws[2];
    return {-back, glm::dot(back, light.position_ws_m)};
}

LightReach::LightReach(const LightItem& light) {
    if (light_facts(light.kind).parallel) return;
    position_ws_m_ = light.position_ws_m;
    if (light.range_m > 0.0) {
        range_m_ = light.range_m;
        around_ = {light.position_ws_m - light.range_m, light.position_ws_m + light.range_m};
    }
    if (light_facts(light.kind).cone)
        cone_ = math::planes_around({light.position_ws_m, -light.rotation_ws[2], light.outer_cone_rad});
    if (light_facts(light.kind).half_space) side_ = shone_side(light);
}

Overlap LightReach::overlap(const math::Aabb& box) const {
    if (range_m_ && math::overlap_ball(position_ws_m_, *range_m_, box) == Overlap::outside) return Overlap::outside;
    if (cone_ && math::overlap(*cone_, box) == Overlap::outside) return Overlap::outside;
    if (side_ && math::overlap(std::span(&*side_, 1), box) == Overlap::outside) return Overlap::outside;
    return range_m_ || cone_ || side_ ? Overlap::partial : Overlap::inside;
}

math::OpenTests LightReach::tests() const { return math::open_tests(cone().size()) | (range_m_ ? kRangeTest : 0); }

Overlap LightReach::overlap(const math::Aabb& box, math::OpenTests& open) const {
    Overlap result = Overlap::inside;
    if ((open & kRangeTest) != 0) {
        result = math::overlap_ball(position_ws_m_, *range_m_, box);
        if (result == Overlap::outside) return result;
        if (result == Overlap::inside) open &= ~kRangeTest;
    }
    if (open == 0) return result;
    const Overlap of_cone = math::overlap(cone(), box, open);
    return of_cone == Overlap::inside ? result : of_cone;
}

std::span<const math::Plane> LightReach::cone() const {
    if (side_) return std::span(&*side_, 1);
    if (!cone_) return {};
    return *cone_;
}

}  // namespace gnomon::shadow
