#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bench/accuracy/rasterised_triangle_ids.h"
#include "systems/frame.h"

/// The judge judged: whether the truth that `accuracy` holds pictures against is one.
///
/// Two ways answer whether a light reaches what a pixel shows. oracle::ReferenceTracer, which all figures rest on,
/// takes candidates from Embree; visibility::LightQueries walks trees of its own with a watertight test of its own.
/// They share no code. And the surface that a ray finds in a pixel is compared with the one that the rasteriser drew
/// there.
namespace gnomon::bench {

/// Shares that an audit may not exceed: of compared pixels of one light; of pixels that show a surface.
inline constexpr double kMostDisagreeing = 1.0e-5, kMostOtherSurface = 5.0e-4;

/// A pixel for which the two ways do not agree. (0, 0) is the lowest row's first.
struct ShadowDisagreement {
    glm::uvec2 at_px{0, 0};
    glm::dvec3 point_ws_m{0.0};
    oracle::PlacedTriangle surface;   // what the pixel shows
    oracle::PlacedTriangle occluder;  // what the tracer says stands in the way, if it says so
    bool traced_lit = false, asked_lit = false;
};

struct AuditedLight {
    std::string name;
    LightKind kind = LightKind::point;
    std::size_t compared_px = 0;   // scored, not ambiguous, of the triangle that was drawn
    std::size_t ambiguous_px = 0;  // left out: the tracer's answer changes when the point moves by oracle::kJitter
    std::size_t ambiguous_disagreeing_px = 0;  // of those
    std::vector<ShadowDisagreement> disagreements;
};
double disagreeing_share(const AuditedLight& light);

/// A pixel in which ray and rasteriser see different triangles, or one of them sees none: nothing is compared there.
struct OtherTriangle {
    glm::uvec2 at_px{0, 0};
    oracle::PlacedTriangle drawn, traced;
    /// Both lie in one plane, to what a picture's depths can tell: a coincident surface, or the other half of a flat
    /// one. Which of them is seen hangs on nothing; place and normal, and so the truth, are the same. Not bounded.
    bool in_one_plane = false;
};

/// Of one picture, every light of its scene.
struct Audit {
    std::string scene, camera, device;
    glm::uvec2 size_px{0, 0};
    std::size_t surface_px = 0;  // pixels that show a surface, to either
    std::vector<OtherTriangle> other_triangles;
    std::vector<AuditedLight> lights;
};
/// Of the pixels whose two triangles do not lie in one plane.
double other_surface_share(const Audit& audit);
/// Whether no share is above its bound.
bool is_sound(const Audit& audit);

/// The last picture of `frame`, which must have been drawn on `device` from `library`. `traced`: the frame's own
/// snapshot; another one shows what an unsound audit looks like. Source sizes do not count: a light is its middle.
/// Errors: "bench.camera" if there is no camera; those of drawn_triangles().
Result<Audit> audit_frame(gl::Device& device, const Frame& frame, const assets::MeshLibrary& library,
                          const SceneSnapshot& traced);

/// A table for people: every disagreement is a line of its own, of other triangles the first few.
std::string audit_table(const Audit& audit);
/// All of them together: pictures, lights, pixels, shares.
std::string audit_summary(const std::vector<Audit>& audits);
/// Everything, for scripts: bench/README.md lists the keys.
std::string audit_json(const std::vector<Audit>& audits);

}  // namespace gnomon::bench
