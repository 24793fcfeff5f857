#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bench/accuracy/rasterised_triangle_ids.h"
#include "systems/frame_system.h"

/// Test of the truth that `accuracy` compares pictures with.
///
/// Two methods that share no code compute whether a light reaches the surface in a pixel. oracle::ReferenceTracer,
/// which all figures rest on, takes candidates from Embree. visibility::LightQueries has its own trees and its own
/// watertight test. The surface that a ray finds in a pixel is also compared with the one drawn by the rasteriser.
namespace gnomon::bench {

/// Shares that an audit may not exceed: of compared pixels of one light; of pixels that show a surface.
inline constexpr double kMostDisagreeing = 1.0e-5, kMostOtherSurface = 5.0e-4;

/// A pixel for which the two methods disagree. (0, 0) is the lowest row's first.
struct ShadowDisagreement {
    glm::uvec2 at_px{0, 0};
    glm::dvec3 point_ws_m{0.0};
    oracle::PlacedTriangle surface;   // what the pixel shows
    oracle::PlacedTriangle occluder;  // caster that the tracer found in the way, if any
    bool traced_lit = false, queried_lit = false;
};

struct AuditedLight {
    std::string name;
    LightKind kind = LightKind::point;
    std::size_t compared_px = 0;   // scored, not ambiguous, of the triangle that was drawn
    std::size_t ambiguous_px = 0;  // left out: the tracer's answer changes when the point moves by oracle::kJitter
    std::size_t ambiguous_disagreeing_px = 0;  // ambiguous pixels in which they disagree
    std::vector<ShadowDisagreement> disagreements;
};
double disagreeing_share(const AuditedLight& light);

/// A pixel in which ray and rasteriser see different triangles, or one of them sees none: nothing is compared there.
struct OtherTriangle {
    glm::uvec2 at_px{0, 0};
    oracle::PlacedTriangle drawn, traced;
    /// Both lie in one plane, to the resolution of a picture's depths: coincident surfaces, or two halves of a flat
    /// one. Their place and normal, and so the truth, are the same. No bound applies.
    bool in_one_plane = false;
};

/// Results for one picture and every light of its scene.
struct Audit {
    std::string scene, camera, device;
    glm::uvec2 size_px{0, 0};
    std::size_t surface_px = 0;  // pixels that show a surface, to either
    std::vector<OtherTriangle> other_triangles;
    std::vector<AuditedLight> lights;
};
/// Returns the share of pixels with two triangles that do not lie in one plane.
double other_surface_share(const Audit& audit);
/// Returns whether no share is above its bound.
bool is_sound(const Audit& audit);

/// Audits the last picture of `frame`, which must have been drawn on `device` from `library`. `traced`: the frame's own
/// snapshot; another one shows how an unsound audit looks. Source sizes do not count: a light is its middle.
/// Errors: "bench.camera" if there is no camera; those of drawn_triangles().
Result<Audit> audit_frame(gl::Device& device, const FrameSystem& frame, const assets::MeshLibrary& library,
                          const SceneSnapshot& traced);

/// Returns a table for people, with a line for every disagreement and for the first few other triangles.
std::string audit_table(const Audit& audit);
/// Sums up all audits: pictures, lights, pixels, shares.
std::string audit_summary(const std::vector<Audit>& audits);
/// Returns all results for scripts: bench/README.md lists the keys.
std::string audit_json(const std::vector<Audit>& audits);

}  // namespace gnomon::bench
