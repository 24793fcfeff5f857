#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/gl/commands.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/index_range.h"

namespace gnomon::shadow {

/// Faces of casters that a draw shows.
enum class DrawnFaces : std::uint8_t {
    both,
    one_side,          // the other side is culled
    one_side_mirrored  // likewise, of mirrored instances, which wind the other way
};
inline constexpr std::size_t kDrawnFaces = 3;

/// Instance of a draw, as shaders/shadow/passes/depth/depth.vert reads it.
struct DepthItem {
    std::uint32_t instance = 0;
    std::uint32_t place = 0;  // layer, and above its three bits the first triangle of the draw
    bool operator==(const DepthItem&) const = default;
};

/// Draws of depth passes, gathered before they are recorded. Draws that need the same state are neighbours, in a batch:
/// one command makes them all. A group is drawn before any draw of a later one. Its batches come in the order of
/// DrawnFaces; masked ones follow by material, then those from buffers of engines. Within a batch, draws keep the order
/// of the casters, because at equal depths the first one drawn stays.
class DepthDraws {
public:
    /// Bits of DepthItem::place for the layer.
    static constexpr std::uint32_t kLayerBits = 3;
    /// First triangle of draws with unknown triangles; twin in shaders/shadow/passes/depth/shown_triangle.glsl.
    static constexpr std::uint32_t kNoTriangle = ~0u >> kLayerBits;

    /// How a view draws its casters.
    struct Way {
        bool triangles = false;  // items name the first triangle of their draw: each draw has items of its own
        bool sheets = false;     // conservative map: no masked casters, and both faces
        bool culls = false;      // one side of a solid is enough
        bool parallel = false;   // rays of light; false: they start at apex_ws_m
        glm::dvec3 apex_ws_m{0.0};
    };
    /// Casters to be drawn, as indices into the scene's instances. Casters that are drawn as one mesh are neighbours.
    struct Casters {
        std::span<const std::uint32_t> instances;
        std::span<const std::uint32_t> layers;  // one per caster; empty: 0
        std::span<const std::uint32_t> meshes;  // that each caster is drawn as; empty: its own

        /// Returns the casters [first, end).
        Casters part(std::size_t first, std::size_t end) const {
            const auto of = [&](std::span<const std::uint32_t> all) {
                return all.empty() ? all : all.subspan(first, end - first);
            };
            return {of(instances), of(layers), of(meshes)};
        }
    };
    /// Draws with the same state.
    struct Batch {
        DrawnFaces faces = DrawnFaces::both;
        const MaterialInfo* mask = nullptr;         // material of masked draws; null: opaque
        const EngineMesh* engine = nullptr;         // a mesh in the buffers that the draws read; null: the scene's
        IndexRange draws;                           // into records()
        std::uint64_t end_index = 0, end_item = 0;  // as in gl::DrawMeshesIndirect
        std::uint64_t triangles = 0;                // number over its draws and instances
    };

    void clear();
    /// Adds casters to the group that is open.
    void add(const SceneSnapshot& scene, const GpuScene& gpu, const Way& way, const Casters& casters);
    /// Ends the group, and returns its batches; the next add() begins another one.
    IndexRange end_group();

    std::span<const Batch> batches(IndexRange range) const { return slice(batches_, range); }
    std::span<const DepthItem> items() const { return items_; }
    std::span<const gl::MeshDrawRecord> records() const { return records_; }
    /// Returns the number of triangles that proxies saved in the group that ended last.
    std::uint64_t saved_triangles() const { return saved_; }

private:
    struct Masked {
        const MaterialInfo* material;
        gl::MeshDrawRecord record;
        std::uint32_t order;
    };
    struct FromEngine {
        const EngineMesh* mesh;
        gl::MeshDrawRecord record;
    };
    void add_several(const SceneSnapshot& scene, const GpuScene& gpu, const Way& way, const Casters& run,
                     std::uint32_t mesh);
    void add_items(const SceneSnapshot& scene, const Casters& run, std::uint32_t first_triangle);
    Batch& begin_batch(DrawnFaces faces);
    void append(Batch& batch, std::span<const gl::MeshDrawRecord> records);

    std::vector<DepthItem> items_;
    std::vector<gl::MeshDrawRecord> records_;
    std::vector<Batch> batches_;
    std::uint32_t first_batch_ = 0;  // start of the open group
    std::uint64_t saved_ = 0, open_saved_ = 0;
    std::array<std::vector<gl::MeshDrawRecord>, kDrawnFaces> opaque_;
    std::vector<Masked> masked_;
    std::vector<FromEngine> engines_;
    std::vector<DrawnFaces> faces_;     // one per caster of a mesh
    std::vector<std::uint32_t> order_;  // the same casters, by faces
};

}  // namespace gnomon::shadow
