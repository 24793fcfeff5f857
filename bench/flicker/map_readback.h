#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "bench/glsl_on_cpu/cpu_lookup.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"

namespace gnomon::bench {

/// The frame of systems/frame.cpp up to the depth passes: no picture is made, so that its size costs nothing. Starts
/// without a history. One per stage at a time.
class ShadowFrames {
public:
    /// Errors: "gpu.scene".
    static Result<std::unique_ptr<ShadowFrames>> create(Stage& stage);

    /// Draws the maps for the first active camera placed as `consumer`, and reads those back that were drawn. Maps of
    /// filters that knows_filter() denies are not read.
    /// Error: "bench.map" if a map cannot be drawn or read.
    std::optional<Error> run(const ConsumerItem& consumer);
    std::optional<Error> run();  // with the camera as it is

    const SceneSnapshot& snapshot() const { return snapshot_; }
    const shadow::ShadowFrame& frame() const { return shadows_.frame(); }
    const FrameReport& report() const { return report_; }
    /// Returns the light's lookup in double, valid until the next run; null if its row is not known. Filters that read
    /// triangles get bending meshes at rest.
    std::unique_ptr<ExactLight> exact_light(std::uint32_t light) const {
        return make_exact_light(frame(), snapshot_, light, maps_[light].copy, caster_triangles_);
    }

private:
    ShadowFrames(Stage& stage, GpuScene scene);
    struct ReadMap {
        gl::TextureHandle texture{};
        MapCopy copy;
        std::vector<std::uint32_t> packed_triangles;  // as copy.triangles, where texels name theirs by one number
    };
    std::optional<Error> read_maps();
    bool read_layer(const shadow::ShadowView& view, const shadow::MapAssignment& assigned, bool reuse, ReadMap& map);

    Stage& stage_;
    GpuScene gpu_scene_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    shadow::ShadowSystem shadows_;
    FrameReport report_;
    gl::CommandList commands_;
    std::vector<ReadMap> maps_;  // one per light
    CasterTriangleList caster_triangles_;
};

/// Points spread over the surfaces that a camera sees at `stations` places of its path, on receivers of shadow.
/// Deterministic. Fewer than `count` if the camera sees little.
std::vector<SurfacePoint> surface_points(const SceneSnapshot& scene, const assets::MeshLibrary& library,
                                         std::span<const ConsumerItem> stations, std::uint32_t count);

/// Returns the median distance along the view of what the camera sees; 1 if it sees nothing.
double seen_distance_m(const SceneSnapshot& scene, const assets::MeshLibrary& library, const ConsumerItem& consumer);

/// Returns whether the point is within the light's reach and faces it, so that only casters can darken it.
bool shines_on(const LightItem& light, const SurfacePoint& point);

}  // namespace gnomon::bench
