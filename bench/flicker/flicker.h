#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/frame.h"
#include "gnomon/result.h"

/// Flicker of shadows while only the camera moves. The visibility of fixed points of the world is evaluated in double,
/// from maps that are really drawn. In truth it never changes.
namespace gnomon::bench {

struct StabilityOptions {
    std::uint32_t frames = 300, points = 100000;  // numbers per path
    std::vector<std::string> paths, fits;         // empty: all
};

/// One light under one fit along one path. A pair is a point in view in two frames in a row.
struct PathFlicker {
    std::string path, fit, light, kind;
    std::string reason;                     // why the light has no views in the last frame; empty: it has
    std::uint32_t points = 0;               // points that the light shines on
    std::uint64_t pairs = 0;                // one and the same view decided in both frames
    std::uint64_t flips = 0;                // pairs in which visibility passed 1/2
    std::uint64_t still_flips = 0;          // flips while the view's matrices stayed: must be 0
    std::uint64_t flips_between_steps = 0;  // flips in frames in which the view did not step
    std::uint64_t edge_pairs = 0;           // a tap near a texel's border or a depth tie in either: not in `pairs`
    std::uint64_t edge_flips = 0;           // edge pairs in which visibility passed 1/2
    std::uint64_t crossings = 0;  // other views decide than before, or several together: not in `pairs` either
    std::uint64_t crossing_flips = 0;
    double greatest_jump = 0.0;           // largest change of visibility in one frame, within one view
    double greatest_crossing_jump = 0.0;  // in a crossing, none of the views having stepped
    double greatest_step_jump = 0.0;      // in a crossing, in a frame in which one of the views stepped
    std::uint64_t uncovered = 0;          // points in the picture without a view of the light, summed over frames
    std::uint64_t views = 0;              // summed over the frames after the first
    std::uint64_t views_moved = 0;        // views with other matrices than in the frame before
    std::uint64_t views_stepped = 0;      // views that changed size, direction or depth range, not only by a shift
    std::uint64_t frames_stepped = 0;     // frames with such a view
    std::uint64_t views_drawn = 0;        // views that were drawn
    std::vector<std::uint32_t> flips_by_frame;  // `flips`, `edge_flips` left out; first frame: 0

    double flips_per_point_per_100_frames() const {
        return pairs == 0 ? 0.0 : 100.0 * static_cast<double>(flips) / static_cast<double>(pairs);
    }
};

struct Stability {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    std::uint32_t frames = 0;
    std::vector<PathFlicker> rows;  // by path, then fit, then light
};

/// Returns the words of the setting `fit`; empty if there is no choice.
std::vector<std::string> known_fits();

/// Measures flicker along the paths, under the fits. Errors: "bench.path", "bench.fit" for unknown names;
/// "bench.camera"; "bench.map"; "bench.row" for a light with a lookup that make_exact_light() does not know.
Result<Stability> measure_stability(Stage& stage, const StabilityOptions& options);

/// Returns the meaning of the table's columns, for --help.
std::string stability_legend();
std::string stability_table(const Stability& stability);
std::string stability_json(const Stability& stability);
/// Flips per point against frames, one panel per path and light.
std::string stability_plot(const Stability& stability);

}  // namespace gnomon::bench
