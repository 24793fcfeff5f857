#pragma once
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/frame.h"
#include "gnomon/registry.h"
#include "systems/truth/metrics.h"
#include "systems/truth/picture_truth.h"
#include "systems/truth/soft_metrics.h"

namespace gnomon::game {

/// What a filter shows of a light, and is judged by: its middle or all of its source, at pixels' middles or over their
/// areas.
enum class ShownShare : std::uint8_t { middle, source, area, source_and_area };

/// A shadowed light of a frozen frame.
struct JudgedLight {
    std::string name;
    ecs::Entity entity;
    std::vector<float> measured = {};       // its visibility, as it is drawn now; empty: not yet read, or unreadable
    ShownShare by = ShownShare::middle;     // share that it is judged by
    const truth::LightTruth* truth = nullptr;  // that share; null: not judged
    std::optional<truth::Metrics> metrics;     // accuracy of `measured` by the light's middle at pixels' middles
    std::optional<truth::SoftMetrics> soft;    // the same by a share: of its source, of pixels' areas, or of both
    std::optional<truth::TintMetrics> tint = {};  // accuracy of colours behind glass; empty: none, or not judged
    std::vector<float> tint_off = {};             // compare_tint()
    bool stale = true;                       // its visibility has to be read again
    bool judged() const { return truth != nullptr; }
    /// Returns the number of pixels that it is judged at, 0 before it is.
    std::size_t scored() const { return metrics ? metrics->scored : soft ? soft->scored : 0; }
    /// Returns the share of them that are wrong: on the other side of a half, or of `soft` off by more than a half.
    double wrong() const;
};

/// What the truth about a light depends on, beside its place.
struct TracedSource {
    ShadowLayers layers{};
    bool antialias = false, translucent_casters = false;
    float source_radius_m = 0.0f, sun_radius_rad = 0.0f, width_m = 0.0f, height_m = 0.0f;
    bool operator==(const TracedSource&) const = default;
};

/// Frame that stands still while its ray-traced truth is computed, with the errors of its shadows.
///
/// While it is frozen the caller moves neither camera, lights nor casters. Settings of shadows may change: errors are
/// then computed again, for one light per frame, against the same truth. It is that of what the light's filter shows:
/// of the light's middle or of all its source, at pixels' middles or over their areas. Colours behind glass are those
/// of its middle: filters that read the source's size have them unjudged.
class FrozenFrame {
public:
    enum class State : std::uint8_t { off, tracing, shown };

    /// Begins with `world` as the last frame drew it, `size_px` large, on `threads` threads beside this one.
    void freeze(ecs::Registry& world, const assets::MeshLibrary& library, glm::uvec2 size_px, unsigned threads);
    void thaw();
    /// Judges one light at most, once the trace is finished; never blocks on it. Call after each frame. Ends the freeze
    /// if the picture's size, or the source, the layers, the antialiasing or the
    /// translucent casters of a light's shadow have changed.
    void update(Frame& frame, const ecs::Registry& world, glm::uvec2 size_px);
    /// Blocks until the trace is complete and every light is judged, or its visibility proves unreadable.
    void finish(Frame& frame);

    State state() const { return state_; }
    bool on() const { return state_ != State::off; }
    double share() const { return trace_ ? trace_->share() : 0.0; }  // finished share of the trace
    bool judged() const;                                             // every light of the frame that stands now

    const std::vector<JudgedLight>& lights() const { return lights_; }
    /// Returns the light with the errors that are shown; empty: each pixel's worst.
    std::optional<std::size_t> chosen() const { return chosen_; }
    void choose(std::optional<std::size_t> light);
    void choose_next();  // each pixel's worst, then each light that reaches a pixel

    /// Returns tint_errors() of the chosen light, size_px() large; empty until a light was judged. version() grows with
    /// each change.
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
    std::vector<TracedSource> sources_;  // sources of the lights when it was frozen
    std::optional<std::size_t> chosen_;
    std::size_t last_judged_ = 0;
    std::vector<std::uint8_t> tints_;
    std::uint64_t version_ = 0;
};

/// Returns the value of key "truth" of the stats (docs/reference/statistics.md).
nlohmann::ordered_json truth_stats(const FrozenFrame& frozen);

}  // namespace gnomon::game
