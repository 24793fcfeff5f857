#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "sample_game/support/built_in_scenes/glb_writer.h"

/// Builders and materials that the parts of the valley share.
namespace gnomon::game {

struct ValleyMaterials {
    std::uint32_t grass, plaster, roof, wood, bark, needles, leaves;
};

struct ValleyKit {
    GlbBuilder& glb;
    ValleyMaterials materials;
};

/// Returns the height of the ground, metres: 0 in the village, hills beyond it, a ridge at the far end.
double ground_height_m(double x_m, double z_m);

void add_valley_ground(const ValleyKit& kit);
void add_houses(const ValleyKit& kit);  // the village's and the hamlets'
void add_woods(const ValleyKit& kit);   // single trees in the village, woods on the hills
void add_lane(const ValleyKit& kit);    // fences and posts beside the lane, a person on it

}  // namespace gnomon::game
