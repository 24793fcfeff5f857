#include "systems/embed/air_box.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/math/aabb.h"
#include "engine/math/finite.h"
#include "systems/extract/drawable_basis.h"

namespace gnomon::embed {
namespace {

/// Cube that AirDesc::world_from_box places.
const math::Aabb kCube{glm::dvec3(-0.5), glm::dvec3(0.5)};

}  // namespace

CasterDesc in_air(const AirDesc& desc) {
    CasterDesc stored;
    stored.world_from_mesh = desc.world_from_box;
    stored.casts = false;
    stored.receive_layers = desc.receive_layers;
    return stored;
}

DropReason fault_of_air(const glm::dmat4& world_from_box) {
    if (!math::is_finite(world_from_box)) return DropReason::non_finite_transform;
    const std::optional<glm::dmat3> basis = drawable_basis(glm::dmat3(world_from_box));
    if (!basis) return DropReason::zero_scale;
    const math::Aabb box = math::transformed(kCube, *basis, glm::dvec3(world_from_box[3]));
    return math::is_finite(box) && !math::is_empty(box) ? DropReason::instances_full : DropReason::zero_scale;
}

void put_air(const glm::dmat4& world_from_box, InstanceItem& item) {
    item.mesh = kNoMesh;
    item.basis = *drawable_basis(glm::dmat3(world_from_box));
    item.translation_ws_m = glm::dvec3(world_from_box[3]);
    item.bounds_ws = math::transformed(kCube, item.basis, item.translation_ws_m);
}

}  // namespace gnomon::embed
