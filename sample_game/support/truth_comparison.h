#pragma once
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "systems/frame.h"
#include "systems/truth/metrics.h"
#include "systems/truth/picture_truth.h"

namespace gnomon::game {

/// A shadowed light of a frozen frame.
struct JudgedLight {
    std::string name;
    std::uint32_t index = 0;                // of the snapshot's lights
    std::vector<float> measured = {};       // its visibility, as it is drawn now; empty: not yet read, or unreadable
    std::optional<truth::Metrics> metrics;  // of that; empty: not yet
    bool stale = true;                      // to be read anew
};

/// A frame that stands still while the truth about it is traced, and what its shadows are off from that.
///
/// While it is frozen neither camera, lights nor casters may move; whoever runs the frame sees to that. How shadows are
/// drawn may change: then errors are taken anew, a light a frame, against the same truth.
class FrozenFrame {
public:
    enum class State : std::uint8_t { off, tracing, shown };

    /// Begins with the frame that was run last, on `threads` threads beside this one.
    void freeze(const Frame& frame, const assets::MeshLibrary& library, unsigned threads);
    void thaw();
    /// To be called after each frame. Never waits for the trace; takes what is finished and judges one light at most.
    /// Ends where the picture's size, or whose shadows fall on whom, has changed.
    void update(Frame& frame);
    /// Waits until all that can be judged is.
    void finish(Frame& frame);

    State state() const { return state_; }
    bool on() const { return state_ != State::off; }
    double share() const { return trace_ ? trace_->share() : 0.0; }  // of the trace
    bool judged() const;                                             // every light of the frame that stands now

    const std::vector<JudgedLight>& lights() const { return lights_; }
    /// Which light's errors are shown; empty: of each pixel the worst.
    std::optional<std::size_t> chosen() const { return chosen_; }
    void choose(std::optional<std::size_t> light);
    void choose_next();  // the worst, then one light after the other

    /// tint_errors() of what is chosen, of size_px(); empty until a light was judged. `version` grows when it changed.
    const std::vector<std::uint8_t>& tints() const { return tints_; }
    std::uint64_t version() const { return version_; }
    glm::uvec2 size_px() const { return size_px_; }

private:
    void judge(Frame& frame, std::size_t index);
    void paint();

    State state_ = State::off;
    std::unique_ptr<truth::BackgroundTrace> trace_;
    glm::uvec2 size_px_{0, 0};
    std::vector<JudgedLight> lights_;
    std::vector<ShadowLayers> layers_;  // of the lights, when it was frozen
    std::optional<std::size_t> chosen_;
    std::size_t last_judged_ = 0;
    std::vector<std::uint8_t> tints_;
    std::uint64_t version_ = 0;
};

/// Key "truth" of the stats: docs/stats.md.
nlohmann::ordered_json truth_stats(const FrozenFrame& frozen);

}  // namespace gnomon::game
