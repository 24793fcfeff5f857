#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "components/transform.h"
#include "engine/assets/scene_data.h"
#include "engine/math/aabb.h"

/// What lies between a lamp and a point, asked of the scene's own triangles on the CPU.
namespace gnomon::game {

/// The shadow casters of a scene. Copies what it needs: the scene may go afterwards.
/// Alpha masks are looked up at the nearest texel; blended surfaces let light through, and so does who walks about:
/// nobody hides behind a mesh that bends.
class Occluders {
public:
    /// `left_out`: nodes that never block, e.g. the player's own body.
    Occluders(const assets::SceneData& scene, std::span<const std::int32_t> left_out);

    /// Puts every caster where its node is now. `poses`: one per node of the scene.
    void place(std::span<const WorldTransform> poses);

    /// Whether any caster crosses the open segment. place() must have been called.
    bool blocked(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m) const;

private:
    struct Mask {
        std::uint32_t width = 0, height = 0;
        std::vector<bool> opaque;
    };
    struct Triangle {
        glm::dvec3 corner, edge_1, edge_2;
        std::array<glm::dvec2, 3> uvs;
        std::int32_t mask = assets::kNone;
        math::Aabb box() const;
    };
    /// Node of a bounding volume tree: inner ones have count 0 and children at `first` and `first` + 1.
    struct Branch {
        math::Aabb box = {};
        std::uint32_t first = 0, count = 0;
    };
    struct Shape {
        std::vector<Triangle> triangles;
        std::vector<Branch> branches;
    };
    struct Caster {
        std::size_t node = 0, shape = 0;
        math::Aabb box_ws = {};
        glm::dmat3 local_from_ws{1.0};
        glm::dvec3 origin_ws_m{0.0};
    };

    void add_masks(const assets::SceneData& scene);
    void add_shape(const assets::Mesh& mesh);
    static void split(Shape& shape, std::uint32_t branch);
    bool crosses(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& along) const;
    bool crosses(const Shape& shape, const glm::dvec3& from, const glm::dvec3& along) const;

    std::vector<std::int32_t> mask_of_material_;
    std::vector<bool> material_blocks_;
    std::vector<Mask> masks_;
    std::vector<Shape> shapes_;
    std::vector<Caster> casters_;
};

}  // namespace gnomon::game
