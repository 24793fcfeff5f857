#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/frame.h"

/// Measured cost of max_error_px, per setting that was in use.
namespace gnomon::game {

/// Steps of the setting, by a factor of 2^(1/4) each: a setting that comes again is then the same.
inline constexpr int kLeastContractStep = -12, kMostContractStep = 24;  // 0.125 px to 64 px
float contract_px(int step);
/// Returns the step nearest to a value, within the range.
int contract_step(float max_error_px);

/// Measurement at one setting.
struct ContractPoint {
    float max_error_px = 0.0f;  // 0: no target was set
    /// GPU time per frame: median over the last frames that drew maps, and over the last that kept all maps. Empty: no
    /// such frame was timed.
    std::optional<float> drawn_ms, kept_ms;
    std::uint64_t texels = 0, bytes = 0;  // when it was last set
    double predicted_px = 0.0;            // the worst of its lights, then
    std::uint32_t frames = 0;
};

class ContractCurve {
public:
    static constexpr std::size_t kKept = 64;  // times of each kind, at each setting

    /// Adds a frame under that setting. `light`: the light to measure; empty: all with a shadow.
    void add(float max_error_px, const FrameReport& report, const std::string& light = {});
    void clear() { settings_.clear(); }
    /// Returns the points by rising max_error_px.
    std::vector<ContractPoint> points() const;

private:
    struct Setting {
        ContractPoint last;
        std::vector<float> drawn_ms, kept_ms;  // the last kKept, in no order
        std::uint32_t drawn = 0, kept = 0;     // numbers of all such frames
    };
    std::vector<Setting> settings_;  // by rising max_error_px
};

}  // namespace gnomon::game
