#pragma once
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "systems/truth/light_truth.h"
#include "systems/truth/seen_surfaces.h"

/// The truth about a picture's shadows: what the first camera sees, and what of each shadowed light reaches it.
namespace gnomon::truth {

struct TracedLight {
    std::uint32_t light = 0;  // index into the snapshot's
    LightTruth truth;
};

struct PictureTruth {
    SeenSurfaces seen;
    std::vector<TracedLight> lights;  // those that have a LightShadow, in their order
};

/// Of a trace under way: read and written by any thread.
struct TraceState {
    std::atomic<std::uint64_t> done{0}, all{1};  // of its work, in rays of a row
    std::atomic<bool> cancelled{false};
    double share() const { return static_cast<double>(done.load()) / static_cast<double>(all.load()); }
};

/// On `threads` threads, this one included. Without a camera: no surface, no light. Cancelled: unfinished, to be thrown
/// away.
PictureTruth trace_picture(const SceneSnapshot& scene, const assets::MeshLibrary& library, unsigned threads,
                           TraceState& state);

/// trace_picture() beside everything else that goes on: of a copy of the scene, as it was when the trace began.
class BackgroundTrace {
public:
    /// Begins. `library` must outlive it.
    BackgroundTrace(SceneSnapshot scene, const assets::MeshLibrary& library, unsigned threads);
    /// Cancels, and waits for the end: as long as a few rows take.
    ~BackgroundTrace();
    BackgroundTrace(const BackgroundTrace&) = delete;
    BackgroundTrace& operator=(const BackgroundTrace&) = delete;

    double share() const { return state_.share(); }  // of the work, 0 to 1
    bool finished() const { return finished_.load(); }
    /// Waits for the end.
    const PictureTruth& truth();

private:
    SceneSnapshot scene_;
    TraceState state_;
    std::atomic<bool> finished_{false};
    PictureTruth truth_;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace gnomon::truth
