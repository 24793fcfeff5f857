#pragma once
#include <glm/vec4.hpp>

#include "systems/shadow/frame/lighting_inputs.h"

/// What a text of lookup_glsl() reads of lights, in texels of 16 bytes.
namespace gnomon::lookup {

/// One light for the text of lookup_glsl(); matches gnomon_Light there, a texel per member or column.
struct LookupRecord {
    shadow::LightRecord light;
    glm::ivec4 row{0};    // x: LookupKind; y: number of the filter in the text; z: 1: a sun, 2: a spot, 4: reads depths
    glm::ivec4 place{0};  // x: unit, from 0; y: first layer of its depths; z: of its triangles; w: their triangle_bits
    glm::vec4 sizes{0.0f};  // x: reach of the filter; y: edge of the map, texels
};
static_assert(sizeof(LookupRecord) == sizeof(shadow::LightRecord) + 48);

/// What stands before the records.
struct LookupHead {
    shadow::CameraRecord camera;
    glm::ivec4 counts{0};  // x: number of lights
};
static_assert(sizeof(LookupHead) % 16 == 0);

}  // namespace gnomon::lookup
