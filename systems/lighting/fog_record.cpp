#include "systems/lighting/fog_record.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gnomon::lighting {
namespace {

/// Golden ratio: rounds of noise that lie by it apart fill the unit interval evenly.
constexpr double kGolden = 0.61803398874989485;

}  // namespace

FogRecord fog_record(const FogItem& fog, const InstanceItem& box, const glm::dvec3& anchor_ws_m,
                     std::uint32_t noise_round) {
    FogRecord record;
    const glm::dmat3 box_from_world = glm::inverse(box.basis);
    const glm::dvec3 anchor = (box_from_world * (anchor_ws_m - box.translation_ws_m)) / fog.half_extent_m;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 row(box_from_world[0][i], box_from_world[1][i], box_from_world[2][i]);
        record.to_box[i] = glm::vec4(glm::dvec4(row / fog.half_extent_m[i], anchor[i]));
    }
    record.taken = glm::vec4(fog.albedo, fog.extinction_per_m);
    const double offset = noise_round * kGolden;
    record.marks = {fog.anisotropy, static_cast<float>(offset - std::floor(offset)),
                    box.receives ? static_cast<float>(box.receive_layers) : 0.0f, 0.0f};
    return record;
}

}  // namespace gnomon::lighting
