#pragma once
#include <cstdint>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// Model of a light's cost in memory and time, and of the error cost of limiting its quality. Pure: equal inputs give
/// equal results.
namespace gnomon::shadow {

/// Smallest map edge that a budget leaves, texels. Below, a shadow shows little more than that it exists.
inline constexpr std::uint32_t kLeastGranted_px = 64;

/// Time per unit of work on a GPU of the middle class, ns: the starting point of measurements (CostFactors). Only the
/// ratios decide which light is limited; the scale decides when. The numbers follow from a data sheet (192 GB/s of
/// memory, 1.7 GHz, two triangles a clock, 80 texture units, 4.4 TFLOPS), not from measurements:
/// - A pass takes 5 µs: the pass before it has to leave the chip, and its target is cleared.
/// - A draw takes the driver and the front end 1 µs.
/// - A triangle takes 1 ns: 0.3 ns where only its set-up counts, 0.5 ns of memory for three vertices of 32 bytes.
/// - A texel is 4 bytes, cleared or written, by way of memory: 4 B / 192 GB/s.
/// - A fetch lies between the texture units' 0.007 ns and a sector of 32 bytes of its own, 0.17 ns.
/// - A lit pixel reads 20 bytes of surfaces and blends 16, 0.2 ns. Some 1000 operations take another 0.25 ns.
///
/// `./gnomon bench budget` measures the same six on a device (docs/explanation/budgets.md).
inline constexpr double kPass_ns = 5000.0, kDraw_ns = 1000.0, kTriangle_ns = 1.0, kTexel_ns = 0.02;
inline constexpr double kFetch_ns = 0.1, kShadedPixel_ns = 0.5;

/// Measured over modelled time, by kind of work (CostCalibration).
struct CostFactors {
    double drawing = 1.0, lighting = 1.0;
    bool operator==(const CostFactors&) const = default;
};

/// One light that would have a map.
struct LightLoad {
    const LightItem* light = nullptr;
    ShadowRequest wanted;     // request without limits; resolution_px is the edge that it needs
    std::uint64_t key = 0;    // hash of the light itself, independent of its place in a list: decides between equals
    double weight = 0.0;      // weight of its shadow in the frame image, 0 to 1
    double extent_px = 0.0;   // extent of a texel on screen (error_bound.h), with maps as wanted
    double activity = 0.0;    // share of its views that are drawn in a frame, 0 to 1
    double pixels = 0.0;      // number of pixels that look it up
    std::uint32_t views = 0;  // number of fitted views
    /// All maps shrink to kLeastGranted_px before its filter, its updates or its shadow go: the automatic limit.
    bool sizes_first = false;
    std::uint64_t triangles = 0, draws = 0;  // work of drawing all views; may be 0 if none is drawn
};

struct Cost {
    std::uint64_t bytes = 0;
    std::uint64_t ns = 0;  // per frame
    double harm = 0.0;     // share of the image that is wrong, by the model; 0: all as requested
};

/// Returns the interval, in frames, at which a view of the light is drawn if only its casters changed.
std::uint32_t refresh_frames(const LightItem& light, const QualityLimits& grant);

Cost cost_of(const LightLoad& load, const QualityLimits& grant, const CostFactors& factors);

/// Returns the lookup part of the cost, ns.
double lookup_ns(const LightLoad& load, const QualityLimits& grant, const CostFactors& factors);

/// Returns the share of a light's weight that is lost when edges are `rise_px` less accurate, 0 to 1/2.
double edge_error_cost(double rise_px);

/// Returns the mean number of fetches per lookup with the filter.
double mean_fetches(const LightItem& light, const ShadowRequest& request, ShadowFilter filter);

/// Work of drawing a view once.
struct DrawCounts {
    std::uint64_t triangles = 0, draws = 0;
};
/// Counts the triangles and draws of one view's casters, sorted by mesh.
DrawCounts count_draws(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters);

/// Returns the time of drawing `views` views, ns. `triangles` and `draws` count each caster DrawingWork::casters times.
/// The two passes of a blur of moments are added.
double drawing_ns(const MapSettings& map, std::uint32_t edge_px, double views, double triangles, double draws);

}  // namespace gnomon::shadow
