#pragma once
#include <epoxy/gl.h>

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Times spans of GPU work as the mode requires. Private to the executor.
class GlTimers {
public:
    /// Makes timers. If `keeps_state`, times come from a stamp at either end, so that the engine's own may run.
    explicit GlTimers(bool keeps_state) : keeps_state_(keeps_state) {}
    GlTimers(const GlTimers&) = delete;
    GlTimers& operator=(const GlTimers&) = delete;
    ~GlTimers();

    void set_mode(TimingMode mode) { mode_ = mode; }
    /// Starts a timer, or ends timer `id`. Returns false and does nothing if a timer runs already, or `id` does not
    /// run.
    bool begin(std::uint32_t id, std::uint64_t submission);
    bool end(std::uint32_t id);
    /// Ends a timer that a list left running and drops its time. Returns false if one ran.
    bool abandon();
    std::vector<Timing> take();
    /// Gives up all queries without deleting them: their context is not current.
    void forget();

private:
    struct Running {
        Timing timing;
        TimingMode mode = TimingMode::off;
        GLuint query = 0, first_stamp = 0;
        std::chrono::steady_clock::time_point start;
    };
    struct Pending {
        Timing timing;
        GLuint query = 0, first_stamp = 0;  // a span; or the second of two stamps, and the first
    };
    GLuint take_query();
    GLuint take_stamp();
    void free(const Pending& pending);
    bool take_next();

    bool keeps_state_;
    TimingMode mode_ = TimingMode::off;
    std::optional<Running> running_;
    std::deque<Pending> pending_;
    std::vector<GLuint> free_queries_;
    std::vector<Timing> done_;
};

}  // namespace gnomon::gl
