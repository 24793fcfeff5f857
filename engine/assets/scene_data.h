#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/animation.h"
#include "engine/assets/deformer.h"
#include "engine/math/aabb.h"
#include "engine/math/shape_tree.h"

/// Neutral scene data: the content of a file, before any entity exists.
namespace gnomon::assets {

inline constexpr std::int32_t kNone = -1;

/// Vertex in the device's "mesh" layout: 32 bytes.
struct Vertex {
    glm::vec3 position_ms{0.0f};
    glm::vec3 normal_ms{0.0f};  // unit length, or zero if undefined (degenerate)
    glm::vec2 uv{0.0f};         // glTF convention: v down
    bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 32);

struct Submesh {
    std::uint32_t first_index = 0, index_count = 0;  // triangles
    std::uint32_t material = 0;
};

/// Result of OpenMesh's analysis, over positions welded by identical bits.
struct Topology {
    bool closed = false;   // no boundary edge, no non-manifold edge, at least one face, consistently oriented
    bool outward = false;  // closed, and every component encloses a positive volume: front faces point out
    std::uint32_t boundary_edges = 0;
    std::uint32_t non_manifold_edges = 0;  // edges shared by more than two faces or with inconsistent winding
    std::uint32_t degenerate_faces = 0;    // zero area or repeated (welded) vertices
    std::uint32_t components = 0;
};

struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<glm::vec4> colours;      // COLOR_0, linear, [0, 1]: one per vertex, or empty if all are 1
    std::vector<std::uint32_t> indices;  // triangle list; every index < vertices.size()
    std::vector<Submesh> submeshes;      // cover indices in order, without gaps
    math::Aabb bounds_ms;                // recomputed, never the file's
    Topology topology;
    std::shared_ptr<const math::ShapeTree> shape;  // built by shape_of() (mesh_shape.h); optional
    std::shared_ptr<const Deformer> deformer;      // null: rigid. All other fields describe the mesh at rest
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

struct Material {
    std::string name;
    glm::vec4 base_colour{1.0f};  // linear
    std::int32_t base_colour_texture = kNone;
    glm::vec3 emissive{0.0f};
    float metallic = 1.0f, roughness = 1.0f;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;  // shows base_colour independent of light and exposure; casts shadows
};

enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };
struct Texture {
    std::string name;
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // sRGB colour, linear alpha; first row is v = 0 (top, as in the file)
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    bool linear_filter = true;
};

enum class CameraKind : std::uint8_t { perspective, orthographic };
struct CameraData {
    std::string name;
    CameraKind kind = CameraKind::perspective;
    double fov_y_rad = 0.9, half_height_m = 5.0, near_m = 0.05, far_m = 0.0;  // far 0: infinite
    double aspect = 0.0;  // width by height of the author's frame; 0: none chosen
};

enum class LightType : std::uint8_t { directional, spot, point };
struct LightData {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 colour{1.0f};
    float intensity = 1.0f, range_m = 0.0f, inner_cone_rad = 0.0f, outer_cone_rad = 0.785398163f;
    bool casts_shadow = true;  // extras.shadow of the light or its node
};

/// Joints of a skinned mesh. world(joints[i]) * inverse_bind[i] takes the mesh from rest to joint i.
struct Skin {
    std::string name;
    std::vector<std::int32_t> joints;        // nodes; at least one
    std::vector<glm::dmat4x3> inverse_bind;  // one per joint
};

/// Node. Parents come before children. Only one node may use a deformable mesh.
struct Node {
    std::string name;
    std::int32_t parent = kNone;
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::int32_t mesh = kNone, camera = kNone, light = kNone;
    std::int32_t skin = kNone;         // only for a mesh with joints; the node's own place is then ignored
    std::vector<float> morph_weights;  // at rest; one per target of the mesh
    bool casts_shadow = true;          // extras.castShadow
    bool receives_shadow = true;       // extras.receiveShadow
    bool visible = true;               // extras.visible
    /// Animation of a caster or light by the sample game (extras.motion); kind "": none.
    /// - "spin": rotates about `axis` once per period_s.
    /// - "swing": rotates to and fro by amplitude (rad) about `axis`.
    /// - "slide": moves to and fro by amplitude (m) along `axis`.
    struct Motion {
        std::string kind;
        glm::dvec3 axis{0.0, 1.0, 0.0};
        double amplitude = 0.0, period_s = 1.0, phase = 0.0;  // phase in turns
    } motion;
};

struct SceneData {
    std::string name;
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // at least one; a mesh without material uses a default one
    std::vector<Texture> textures;
    std::vector<CameraData> cameras;
    std::vector<LightData> lights;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<std::string> warnings;  // one line each: missing texture, unsupported mode, …
};

}  // namespace gnomon::assets
