#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gnomon/light.h"

namespace gnomon::ecs {

/// Opaque, versioned entity id. A destroyed id never equals a living one: its index may be reused, its version is not.
struct Entity {
    std::uint32_t index = 0xffffffffu;  // slot, reused by later entities
    std::uint32_t version = 0;          // number of entities that the slot had before
    bool operator==(const Entity&) const = default;
};

/// Id of no entity. Never alive.
inline constexpr Entity kNull{};

}  // namespace gnomon::ecs

template <>
struct std::hash<gnomon::ecs::Entity> {
    std::size_t operator()(const gnomon::ecs::Entity& e) const noexcept {
        return std::hash<std::uint64_t>{}(std::uint64_t{e.version} << 32 | e.index);
    }
};

/// Components of Gnomon's own registry, beside Light and LightShadow (gnomon/light.h) and ShadowTuning
/// (gnomon/shadow_tuning.h). Plain data: an entity has what is added to it.
namespace gnomon {

/// Place of an entity relative to its parent, or to the world if `parent` is null. Maps a local point p to
/// translation_m + rotation * (scale * p). Positions are double, in metres, so that a scene at 1e8 m behaves like one
/// at the origin. A zero scale hides the entity's mesh; NaN or infinity quarantines the entity (see FrameReport).
struct Transform {
    glm::dvec3 translation_m{0.0};            // place in the parent's space, metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; need not be unit length
    glm::dvec3 scale{1.0};                    // factor along each own axis; negative: mirrored; 0: hidden
    ecs::Entity parent = ecs::kNull;          // entity with a Transform; null: the world
};

/// Place of an entity in the world: maps a local point p to basis * p + translation_ws_m. Written by Frame::run() only,
/// from the Transforms of the entity and its parents; read it wherever that is needed.
struct WorldTransform {
    glm::dmat3 basis{1.0};             // rotation and scale
    glm::dvec3 translation_ws_m{0.0};  // place in the world, metres
    bool operator==(const WorldTransform&) const = default;
};

/// How a camera projects: toward its place, or along parallel lines.
enum class CameraProjection : unsigned char { perspective, orthographic };

/// Looks along its own -Z with +Y up. Each camera with `active` gets shadows. What no active camera sees costs nothing.
struct Camera {
    CameraProjection projection = CameraProjection::perspective;  // which of the next two fields counts
    double fov_y_rad = 0.9;                                       // perspective: full vertical angle, (0, pi)
    double half_height_m = 5.0;                                   // orthographic: half of the visible height
    double near_m = 0.05;                                         // > 0 for perspective
    double far_m = 1.0e9;  // > near; perspective: may be infinite; orthographic: the view ends where the scene does
    /// Width by height of a frame that stays visible whole: a narrower picture shows a taller view. 0 or NaN: only the
    /// height counts.
    double frame_aspect = 0.0;
    bool active = true;  // false: it gets no picture and no shadows
};

/// Draws mesh number `mesh` of the MeshLibrary.
struct MeshRef {
    std::uint32_t mesh = 0;                         // index in MeshLibrary::meshes
    bool visible = true;                            // false: not drawn for any camera; still casts if a ShadowCaster
    bool receives_shadow = true;                    // false: always fully lit by every light
    ShadowLayers shadow_layers = kAllShadowLayers;  // always fully lit by lights of other layers
    /// Shadow catcher: shows nothing of its own but the shadows on it, as black with the share of its light that
    /// casters take as alpha. For real surfaces in a photograph behind the picture. Its material counts by its mask and
    /// its faces alone. Needs `visible`. Default: false.
    bool shadow_catcher = false;
};

/// Box of fog around the entity's place: it receives shadows as a volume, scatters the lights' light toward cameras,
/// and dims what is behind it. Its beams of light and shadow follow from the lights' maps, which hold what darkens any
/// part of it that a camera sees. Single scattering, the same everywhere in the box. An entity with a MeshRef as well
/// has no fog.
struct FogVolume {
    glm::dvec3 half_extent_m{5.0};  // from its middle to its sides along own axes, before Transform::scale; above 0
    /// Share of light that it takes per metre, 0 to 1000: by scattering and absorption. 0: it shows nothing, and only
    /// receives shadows, for particles of your own. Morning mist: 0.02; thick smoke: 1. The default is haze.
    float extinction_per_m = 0.05f;
    glm::vec3 albedo{0.9f};  // part of what it takes that it scatters, 0 to 1: white droplets 1; smoke 0.5
    /// Mean cosine of scattering (Henyey and Greenstein 1941), -0.95 to 0.95. 0: alike in all directions. Above 0: on
    /// ahead, so that lights glow in the view toward them.
    float anisotropy = 0.3f;
    bool receives_shadow = true;                    // false: lights shine through casters in it
    ShadowLayers shadow_layers = kAllShadowLayers;  // lights of other layers shine unoccluded in it
};

/// Makes an entity with a MeshRef cast shadows.
struct ShadowCaster {
    bool enabled = true;                     // false: casts nothing, as without the component
    ShadowLayers layers = kAllShadowLayers;  // lights of other layers do not see it
};

/// Bends the entity's mesh by joints, which are other entities. The mesh must have joints (assets::Mesh::deformer); the
/// entity's own Transform is ignored, as in glTF. All entities with the same mesh look alike: the one with the lowest
/// index sets its pose. For different poses, give each entity its own copy of the mesh.
struct Skin {
    std::vector<ecs::Entity> joints = {};  // entities with Transform; vertices of a joint without one stay at rest
    std::vector<glm::dmat4x3> inverse_bind = {};  // one per joint: joint space at rest from mesh space at rest
};

/// Weight of each morph target of the entity's mesh. 0: not applied. 1: applied in full. Any finite number is allowed.
/// Targets beyond the list count as 0. Among entities that share a mesh, the one with the lowest index sets the weights
/// (see Skin).
struct MorphWeights {
    std::vector<float> weights = {};  // one per target, in the mesh's order
};

/// Name of the entity in reports, picture files and debuggers.
struct Name {
    std::string text;  // any UTF-8; empty: the entity's index is shown
};

}  // namespace gnomon
