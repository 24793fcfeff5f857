#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"
#include "tests/oracle/area_truth.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/soft_truth.h"

namespace gnomon::bench {

struct TracedLight {
    std::uint32_t index = 0;  // into the snapshot's lights
    std::string name;
    LightKind kind = LightKind::point;
    oracle::LightTruth point;                  // ambiguous as well where other_surfaces() are
    std::optional<std::size_t> other_surface;  // scored pixels that are left out for that alone; empty: not known
    oracle::SoftTruth disk;                    // truth about disk_source(); empty: not computed
    oracle::AreaTruth area;                    // lit share of pixels' areas, of a point; empty: not computed
};

/// Returns whether a pixel is scored, and `measured` is on the other side of half lit than the truth. Below 0 or NaN:
/// no surface was measured.
bool is_wrong(const TracedLight& light, std::size_t pixel, float measured);

/// Truth that every row is compared with: of a scene that stands still, traced once.
struct TracedTruths {
    std::unique_ptr<oracle::ReferenceTracer> tracer;
    oracle::PrimaryHits hits;
    std::vector<std::uint8_t> creases;  // oracle::creases(hits)
    std::vector<TracedLight> lights;    // lights with a LightShadow
    double trace_s = 0.0;
    std::vector<std::uint32_t> indices() const;  // indices of the lights
};

struct TruthOptions {
    bool disks = false;           // sources with a size as well; leaves the lights with disk_source()
    std::uint32_t area_side = 0;  // oracle::AreaSampling::side; 0: no areas
};

/// Traces a still scene. Errors: "bench.camera", "set.*".
Result<TracedTruths> trace_truths(Stage& stage, const TruthOptions& options = {});

}  // namespace gnomon::bench
