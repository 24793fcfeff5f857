#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"
#include "tests/oracle/area_flicker.h"

/// Flicker of shadows' edges in pictures. Fixed points of the world beside edges are watched, frame by frame, in the
/// pixel that shows them. What counts is the change of its visibility that the lit share of its area does not have.
namespace gnomon::bench {

/// The two settings of every light that are compared along the same frames.
using ComparedSettings = std::array<std::string, 2>;

struct EdgeFlickerOptions {
    std::uint32_t frames = 24, points = 1000;  // frames of each path; points per light
    double step_px = 0.3;                      // median way of the points in the picture from frame to frame
    std::uint32_t area_side = 16;              // places along the side of a pixel's area, oracle::AreaSampling
    std::vector<std::string> paths;            // empty: all
    ComparedSettings compared{"antialias=off", "antialias=on"};
};

/// One light along one path. A jitter path is a still camera with the first kJitterPhases places of a sample.
struct EdgeFlicker {
    std::string path, light, kind;
    std::string reason;        // why the light has no shadow; empty: it has
    std::uint32_t points = 0;  // 0: no edge is in view
    std::array<oracle::AreaFlicker, 2> compared;
    /// Returns the second setting's mean over the first's; 0 where the first has none.
    double ratio() const { return compared[0].mean > 0.0 ? compared[1].mean / compared[0].mean : 0.0; }
};

inline constexpr std::uint32_t kJitterPhases = 8;

struct EdgeFlickers {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    EdgeFlickerOptions options;
    std::vector<EdgeFlicker> rows;  // by path, then light
};

/// Returns pan, walk, roll, zoom, jitter.
std::vector<std::string> edge_flicker_paths();

/// Measures along the paths. Points lie at the middles of pixels that an edge crosses at the start, and of their
/// neighbours. A point's pixel is the nearest one, since that is what a viewer sees there. Errors: "bench.path",
/// "bench.camera", "bench.visibility", "bench.samples"; "set.*".
Result<EdgeFlickers> measure_edge_flicker(Stage& stage, const EdgeFlickerOptions& options);

/// Returns the meaning of the table's columns, for --help.
std::string edge_flicker_legend();
std::string edge_flicker_table(const EdgeFlickers& flickers);
std::string edge_flicker_json(const EdgeFlickers& flickers);

}  // namespace gnomon::bench
