#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/index_set.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// Least distance of a lamp from casters' triangles, as a share of their instance's farthest distance from it. A corner
/// transformed in float may be that far from a plane through the lamp: 32 roundings of 2^-24. They are 12 for the
/// corner's position, with a sum over three coordinates; 12 for the plane's normal; and 8 for their product.
inline constexpr double kClearOfPlanes = 0x1p-19;

/// Least distance as a share of the triangle's own farthest distance, for maps that are read without rays. Where a
/// map's sides clip the triangle, its corners round by 2 units of that distance, 2^-23. At this distance from the lamp
/// that is 2^-7 of half of the map: less than two texels of 512. Rays need no such room, so that lights with rays stay
/// nearer.
inline constexpr double kClearOfClipping = 0x1p-16;

/// Positions from which maps and lookups of local lights see the scene. A lamp on a caster's triangle, or nearer than
/// floats resolve, would be before it for one pixel and behind it for the next. Such a lamp gets a small offset to the
/// side of the triangle on which it is in double. Where it lies in the triangle's plane, that is the front side.
class LampOffsets {
public:
    /// Writes the position of each light to `lamps_ws_m`. `gpu`: has meshes deformed as drawn in this frame.
    void update(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const ShadowRequest> requests,
                std::vector<glm::dvec3>& lamps_ws_m, std::span<double> cpu_us);

private:
    /// Position of a lamp near a triangle, reused while neither moves.
    struct KeptPlace {
        std::uint64_t signature = 0;  // hash of the lamp's own position and of the casters near it
        glm::dvec3 place_ws_m{0.0};
    };
    /// Plane of a triangle near the lamp.
    struct Side {
        glm::dvec3 normal{0.0};  // toward the lamp's side
        double height_m = 0.0;   // height of the lamp above the plane
        double clear_m = 0.0;    // target of that height
        bool in_plane = false;
    };

    glm::dvec3 place_of(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light, double share,
                        KeptPlace& kept);
    void find_near(const SceneSnapshot& scene, const LightItem& light, double share);
    void find_sides(const GpuScene& gpu, const LightItem& light, const InstanceItem& item, double share);
    void add_side(Side side);
    glm::dvec3 step_m() const;

    std::vector<KeptPlace> kept_;  // one per light
    IndexSet near_;           // casters with a part near the lamp
    std::vector<Side> sides_;
    std::vector<glm::dvec3> scratch_;
};

}  // namespace gnomon::shadow
