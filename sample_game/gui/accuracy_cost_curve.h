#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "systems/report.h"

/// What max_error_px turned out to cost, setting by setting, as far as it was tried.
namespace gnomon::game {

/// Settings go in steps of 2^(1/4), so that one that is tried again is the same.
inline constexpr int kLeastContractStep = -12, kMostContractStep = 24;  // 0.125 px to 64 px
float contract_px(int step);
/// The step nearest to it, within the range.
int contract_step(float max_error_px);

/// What was measured at one setting.
struct ContractPoint {
    float max_error_px = 0.0f;  // 0: nobody said it
    /// Of the GPU per frame, medians over the last frames: of those that drew maps, and those that kept all of them.
    /// Empty: no such frame was timed.
    std::optional<float> drawn_ms, kept_ms;
    std::uint64_t texels = 0, bytes = 0;  // when it was last set
    double predicted_px = 0.0;            // the worst of its lights, then
    std::uint32_t frames = 0;
};

class ContractCurve {
public:
    static constexpr std::size_t kKept = 64;  // times of each kind, at each setting

    /// A frame under that setting; of one light, or of all that have a shadow.
    void add(float max_error_px, const FrameReport& report, const std::string& light = {});
    void clear() { settings_.clear(); }
    /// By rising max_error_px.
    std::vector<ContractPoint> points() const;

private:
    struct Setting {
        ContractPoint last;
        std::vector<float> drawn_ms, kept_ms;  // the last kKept, in no order
        std::uint32_t drawn = 0, kept = 0;     // of all that there were
    };
    std::vector<Setting> settings_;  // by rising max_error_px
};

}  // namespace gnomon::game
