#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/box.h"
#include "gnomon/result.h"

namespace gnomon::math {
class ShapeTree;
}

/// Meshes, materials and textures for Frame, and the content of glTF files. load_gltf() and what evaluates animations
/// are in the target Gnomon::assets; all else is plain data.
namespace gnomon::assets {

struct Deformer;

/// Index of nothing.
inline constexpr std::int32_t kNone = -1;

/// Vertex in the device's "mesh" layout: 32 bytes.
struct Vertex {
    glm::vec3 position_ms{0.0f};  // metres, mesh space
    glm::vec3 normal_ms{0.0f};    // unit length, or zero if undefined (degenerate)
    glm::vec2 uv{0.0f};           // glTF convention: v down
    bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 32);

/// Triangles of a mesh with one material.
struct Submesh {
    std::uint32_t first_index = 0, index_count = 0;  // triangles
    std::uint32_t material = 0;                      // index in MeshLibrary::materials
};

/// What a mesh's surface is like, over positions welded by identical bits.
struct Topology {
    bool closed = false;   // no boundary edge, no non-manifold edge, at least one face, consistently oriented
    bool outward = false;  // closed, and every component encloses a positive volume: front faces point out
    std::uint32_t boundary_edges = 0;      // edges of one face alone
    std::uint32_t non_manifold_edges = 0;  // edges shared by more than two faces or with inconsistent winding
    std::uint32_t degenerate_faces = 0;    // zero area or repeated (welded) vertices
    std::uint32_t components = 0;          // parts that share no edge
    bool operator==(const Topology&) const = default;
};

/// Coarser mesh that may stand in for a mesh in shadow maps (ShadowTuning::Maps::proxies), where the
/// difference does not show. Opaque parts are coarser, masked ones the same.
struct MeshProxy {
    std::uint32_t mesh = 0;  // index in MeshLibrary::meshes; it has no proxies of its own
    /// Bound on the distance of each point of either surface from the other surface (two-sided Hausdorff distance),
    /// metres in mesh space, above 0.
    float bound_m = 0.0f;
    bool operator==(const MeshProxy&) const = default;
};

/// Triangles and what follows from them. Call complete() for each mesh of your own making.
struct Mesh {
    std::string name;                    // in messages and captures
    std::vector<Vertex> vertices;        // positions, normals, texture coordinates
    std::vector<glm::vec4> colours;      // COLOR_0, linear, [0, 1]: one per vertex, or empty if all are 1
    std::vector<std::uint32_t> indices;  // triangle list; every index < vertices.size()
    std::vector<Submesh> submeshes;      // cover indices in order, without gaps
    /// What follows from these; complete() fills it in.
    math::Aabb bounds_ms;
    Topology topology;                             // decides which faces cast
    std::shared_ptr<const math::ShapeTree> shape;  // boxes around the triangles; null: bounds_ms alone
    math::Aabb inner_ms;  // box inside of a closed part, mesh space: it hides what is behind it; empty: none is known
    /// Joints and morph targets of a file's mesh; null: rigid. All other fields describe the mesh at rest.
    std::shared_ptr<const Deformer> deformer;
    std::vector<MeshProxy> proxies;  // by rising bound; add_proxies() makes them
};

/// What alpha does. `mask`: a hole where it is below the cutoff. `blend`: the share that the surface covers; the rest
/// of the light passes through it.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Surface, as glTF's metallic-roughness model.
struct Material {
    std::string name;                          // in messages
    glm::vec4 base_colour{1.0f};               // linear, each 0 to 1; alpha counts by alpha_mode
    std::int32_t base_colour_texture = kNone;  // multiplies base_colour; kNone: without
    glm::vec3 emissive{0.0f};                  // linear, at least 0, in multiples of the display's white
    float metallic = 1.0f;                     // 0 (dielectric) to 1 (metal)
    float roughness = 1.0f;                    // 0 (mirror) to 1 (matt)
    AlphaMode alpha_mode = AlphaMode::opaque;  // change it for leaves (mask) and glass (blend)
    float alpha_cutoff = 0.5f;                 // AlphaMode::mask: alpha below it is a hole, 0 to 1
    bool double_sided = false;                 // both faces are drawn, and cast
    bool unlit = false;                        // shows base_colour independent of light and exposure; casts shadows
    /// Share of light that passes through what the surface covers, per channel, 0 to 1, before base_colour tints it. 0:
    /// none. The surface casts coloured light in place of a shadow. Set it for glass; metallic surfaces stay opaque.
    glm::vec3 transmission{0.0f};
};

/// Returns true if light passes through parts of the surface: it is blended, or transmits. Such a surface is a
/// translucent caster: it is in no depth map and in no tree of opaque casters.
inline bool transmits(const Material& m) {
    return m.alpha_mode == AlphaMode::blend ||
           (m.metallic < 1.0f && (m.transmission.x > 0.0f || m.transmission.y > 0.0f || m.transmission.z > 0.0f));
}

/// Returns true if all of the surface blocks light: it has no mask and lets none through.
inline bool is_opaque(const Material& m) { return m.alpha_mode == AlphaMode::opaque && !transmits(m); }

/// What lies beyond the edge of a texture.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };
/// Picture on a surface.
struct Texture {
    std::string name;                     // in messages
    std::uint32_t width = 0, height = 0;  // pixels, above 0
    std::vector<std::uint8_t> rgba;       // sRGB colour, linear alpha; first row is v = 0 (top, as in the file)
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  // along u and v
    bool linear_filter = true;                                               // false: the nearest texel
};

/// Fills in bounds, topology, shape and inner box, which follow from vertices, indices and submeshes. Cost: in
/// proportion to the triangles. Call it for each mesh of your own making. Without a topology a mesh counts as open, and
/// is drawn from both sides.
void complete(Mesh& mesh);

/// Versions of numbered things that come and go, and numbers that are free.
struct SlotVersions {
    std::vector<std::uint64_t> by_slot = {};  // shorter than the things: the others have version 0
    std::vector<std::uint32_t> free = {};     // slots that the next things take, the last first

    /// Returns the version of a slot.
    std::uint64_t of(std::uint32_t slot) const { return slot < by_slot.size() ? by_slot[slot] : 0; }
    /// Sets the version of a slot.
    void set(std::uint32_t slot, std::uint64_t version) {
        if (by_slot.size() <= slot) by_slot.resize(slot + std::size_t{1}, 0);
        by_slot[slot] = version;
    }
};

/// Meshes, materials and textures that MeshRef components refer to. Once a Frame has it, it changes by the functions
/// below alone. Change it between frames, while no thread reads it.
struct MeshLibrary {
    std::vector<Mesh> meshes;         // MeshRef::mesh indexes this
    std::vector<Material> materials;  // Submesh::material indexes this
    std::vector<Texture> textures;    // Material::base_colour_texture indexes this

    /// Adds a mesh in the slot of a removed one, or at the end. Its materials must exist. Returns its index.
    std::uint32_t add(Mesh mesh) {
        while (!mesh_versions.free.empty() && !is_removed(mesh_versions.free.back())) mesh_versions.free.pop_back();
        return put(meshes, std::move(mesh), mesh_versions);
    }
    /// Adds a material, as add() does. Its texture must exist.
    std::uint32_t add_material(Material material) { return put(materials, std::move(material), material_versions); }
    /// Adds a texture, as add() does.
    std::uint32_t add_texture(Texture texture) { return put(textures, std::move(texture), texture_versions); }

    /// Replaces a mesh by another one; its instances then show that. Its proxies are removed.
    void replace(std::uint32_t mesh, Mesh with) {
        remove_proxies(mesh);
        meshes[mesh] = std::move(with);
        mesh_versions.set(mesh, ++version);
    }
    /// Removes a mesh with its proxies and frees their memory. Its slot may be taken by another mesh; entities that
    /// still name it show nothing until then.
    void remove(std::uint32_t mesh) {
        remove_proxies(mesh);
        take(meshes, mesh, mesh_versions);
    }
    /// Removes a material that no mesh has. Another one may take the slot.
    void remove_material(std::uint32_t material) { take(materials, material, material_versions); }
    /// Removes a texture that no material has. Another one may take the slot.
    void remove_texture(std::uint32_t texture) { take(textures, texture, texture_versions); }

    /// Returns the version at which the slot got its mesh, or lost it; 0: it has had one mesh since the beginning.
    std::uint64_t version_of(std::uint32_t mesh) const { return mesh_versions.of(mesh); }
    /// Returns true if the slot has had a mesh, and has none now.
    bool is_removed(std::uint32_t mesh) const { return version_of(mesh) != 0 && meshes[mesh].indices.empty(); }

    std::uint64_t version = 0;  // number of changes by these functions
    /// Versions of the slots, written by these functions alone.
    SlotVersions mesh_versions = {};
    SlotVersions material_versions = {};  // the same of materials
    SlotVersions texture_versions = {};   // the same of textures

private:
    void remove_proxies(std::uint32_t mesh) {
        for (const MeshProxy& proxy : std::exchange(meshes[mesh].proxies, {})) take(meshes, proxy.mesh, mesh_versions);
    }
    template <class T>
    std::uint32_t put(std::vector<T>& things, T thing, SlotVersions& versions) {
        auto slot = static_cast<std::uint32_t>(things.size());
        if (versions.free.empty()) {
            things.push_back(std::move(thing));
        } else {
            slot = versions.free.back();
            versions.free.pop_back();
            things[slot] = std::move(thing);
        }
        versions.set(slot, ++version);
        return slot;
    }
    template <class T>
    void take(std::vector<T>& things, std::uint32_t slot, SlotVersions& versions) {
        things[slot] = {};
        versions.set(slot, ++version);
        versions.free.push_back(slot);
    }
};

/// Makes proxies of each mesh that has none yet, has enough triangles, and is neither deformable nor coloured per
/// vertex. They are added as meshes of their own. Call it once after loading, before a Frame has the library. Cost: a
/// tenth of a millisecond per triangle. Returns the number of proxies.
std::uint32_t add_proxies(MeshLibrary& library);

/// What a curve moves.
enum class AnimatedProperty : std::uint8_t { translation, rotation, scale, weights };
/// How a curve goes from key to key.
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Curve of one property of one node, as in glTF 2.0 (section 3.11 and appendix C).
struct AnimationChannel {
    std::int32_t node = -1;                                     // index in SceneData::nodes
    AnimatedProperty property = AnimatedProperty::translation;  // what it moves
    Interpolation interpolation = Interpolation::linear;        // between keys
    std::uint32_t width = 3;     // numbers per value; rotation: 4, in the order x, y, z, w
    std::vector<float> times_s;  // at least one, finite, not decreasing
    std::vector<float> values;   // `width` per key; cubic: in-tangent, value and out-tangent of each key
};

/// Curves that play together.
struct Animation {
    std::string name;                        // as in the file
    std::vector<AnimationChannel> channels;  // at most one per node and property
};

/// Returns the time of the last key of any channel; 0 without channels.
double duration_s(const Animation& animation);

/// Wraps `time_s` into an animation that repeats every `duration_s`: [0, duration_s). 0 if the duration is 0 or the
/// time not finite. The end equals the beginning.
double looped_s(double time_s, double duration_s);

/// Evaluates the channel at `time_s` into `out`, channel.width numbers. Before the first key and after the last it
/// clamps. Rotations have unit length; linear ones take the shorter way at constant speed.
void sample(const AnimationChannel& channel, double time_s, std::span<double> out);

/// How a camera of a file projects.
enum class CameraKind : std::uint8_t { perspective, orthographic };
/// Camera of a file.
struct CameraData {
    std::string name;                                                         // as in the file
    CameraKind kind = CameraKind::perspective;                                // how it projects
    double fov_y_rad = 0.9, half_height_m = 5.0, near_m = 0.05, far_m = 0.0;  // far 0: infinite
    double aspect = 0.0;  // width by height of the author's frame; 0: none chosen
};

/// Kind of a light of a file.
enum class LightType : std::uint8_t { directional, spot, point, rectangle, disc, sphere, tube };
/// Light of a file, as KHR_lights_punctual or EXT_lights_area has it.
struct LightData {
    std::string name;                     // as in the file
    LightType type = LightType::point;    // kind
    glm::vec3 colour{1.0f};               // linear
    float intensity = 1.0f;               // lux of a directional light, nits of an area light, else candela
    float range_m = 0.0f;                 // 0: unlimited
    float inner_cone_rad = 0.0f;          // spot: half angle of full intensity
    float outer_cone_rad = 0.785398163f;  // spot: half angle where light ends
    float width_m = 1.0f, height_m = 1.0f;  // rectangle; width_m: also length of a tube
    float radius_m = 0.0f;                  // disc, sphere and tube
    bool casts_shadow = true;             // extras.shadow of the light or its node
};

/// Joints of a skinned mesh. world(joints[i]) * inverse_bind[i] takes the mesh from rest to joint i.
struct Skin {
    std::string name;                        // as in the file
    std::vector<std::int32_t> joints;        // nodes; at least one
    std::vector<glm::dmat4x3> inverse_bind;  // one per joint
};

/// Node. Parents come before children. Only one node may use a deformable mesh.
struct Node {
    std::string name;                                          // as in the file
    std::int32_t parent = kNone;                               // index of a node before it; kNone: the world
    glm::dvec3 translation_m{0.0};                             // in the parent's space, metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};                   // w, x, y, z
    glm::dvec3 scale{1.0};                                     // along each own axis
    std::int32_t mesh = kNone, camera = kNone, light = kNone;  // indices in SceneData; kNone: without
    std::int32_t skin = kNone;         // only for a mesh with joints; the node's own place is then ignored
    std::vector<float> morph_weights;  // at rest; one per target of the mesh
    bool casts_shadow = true;          // extras.castShadow
    bool receives_shadow = true;       // extras.receiveShadow
    bool visible = true;               // extras.visible
    bool shadow_catcher = false;       // extras.shadowCatcher
    /// Animation of a caster or light by the sample game (extras.motion); kind "": none.
    /// - "spin": rotates about `axis` once per period_s.
    /// - "swing": rotates to and fro by amplitude (rad) about `axis`.
    /// - "slide": moves to and fro by amplitude (m) along `axis`.
    struct Motion {
        std::string kind;                                     // one of these, or empty
        glm::dvec3 axis{0.0, 1.0, 0.0};                       // in the node's space
        double amplitude = 0.0, period_s = 1.0, phase = 0.0;  // phase in turns
    } motion;                                                 // none by default
};

/// Content of a file, before any entity exists.
struct SceneData {
    std::string name;                   // the file's
    std::vector<Node> nodes;            // parents before children
    std::vector<Mesh> meshes;           // Node::mesh indexes this
    std::vector<Material> materials;    // at least one; a mesh without material uses a default one
    std::vector<Texture> textures;      // Material::base_colour_texture indexes this
    std::vector<CameraData> cameras;    // Node::camera indexes this
    std::vector<LightData> lights;      // Node::light indexes this
    std::vector<Skin> skins;            // Node::skin indexes this
    std::vector<Animation> animations;  // in the file's order
    std::vector<std::string> warnings;  // one line each: missing texture, unsupported mode, …
};

/// Loads a .gltf or .glb file with everything it names. Reads nothing outside the asset's folder. The result is
/// validated: every index in range, every number finite, every node reached once. On error nothing is kept; the error
/// names file, JSON pointer and rule.
Result<SceneData> load_gltf(const std::filesystem::path& file);

/// Loads from memory (fuzzing, embedded scenes). `base_folder` resolves relative URIs; if empty, URIs are errors.
Result<SceneData> load_gltf_memory(std::span<const std::byte> bytes, const std::filesystem::path& base_folder,
                                   const std::string& name);

}  // namespace gnomon::assets
