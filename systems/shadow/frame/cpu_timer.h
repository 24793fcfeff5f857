#pragma once
#include <chrono>
#include <cstdint>

#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// Adds the time of its own life to one light's account in frame.cpu_us. A frame without accounts is left alone.
class LightTime {
public:
    LightTime(ShadowFrame& frame, std::uint32_t light) : frame_(frame), light_(light), start_(Clock::now()) {}
    LightTime(const LightTime&) = delete;
    LightTime& operator=(const LightTime&) = delete;
    ~LightTime() {
        if (light_ < frame_.cpu_us.size())
            frame_.cpu_us[light_] += std::chrono::duration<double, std::micro>(Clock::now() - start_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    ShadowFrame& frame_;
    std::uint32_t light_;
    Clock::time_point start_;
};

}  // namespace gnomon::shadow
