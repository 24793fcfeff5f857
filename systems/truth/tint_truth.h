#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "systems/truth/light_truth.h"

/// True colours in which translucent casters let a light's middle through, by rays in double.
namespace gnomon::truth {

/// Values per pixel, rows bottom to top.
struct TintTruth {
    std::vector<glm::vec3> passed;     // share of light per channel; 1: nothing translucent in the way, or not scored
    std::vector<std::uint8_t> scored;  // as LightTruth::scored, on surfaces that receive shadows of the light
    /// Resizes for a picture without any surface.
    void reset(std::size_t pixels);
};

/// Traces some rows. `light`: from as_point(). `trees`: of the scene, with TreesOf::translucent. Several threads may
/// trace different rows.
///
/// Each triangle that a ray crosses multiplies, in any order, an edge of two as one of both. Opaque casters do not
/// count.
void trace_tint_rows(const SceneSnapshot& scene, const LightItem& light, const SeenSurfaces& seen, RowRange rows,
                     const visibility::CasterTrees& trees, TintTruth& truth);

/// How far drawn colours are off, as shares of full light. Means are sums until finish().
struct TintMetrics {
    std::size_t scored = 0, tinted = 0;  // tinted: by the truth
    std::size_t beyond = 0;              // any channel is off by more than 1/255
    double mean_error = 0.0;             // over all scored pixels and channels
    double tinted_error = 0.0;           // over tinted pixels and channels; 0 without
    double max_error = 0.0;              // largest of any channel
    /// Adds a pixel. `off`: distance of each channel from the truth.
    void add(const glm::dvec3& off, bool is_tinted);
    void finish();
};

/// Compares `measured`, as Frame::read_tint() reads it, where `light` is scored and sends light. Fills `off` with the
/// channel that is off most, per pixel: above 0 too bright. 0: not compared.
TintMetrics compare_tint(std::span<const glm::vec4> measured, const TintTruth& truth, const LightTruth& light,
                         std::vector<float>& off);

}  // namespace gnomon::truth
