#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <string>
#include <vector>

#include "bench/glsl_on_cpu/cpu_lookup.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/area_flicker.h"
#include "tests/oracle/reference_tracer.h"

/// Points of the world beside shadows' edges, and the pixels that show them along a path.
namespace gnomon::bench {

struct WatchedLight {
    std::uint32_t light = 0;           // index into the snapshot's lights
    std::vector<SurfacePoint> points;  // beside edges of its shadows
};

/// A frame of a path.
struct PathFrame {
    ConsumerItem pose;
    glm::dvec2 jitter_px{0.0};  // from a pixel's centre to the place that it shows
};

inline constexpr std::size_t kNoPixel = std::numeric_limits<std::size_t>::max();

/// One light's points in each frame.
struct WatchedFrames {
    std::vector<std::vector<std::size_t>> pixels;  // pixel that shows the point; kNoPixel: none
    std::vector<std::vector<oracle::WatchedTruth>> truth;
};

/// Finds up to `count` points, evenly over all pixels that an edge crosses and their neighbours.
std::vector<SurfacePoint> points_beside_edges(const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits,
                                              const ConsumerItem& camera, const glm::dvec3& origin_ws_m,
                                              const LightItem& light, std::uint32_t count);

/// Traces what each point's pixel shows in each frame, and the lit share of its area. Outer: as `lights`.
std::vector<WatchedFrames> trace_watched(const oracle::ReferenceTracer& tracer, const SceneSnapshot& scene,
                                         const glm::dvec3& origin_ws_m, const std::vector<WatchedLight>& lights,
                                         const std::vector<PathFrame>& frames, std::uint32_t area_side);

/// Returns the median way of all points in the picture between two poses, pixels; 0 without points.
double median_way_px(const std::vector<WatchedLight>& lights, const ConsumerItem& from, const ConsumerItem& to);

}  // namespace gnomon::bench
