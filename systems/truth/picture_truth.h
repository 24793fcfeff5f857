#pragma once
#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "systems/truth/light_truth.h"
#include "systems/truth/seen_surfaces.h"
#include "systems/truth/tint_truth.h"

/// Truth about a picture's shadows: surfaces of the first camera, and the visibility of each shadowed light. A filter
/// is judged by what it shows: the light's middle or all of its source, at pixels' middles or over their areas.
namespace gnomon::truth {

struct TracedLight {
    std::uint32_t light = 0;  // index in the snapshot
    LightTruth truth;         // visibility of its middle
    std::optional<LightTruth> source;  // share of its source; empty for a point
    // The same over pixels' areas, where the middle's is not ambiguous; empty without LightShadow::antialias.
    std::optional<LightTruth> area, source_and_area;
    std::optional<TintTruth> tint;  // colours of its middle; empty: it has no translucent casters, or leaves them out
};

struct PictureTruth {
    SeenSurfaces seen;
    std::vector<TracedLight> lights;  // lights with a LightShadow, in the snapshot's order
};

/// Progress of a trace; any thread may read and write it.
struct TraceState {
    std::atomic<std::uint64_t> done{0}, all{1};  // work in rays per row
    std::atomic<bool> cancelled{false};
    double share() const { return static_cast<double>(done.load()) / static_cast<double>(all.load()); }
};

/// Traces on `threads` threads, including the caller's. Without a camera the result has no surface and no light. If
/// cancelled, the result is incomplete and useless.
PictureTruth trace_picture(const SceneSnapshot& scene, const assets::MeshLibrary& library, unsigned threads,
                           TraceState& state);

/// Runs trace_picture() in the background, on a copy of the scene as it was at the start.
class BackgroundTrace {
public:
    /// Starts the trace. `library` must outlive it.
    BackgroundTrace(SceneSnapshot scene, const assets::MeshLibrary& library, unsigned threads);
    /// Cancels and joins, which takes as long as a few rows.
    ~BackgroundTrace();
    BackgroundTrace(const BackgroundTrace&) = delete;
    BackgroundTrace& operator=(const BackgroundTrace&) = delete;

    double share() const { return state_.share(); }  // completed share of the work, 0 to 1
    bool finished() const { return finished_.load(); }
    /// Blocks until the trace ends and returns it.
    const PictureTruth& truth();

private:
    SceneSnapshot scene_;
    TraceState state_;
    std::atomic<bool> finished_{false};
    PictureTruth truth_;
    std::thread thread_;  // last, because it uses all members above
};

}  // namespace gnomon::truth
