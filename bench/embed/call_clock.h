#pragma once
#include <array>
#include <cstdint>
#include <functional>

namespace gnomon::bench {

/// Times of one call. us: what it has the device do. cpu_us: the process's time on all cores, until the device has
/// finished. call_us: the calling thread's, until the call returns.
struct CallTimes {
    double us = 0.0, cpu_us = 0.0, call_us = 0.0;
};

/// Times calls that draw with the current context. On hardware `us` lies between two time stamps of the device. It is
/// kept busy until the call has returned, so that the time has no gaps in it. On software devices it is wall-clock time
/// until the device has finished.
class CallClock {
public:
    using Call = std::function<void()>;

    explicit CallClock(bool is_software);
    ~CallClock();
    CallClock(const CallClock&) = delete;
    CallClock& operator=(const CallClock&) = delete;

    /// Times `call`; `before` runs untimed, before each try.
    CallTimes time(const Call& before, const Call& call);

    /// Counts calls during which the device may have been idle, although it was kept busy.
    std::uint32_t starved() const { return starved_; }
    /// Returns in words how `us` is taken.
    const char* method() const;

private:
    bool try_once(const Call& call, CallTimes& times);
    void keep_busy();
    void calibrate();

    bool is_software_;
    std::array<unsigned, 2> stamps_{};
    unsigned busy_program_ = 0, busy_buffer_ = 0;
    std::uint32_t busy_steps_ = 1024, starved_ = 0;
};

}  // namespace gnomon::bench
