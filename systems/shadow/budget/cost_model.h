#pragma once
#include <cstdint>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/request/filter_table.h"

/// What a light's shadow takes of a budget, and what is lost by giving it less: a model, the same for the same input.
namespace gnomon::shadow {

/// Below, a shadow says little more than that there is one.
inline constexpr std::uint32_t kLeastGranted_px = 64;

/// Nanoseconds by kind of work, of a GPU of the middle class: where measurements start from (CostFactors). Only their
/// ratios decide who is given less; their scale decides when. They follow from such a GPU's data sheet (192 GB/s of
/// memory, 1.7 GHz, two triangles a clock, 80 texture units, 4.4 TFLOPS), not from measurements of one:
/// - a pass waits for the one before to leave the chip, and clears: some 5 µs between two targets;
/// - a draw takes the driver and the front end 1 µs;
/// - a triangle takes 0.3 ns where nothing but its set-up counts, and three vertices of 32 bytes 0.5 ns of memory: 1
/// ns;
/// - a texel is 4 bytes, cleared or written, by way of memory: 4 B / 192 GB/s;
/// - a fetch lies between the texture units' 0.007 ns and a sector of 32 bytes of its own, 0.17 ns;
/// - a lit pixel reads 20 bytes of surfaces and blends 16: 0.2 ns, and some 1000 operations: another 0.25 ns.
/// `./gnomon bench budget` measures the same six on a device (docs/economy.md, "Budgets").
inline constexpr double kPass_ns = 5000.0, kDraw_ns = 1000.0, kTriangle_ns = 1.0, kTexel_ns = 0.02;
inline constexpr double kFetch_ns = 0.1, kShadedPixel_ns = 0.5;

/// Measured over modelled time, by kind of work (CostClock).
struct CostFactors {
    double drawing = 1.0, lighting = 1.0;
    bool operator==(const CostFactors&) const = default;
};

/// One light that would have a map.
struct LightLoad {
    const LightItem* light = nullptr;
    ShadowRequest wanted;     // what it asks for; resolution_px is the edge that it needs
    std::uint64_t key = 0;    // of the light itself, wherever it stands in a list: decides between equals
    double weight = 0.0;      // what its shadow means to the picture, 0 to 1
    double extent_px = 0.0;   // of a texel on screen (error_bound.h), with maps as wanted
    double activity = 0.0;    // share of its views that are drawn in a frame, 0 to 1
    double pixels = 0.0;      // that look it up
    std::uint32_t views = 0;  // of its map that are fitted
    std::uint64_t triangles = 0, draws = 0;  // of drawing them all; may be 0 where nothing is drawn
};

struct Cost {
    std::uint64_t bytes = 0;
    std::uint64_t ns = 0;  // per frame
    double harm = 0.0;     // share of the picture that is wrong, by the model; 0: all is as asked for
};

/// The request as the grant leaves it; that of Grant::none is unchanged.
ShadowRequest granted(const LightItem& light, const ShadowRequest& wanted, const Grant& grant);

/// Returns in one frame of how many a view of the light is drawn whose casters alone changed.
std::uint32_t refresh_frames(const LightItem& light, const Grant& grant);

/// Whether it gives that request less than it asks for.
bool is_less(const LightItem& light, const ShadowRequest& wanted, const Grant& grant);

Cost cost_of(const LightLoad& load, const Grant& grant, const CostFactors& factors);

/// Of that, in nanoseconds, what looking it up takes.
double lookup_ns(const LightLoad& load, const Grant& grant, const CostFactors& factors);

/// Of a light's weight, what is lost by edges that are so much farther off than they might be.
double edge_harm(double rise_px);

/// Fetches of a lookup by the filter, on the average of its pixels.
double mean_fetches(const LightItem& light, const ShadowRequest& request, ShadowFilter filter);

/// What drawing a view once would draw.
struct DrawCounts {
    std::uint64_t triangles = 0, draws = 0;
};
/// `casters`: of one view, by mesh.
DrawCounts count_draws(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters);

/// Computes the time of drawing, ns. `triangles` and `draws` count each caster DrawingWork::casters times. The two
/// passes of a blur of moments are added.
double drawing_ns(const MapSettings& map, std::uint32_t edge_px, double views, double triangles, double draws);

}  // namespace gnomon::shadow
