#pragma once
#include <chrono>
#include <cstdint>
#include <span>

namespace gnomon::shadow {

/// Adds the time between its construction and destruction to one light's CPU time. `cpu_us`: one entry per light,
/// microseconds. A light beyond its end is not timed.
class LightTimer {
public:
    LightTimer(std::span<double> cpu_us, std::uint32_t light) : cpu_us_(cpu_us), light_(light), start_(Clock::now()) {}
    LightTimer(const LightTimer&) = delete;
    LightTimer& operator=(const LightTimer&) = delete;
    ~LightTimer() {
        if (light_ < cpu_us_.size())
            cpu_us_[light_] += std::chrono::duration<double, std::micro>(Clock::now() - start_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    std::span<double> cpu_us_;
    std::uint32_t light_;
    Clock::time_point start_;
};

}  // namespace gnomon::shadow
