#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/index_set.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// How far a lamp is kept off the casters' triangles, as a share of how far their instance reaches from it: so far off
/// a corner, carried there in float, may be from a plane through the lamp. 32 units: a corner's place (12, with a sum
/// over three coordinates), the plane's normal as far away (as many), their product (8).
inline constexpr double kClearOfPlanes = 0x1p-19;

/// The same as a share of how far the triangle itself reaches, for maps that are read by what their texels hold: where
/// a map's sides cut it, its corners round by that reach (2 units), which so near to the lamp is this much of the map's
/// half: 2^-7, less than two texels of 512. Rays need no such room, and what is asked by them stays nearer.
inline constexpr double kClearOfClipping = 0x1p-16;

/// From where shadows of local lights are looked for. A lamp on a triangle of a caster, or nearer to it than floats can
/// tell, would be before it for one pixel and behind it for the next: its maps and lookups stand a little aside, on the
/// side of each such triangle that the lamp is on in double; on its front, where the lamp lies in its plane.
class LampPlaces {
public:
    /// Writes the place of each light to `lamps_ws_m`. `gpu` has meshes bent as they are drawn in this frame.
    void update(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const ShadowRequest> requests,
                std::vector<glm::dvec3>& lamps_ws_m, std::span<double> cpu_us);

private:
    /// Of a lamp that touches something; the next frame keeps it while nothing moved.
    struct Held {
        std::uint64_t signature = 0;  // of the light's place and of what it touches
        glm::dvec3 place_ws_m{0.0};
    };
    /// A triangle's plane near the lamp: its normal, toward the side that the lamp is on, and how high that is above.
    struct Side {
        glm::dvec3 normal{0.0};
        double height_m = 0.0;
        double clear_m = 0.0;  // how high it is to be
        bool in_plane = false;
    };

    glm::dvec3 place_of(const SceneSnapshot& scene, const GpuScene& gpu, const LightItem& light, double share,
                        Held& held);
    void find_near(const SceneSnapshot& scene, const LightItem& light, double share);
    void find_sides(const GpuScene& gpu, const LightItem& light, const InstanceItem& item, double share);
    void add_side(Side side);
    glm::dvec3 step_m() const;

    std::vector<Held> held_;  // one for each light
    Marks near_;              // instances with a part near enough
    std::vector<Side> sides_;
    std::vector<glm::dvec3> scratch_;
};

/// Returns from where a local light's shadows are looked for. `lamps_ws_m`: of LampPlaces; empty: where the lights are.
inline const glm::dvec3& lamp_ws_m(std::span<const glm::dvec3> lamps_ws_m, const SceneSnapshot& scene,
                                   std::uint32_t light) {
    return light < lamps_ws_m.size() ? lamps_ws_m[light] : scene.lights[light].position_ws_m;
}

}  // namespace gnomon::shadow
