#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sample_game/support/built_in_scenes/primitives.h"

namespace tinygltf {
class Model;
}

namespace gnomon::game {

struct MaterialSpec {
    std::string name;
    glm::vec4 base_colour{1.0f};                // linear
    std::optional<std::uint32_t> texture = {};  // result of add_texture(); empty: none
    float metallic = 0.0f, roughness = 0.8f;
    glm::vec3 emissive{0.0f};
    std::optional<float> alpha_cutoff = {};  // set: alpha mask
    bool double_sided = false;
    bool blended = false;       // alpha is the covered share
    float transmission = 0.0f;  // share of light that passes what is covered; needs `blended`
};

/// Joints of its skin that a vertex follows: one, and partly another.
struct JointShare {
    std::uint8_t joint = 0, other = 0;
    float of_other = 0.0f;
};

/// One primitive of a mesh.
struct PartSpec {
    const Shape& shape;
    std::uint32_t material;
    std::span<const JointShare> joints = {};  // per vertex; or none at all
};

/// A joint is a node that stands unturned at `rest_m`, in the mesh's space, when nothing moves.
struct JointSpec {
    std::uint32_t node = 0;
    glm::dvec3 rest_m{0.0};
};

/// Motion of a node: "translation" or "rotation" (x, y, z, w), a value per key, linear in between.
struct ChannelSpec {
    std::uint32_t node = 0;
    std::string path;
    std::uint32_t times = 0;  // result of add_times()
    std::vector<float> values = {};
};

/// Cone of a spot: half angles, radians.
struct ConeSpec {
    double inner_rad = 0.0, outer_rad = 0.785398163;
};

/// Light of KHR_lights_punctual: directional, point, or spot with a cone.
struct LightSpec {
    std::string type;
    glm::dvec3 colour{1.0};
    double intensity = 1.0;
    std::optional<ConeSpec> cone = {};
    double range_m = 0.0;  // 0: without an end
};

/// Perspective camera without an end.
struct CameraSpec {
    std::string name;
    double fov_y_rad = 0.9, near_m = 0.1;
};

struct NodeSpec {
    std::string name;
    std::optional<std::uint32_t> parent = {};  // result of add_node(); empty: below the root
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    std::optional<std::uint32_t> mesh = {}, light = {}, camera = {};
    nlohmann::ordered_json extras = {};  // null: none
};

struct RootSpec {
    std::string name;
    glm::dvec3 translation_m{0.0};
    double scale = 1.0;
};

/// Collects a scene and writes it as binary glTF 2.0 with one buffer. Same calls, same bytes.
class GlbBuilder {
public:
    GlbBuilder();
    ~GlbBuilder();
    GlbBuilder(const GlbBuilder&) = delete;
    GlbBuilder& operator=(const GlbBuilder&) = delete;

    std::uint32_t add_texture(const std::string& name, std::span<const std::uint8_t> png);
    std::uint32_t add_material(const MaterialSpec& spec);
    std::uint32_t add_mesh(const std::string& name, std::span<const PartSpec> parts);
    std::uint32_t add_mesh(const std::string& name, const Shape& shape, std::uint32_t material);
    std::uint32_t add_light(const LightSpec& spec);
    std::uint32_t add_camera(const CameraSpec& spec);
    std::uint32_t add_skin(const std::string& name, std::span<const JointSpec> joints);
    std::uint32_t add_times(std::span<const float> times_s);  // rising
    void add_animation(const std::string& name, std::span<const ChannelSpec> channels);
    std::uint32_t add_node(const NodeSpec& spec);
    /// Sets the skin of a node that was added before it.
    void set_skin(std::uint32_t node, std::uint32_t skin);

    /// Returns the file. Makes every node without a parent a child of one root.
    std::vector<std::byte> finish(const RootSpec& root);

    std::uint64_t triangle_count() const { return triangles_; }  // over all nodes with a mesh

private:
    int add_view(std::span<const std::byte> bytes, int target = 0);  // target 0: none
    int add_accessor(int view, int component_type, std::size_t count, int type);
    int add_floats(std::span<const float> numbers, std::size_t width, int type);

    std::unique_ptr<tinygltf::Model> model_;
    std::vector<int> top_nodes_;
    std::vector<std::uint64_t> mesh_triangles_;
    std::uint64_t triangles_ = 0;
};

}  // namespace gnomon::game
