#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

/// Fits linearly transformed cosines to the specular lobes of shaders/lighting/lights/brdf.glsl (Heitz, Dupuy, Hill and
/// Neubelt, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", 2016).
namespace gnomon::bench {

/// One lobe: the part above the surface of a clamped cosine, turned and stretched. Angle and lengths are shares of
/// alpha.
struct FittedLobe {
    double lean = 0.0;                 // angle from the mirrored direction toward the normal
    double along = 1.0, across = 1.0;  // widths in the plane of normal and viewer, and across it
    double skew = 0.0;                 // how much the lobe's middle is drawn along that plane
    double size = 1.0;                 // integral of what is fitted over the hemisphere, by the share above the surface
    bool operator==(const FittedLobe&) const = default;
};

/// What is fitted: D V cos, or D V cos (1 - v.h)^5, which Schlick's Fresnel term adds.
enum class LobePart : unsigned char { reflected, grazing };

/// Number of entries along roughness and along angle.
inline constexpr std::uint32_t kLobesAcross = 32;

/// Returns alpha of brdf.glsl of a column: roughness is column / (kLobesAcross - 1).
double alpha_of(std::uint32_t column);
/// Returns the cosine to the viewer of a row: sqrt(1 - cosine) is row / (kLobesAcross - 1).
double cosine_of(std::uint32_t row);

/// Returns the part's value for the viewer (-sin, 0, cos), 0 below the surface.
double lobe_at(LobePart part, double alpha, double cosine, const glm::dvec3& toward);
/// Returns the fitted density above the surface; its integral is 1.
double fitted_at(const FittedLobe& lobe, double alpha, double cosine, const glm::dvec3& toward);

/// Fits a lobe. `starts`: lobes of neighbours; a search begins from each, and from a round lobe. Equal input gives
/// equal output.
FittedLobe fit_lobe(LobePart part, double alpha, double cosine, std::span<const FittedLobe> starts);

}  // namespace gnomon::bench
