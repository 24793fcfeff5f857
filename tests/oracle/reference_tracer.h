#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"

/// Ray-traced truth about shadows, from the same world the pictures are made from.
namespace gnomon::oracle {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// A triangle of a scene, by what it is of.
struct PlacedTriangle {
    std::uint32_t instance = kNoTriangle;  // index into the snapshot's; kNoTriangle: there is none
    std::uint32_t triangle = kNoTriangle;  // in its mesh; its corners are indices[3 * triangle] and the next two
    bool exists() const { return instance != kNoTriangle; }
    bool operator==(const PlacedTriangle&) const = default;
};

/// The surface seen at each pixel centre, rows bottom to top.
struct PrimaryHits {
    glm::uvec2 size_px{0, 0};
    glm::dvec3 camera_rel_m{0.0};            // relative to the tracer's origin, as all positions here
    glm::dvec2 jitter_px{0.0};               // from each pixel's centre to the place that it shows; 0: the centre
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
struct AreaTruth;  // area_truth.h
struct AreaSampling;

inline constexpr double kMinCosine = 1.0e-4;  // below it shading is nothing, so visibility decides nothing
inline constexpr double kJitter = 1.0e-6;     // about 6 times the error of a position rebuilt from float depth

/// Finds candidate triangles by Embree and decides on them in double. Each triangle is a user primitive of Embree.
/// Its box is padded by more than the error of float traversal and float rays, so no candidate is lost.
/// The watertight test in triangle_test.h then decides, on vertices computed in double.
///
/// A shadow ray starts at P itself, without an offset. It skips the triangle that P lies on, by its number.
/// It also skips triangles with P in their plane, to the rounding of double: a line meets a plane once.
/// So neighbours across a flat edge and coincident layers do not occlude P.
///
/// A lamp in a triangle's plane, to the same rounding, counts as on its front. It lights what lies before the plane.
/// Where such a lamp is on the triangle itself, it lights nothing behind it.
class ReferenceTracer {
public:
    /// Stores all positions relative to `origin_ws_m`: choose it near the camera. Instances that name unknown meshes,
    /// triangles that are degenerate or not finite, and blended materials do not exist for the tracer. Surfaces that
    /// transmit light are seen, and block none (tint_truth.h has what they let through).
    /// `library` must outlive the tracer. threads 0: one per core.
    ReferenceTracer(const SceneSnapshot& snapshot, const assets::MeshLibrary& library, const glm::dvec3& origin_ws_m,
                    unsigned threads = 0);
    ~ReferenceTracer();
    ReferenceTracer(const ReferenceTracer&) = delete;
    ReferenceTracer& operator=(const ReferenceTracer&) = delete;

    /// Finds the nearest front face of visible instances through each pixel centre, between near and far plane.
    /// Double-sided materials have two front faces. Masked texels do not count. `jitter_px`: the picture is moved, so
    /// that pixels show what lies there from their centres.
    PrimaryHits trace_primary(const ConsumerItem& consumer, const glm::dvec2& jitter_px = glm::dvec2(0.0)) const;

    /// Casts one shadow ray per surface in reach. Both faces of casters of the light's layers block.
    /// Masked texels do not block.
    /// Surfaces of instances that do not receive its shadows are lit where they face the light within its reach.
    /// `with_ambiguous` costs up to four more rays per scored pixel; without it the flags are all 0.
    LightTruth trace_light(const PrimaryHits& hits, const LightItem& light, bool with_ambiguous) const;

    /// Returns trace_light's visibility alone.
    std::vector<float> visibility(const PrimaryHits& hits, const LightItem& light) const;
    /// Returns trace_light's ambiguous flags alone.
    std::vector<std::uint8_t> ambiguous(const PrimaryHits& hits, const LightItem& light) const;

    /// Computes the fraction of the light's source that each surface sees. The source is a disk around the light's
    /// middle that faces the surface. Only rays that leave the surface count. Casters and receivers: as in trace_light.
    SoftTruth trace_source(const PrimaryHits& hits, const LightItem& light, const SourceSampling& sampling) const;

    /// Computes the share of each pixel's area on the seen surface that the light's middle reaches. `hits`: what
    /// `camera` sees. `middles`: trace_light's result for the light.
    AreaTruth trace_area(const ConsumerItem& camera, const PrimaryHits& hits, const LightTruth& middles,
                         const LightItem& light, const AreaSampling& sampling) const;
    /// Computes the same for these pixels alone, by all places each: a value per entry of `pixels`.
    AreaTruth trace_area(const ConsumerItem& camera, const PrimaryHits& hits, std::span<const std::size_t> pixels,
                         const LightItem& light, const AreaSampling& sampling) const;

    /// Returns a caster's triangle between the light and the point, at least `least_m` from the point, or kNoTriangle.
    /// The point lies on the plane of `triangle`, also beyond its borders. Ignores the light's range and cone.
    std::uint32_t blocker(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light,
                          double least_m) const;
    bool blocked(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light, double least_m) const {
        return blocker(point_rel_m, triangle, light, least_m) != kNoTriangle;
    }

    /// Returns that caster's triangle which is nearest to the light: what a map shows there.
    std::uint32_t nearest_to_light(const glm::dvec3& point_rel_m, std::uint32_t triangle, const LightItem& light,
                                   double least_m) const;

    /// Returns true if the light shines on the side of the triangle from which its corners run counter-clockwise.
    bool faces(std::uint32_t triangle, const LightItem& light) const;

    /// Returns true if the surface at that place of the picture lies on the plane of `triangle`.
    bool sees_plane(const ConsumerItem& consumer, const glm::dvec2& at_px, std::uint32_t triangle) const;

    std::size_t triangle_count() const;
    /// Returns the instance and the mesh's triangle for a tracer's triangle number; none for kNoTriangle.
    PlacedTriangle source_of(std::uint32_t triangle) const;

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace gnomon::oracle
