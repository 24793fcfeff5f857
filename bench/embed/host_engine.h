#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/result.h"
#include "systems/extract/snapshot.h"

namespace gnomon::bench {

inline constexpr std::uint32_t kMostHostLights = 8;

/// Triangles of one instance, for an engine and for gnomon::Shadows. A part is cut out where its alpha is low.
struct HostPart {
    std::uint32_t mesh = 0;
    glm::dmat4 world_from_mesh{1.0};
    bool casts = false, receives = true;
};
struct HostMesh {
    std::string name;
    std::vector<glm::vec3> positions_m;
    std::vector<glm::vec2> uvs;  // empty: it has no mask
    std::vector<std::uint32_t> indices;
    bool two_sided = false;
    glm::uvec2 mask_px{0, 0};
    std::vector<std::uint8_t> alpha;
    float cutoff = 0.5f;
};
struct HostScene {
    std::vector<HostMesh> meshes;
    std::vector<HostPart> parts;
};

/// Returns what a snapshot shows, except what is blended. Meshes with a masked material come apart by material.
HostScene host_scene(const SceneSnapshot& snapshot, const assets::MeshLibrary& library);

/// How a light of the engine's shader is shadowed.
enum class HostShadows : std::uint8_t { none, mask, lookup };

/// Camera of one frame.
struct HostCamera {
    glm::dmat4 world_from_view{1.0}, clip_from_view{1.0};  // reversed depths of [0, 1]
};
/// Light of the engine's shader.
struct HostLight {
    glm::vec4 place{0.0f};  // xyz: toward a sun, or from the camera to the lamp; w: 1: a lamp
    int index = 0;          // layer of the mask, or number in the lookups' text
};

/// Engine that knows OpenGL and gnomon/shadows.h alone: it draws depths and normals, then lights them by one shader.
class HostEngine {
public:
    /// Uploads a scene. Its context must be current until the end of the object's life.
    HostEngine(const HostScene& scene, glm::uvec2 size_px);
    ~HostEngine();
    HostEngine(const HostEngine&) = delete;
    HostEngine& operator=(const HostEngine&) = delete;

    /// Makes the lighting shader. `lookups`: text of Shadows::lookup_glsl(). Its names must leave units 0 to 2 and
    /// binding 0. Errors: "bench.program".
    Result<unsigned> make_shader(HostShadows shadows, const std::string& lookups = {});
    void free_shader(unsigned program);

    void draw_surfaces(const HostCamera& camera) const;
    /// Lights the surfaces, all lights in one draw. `mask`: its texture, or 0.
    void draw_lights(unsigned program, const HostCamera& camera, std::span<const HostLight> lights,
                     unsigned mask) const;
    /// Returns the share of each light at each pixel, summed over all: what its shader shows without a surface's
    /// shading.
    std::vector<float> read_lit() const;

    unsigned depth_texture() const { return depth_; }
    unsigned normal_texture() const { return normals_; }
    glm::uvec2 size_px() const { return size_px_; }

private:
    struct Mesh {
        unsigned vertices = 0, uvs = 0, indices = 0, mask = 0, array = 0;
        int count = 0;
        float cutoff = 0.0f;
    };
    glm::uvec2 size_px_;
    std::vector<Mesh> meshes_;
    std::vector<HostPart> parts_;
    unsigned depth_ = 0, normals_ = 0, lit_ = 0, surfaces_ = 0, picture_ = 0, surface_program_ = 0, no_vertices_ = 0;
};

}  // namespace gnomon::bench
