#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "systems/extract/snapshot.h"

/// Ray-traced truth about shadows, from the same world the pictures are made from.
namespace gnomon::oracle {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// A triangle of a scene, by what it is of.
struct PlacedTriangle {
    std::uint32_t instance = kNoTriangle;  // index into the snapshot's; kNoTriangle: there is none
    std::uint32_t triangle = kNoTriangle;  // of its mesh: its corners are indices[3 * triangle] and the next two
    bool exists() const { return instance != kNoTriangle; }
    bool operator==(const PlacedTriangle&) const = default;
};

/// The surface seen at each pixel centre, rows bottom to top.
struct PrimaryHits {
    glm::uvec2 size_px{0, 0};
    glm::dvec3 camera_rel_m{0.0};            // relative to the tracer's origin, as all positions here
    std::vector<std::uint32_t> triangle;     // the tracer's triangle number; kNoTriangle: no surface
    std::vector<glm::dvec3> position_rel_m;  // in double, on the triangle's plane
    std::vector<glm::dvec3> normal_ws;       // unit, geometric, on the side that is seen
    std::size_t count() const { return triangle.size(); }
};

/// What one light does to the surfaces of a PrimaryHits, one value per pixel.
struct LightTruth {
    std::vector<float> visibility;     // as --visibility: -1 no surface; 0 facing away, out of reach or shadowed; 1 lit
    std::vector<std::uint8_t> scored;  // the set F: surfaces within reach with cos(normal, light) > kMinCosine
    std::vector<std::uint8_t> ambiguous;  // scored, and the answer changes when P moves by kJitter of its distance
};

struct SoftTruth;  // soft_truth.h
struct SourceSampling;

inline constexpr double kMinCosine = 1.0e-4;  // below it shading is nothing, so visibility decides nothing
inline constexpr double kJitter = 1.0e-6;     // about 6 times the error of a position rebuilt from float depth

/// Embree finds candidate triangles, double arithmetic decides. Every triangle is an Embree user primitive with a box
/// that is padded by more than float traversal and float rays can be off, so no candidate is lost; whether the ray
/// meets it is decided by the watertight test in triangle_test.h on vertices computed in double.
/// A shadow ray starts at P itself. It cannot meet the triangle that P lies on, which is left out by its number, nor
/// any triangle whose plane holds P to within the rounding of double (a line meets a plane once): this is how
/// neighbours across a flat edge and coincident layers are told from occluders, without an offset along the ray.
/// A lamp in a triangle's plane, to the same rounding, stands on its front: it lights what lies before the plane, and
/// where the lamp is on the triangle itself, nothing behind it.
class ReferenceTracer {
public:
    /// Everything is held relative to `origin_ws_m`: choose it near the camera. Instances that name unknown meshes,
    /// triangles that are degenerate or not finite, and blended materials do not exist for the tracer.
    /// `library` must outlive the tracer. threads 0: one per core.
    ReferenceTracer(const SceneSnapshot& snapshot, const assets::MeshLibrary& library, const glm::dvec3& origin_ws_m,
                    unsigned threads = 0);
    ~ReferenceTracer();
    ReferenceTracer(const ReferenceTracer&) = delete;
    ReferenceTracer& operator=(const ReferenceTracer&) = delete;

    /// Nearest front face (any face of double-sided materials) of visible instances through each pixel centre, between
    /// near and far plane. Masked texels are looked through.
    PrimaryHits trace_primary(const ConsumerItem& consumer) const;

    /// One shadow ray per surface in reach. Both faces of casters of the light's layers block; masked texels do not.
    /// Surfaces of instances that do not receive its shadows are lit where they face the light within its reach.
    /// `with_ambiguous` costs up to four more rays per scored pixel; without it the flags are all 0.
    LightTruth trace_light(const PrimaryHits& hits, const LightItem& light, bool with_ambiguous) const;

    /// trace_light's visibility alone.
    std::vector<float> visibility(const PrimaryHits& hits, const LightItem& light) const;
    /// trace_light's ambiguous flags alone.
    std::vector<std::uint8_t> ambiguous(const PrimaryHits& hits, const LightItem& light) const;

    /// What each surface sees of the light's source, a disk around its middle that faces the surface: the fraction of
    /// rays to it that pass, of those that leave the surface. Casters and receivers as in trace_light.
    SoftTruth trace_source(const PrimaryHits& hits, const LightItem& light, const SourceSampling& sampling) const;

    /// A caster's triangle between the light and a point on the plane of `triangle`, inside of it or beyond its
    /// borders, at least `least_m` from the point, or kNoTriangle. Range and cone aside.
    std::uint32_t blocker(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light,
                          double least_m) const;
    bool blocked(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light, double least_m) const {
        return blocker(point_rel_m, triangle, light, least_m) != kNoTriangle;
    }

    /// Whether what is seen at that place of the picture lies on the plane of `triangle`.
    bool sees_plane(const ConsumerItem& consumer, const glm::dvec2& at_px, std::uint32_t triangle) const;

    std::size_t triangle_count() const;
    /// What a triangle number means to others; of kNoTriangle: nothing.
    PlacedTriangle source_of(std::uint32_t triangle) const;

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace gnomon::oracle
