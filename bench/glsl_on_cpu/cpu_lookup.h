#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {

/// A map as it was read back: rows bottom first, layer after layer (cube: six faces).
struct MapCopy {
    bool is_cube = false;
    std::uint32_t size_px = 0;
    std::vector<float> texels;
    std::vector<glm::uvec2> triangles;  // instance and triangle of each, if the filter reads them; else empty
};

struct SurfacePoint {
    glm::dvec3 position_ws_m{0.0}, normal_ws{0.0, 1.0, 0.0};  // unit, on the lit side
};

/// Returns whether the filter's lookups are compiled in. Lookups of moments are not, since passes of their own make
/// these of the map; nor are filters without a map.
inline bool knows_filter(const shadow::FilterRow& row) { return !row.moments && !row.rays; }

/// Result of the shader's lookup for one point.
struct ExactVisibility {
    float value = 1.0f;
    std::uint8_t layers = 0;  // bit per layer that was looked up; a cube counts as one; 0: no map contains the point
    bool on_edge = false;     // some tap lies within kEdge_texel of a texel border, or of a depth tie
    std::uint16_t taps = 0;   // texture fetches
    bool operator==(const ExactVisibility&) const = default;
};

/// Nearer than this, in texels, to a place where a tap changes its mind, the last digits decide.
inline constexpr double kEdge_texel = 1.0 / (1 << 10);

/// One light's lookup, shaders/shadow's own text in double: no rounding but the map's and the matrices', which are what
/// was drawn. Points are exact, so nothing is allowed for a surface buffer's rounding (error_m is 0).
class ExactLight {
public:
    virtual ~ExactLight() = default;
    /// Computes one value per point. Points must face the light and be in its reach. Thread-safe.
    virtual void evaluate(std::span<const SurfacePoint> points, std::span<ExactVisibility> values) const = 0;
};

/// Makes the lookup of a light of the snapshot, as the frame published it to its first consumer. A skipped light is
/// lit. `map`: its map after the frame; must outlive the result. `casters`: caster_triangles_of() the scene's library,
/// for filters that read them. Null: the row's files are not compiled in.
std::unique_ptr<ExactLight> make_exact_light(const shadow::ShadowFrame& frame, const SceneSnapshot& scene,
                                             std::uint32_t light, const MapCopy& map,
                                             const CasterTriangleList& casters);

/// Returns the shaders' constant: receivers with a larger tangent toward the light are moved along their normal.
double steep_tangent();

/// Returns by the shaders' text how far a point has faded out of its cascade by its distance along the view, 0 to 1.
/// faded_near_border() returns it for the distance `nearest` to the map's border, a share of the map.
double faded_by_distance(double start_m, double end_m, double distance_m);
double faded_near_border(double nearest, double blend);

}  // namespace gnomon::bench
