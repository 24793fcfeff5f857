#include "engine/gl/gl45_timers.h"

#include <algorithm>
#include <utility>

#include "engine/gl/gl45_kept_pieces.h"

namespace gnomon::gl {

namespace {
constexpr double kMicrosecondsPerNanosecond = 1e-3;
}

GlTimers::~GlTimers() {
    abandon();
    for (const Pending& pending : pending_) free(pending);
    glDeleteQueries(static_cast<GLsizei>(free_queries_.size()), free_queries_.data());
}

void GlTimers::forget() {
    running_.reset();
    pending_.clear();
    free_queries_.clear();
}

GLuint GlTimers::take_query() {
    GLuint query = 0;
    if (free_queries_.empty()) {
        glCreateQueries(keeps_state_ ? GL_TIMESTAMP : GL_TIME_ELAPSED, 1, &query);
    } else {
        query = free_queries_.back();
        free_queries_.pop_back();
    }
    return query;
}

GLuint GlTimers::take_stamp() {
    const GLuint query = take_query();
    glQueryCounter(query, GL_TIMESTAMP);
    return query;
}

void GlTimers::free(const Pending& pending) {
    free_queries_.push_back(pending.query);
    if (pending.first_stamp != 0) free_queries_.push_back(pending.first_stamp);
}

bool GlTimers::begin(std::uint32_t id, std::uint64_t submission) {
    if (running_) return false;
    running_ = Running{{id, submission, 0.0}, mode_, 0, 0, {}};
    if (mode_ == TimingMode::query && keeps_state_) {
        running_->first_stamp = take_stamp();
    } else if (mode_ == TimingMode::query) {
        running_->query = take_query();
        glBeginQuery(GL_TIME_ELAPSED, running_->query);
    } else if (mode_ == TimingMode::finish) {
        glFinish();
        running_->start = std::chrono::steady_clock::now();
    }
    return true;
}

bool GlTimers::end(std::uint32_t id) {
    if (!running_ || running_->timing.id != id) return false;
    Running running = *std::exchange(running_, std::nullopt);
    if (running.mode == TimingMode::query) {
        keeps_state_ ? static_cast<void>(running.query = take_stamp()) : glEndQuery(GL_TIME_ELAPSED);
        pending_.push_back({running.timing, running.query, running.first_stamp});
    } else if (running.mode == TimingMode::finish) {
        glFinish();
        const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - running.start;
        running.timing.gpu_us = elapsed.count();
        done_.push_back(running.timing);
    }
    return true;
}

bool GlTimers::abandon() {
    if (!running_) return true;
    if (running_->mode == TimingMode::query) {
        if (!keeps_state_) glEndQuery(GL_TIME_ELAPSED);
        free_queries_.push_back(keeps_state_ ? running_->first_stamp : running_->query);
    }
    running_.reset();
    return false;
}

bool GlTimers::take_next() {
    if (pending_.empty()) return false;
    const Pending& next = pending_.front();
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(next.query, GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE) return false;
    GLuint64 elapsed_ns = 0, first_ns = 0;
    glGetQueryObjectui64v(next.query, GL_QUERY_RESULT, &elapsed_ns);
    if (next.first_stamp != 0) glGetQueryObjectui64v(next.first_stamp, GL_QUERY_RESULT, &first_ns);
    Timing timing = next.timing;
    timing.gpu_us = static_cast<double>(elapsed_ns - std::min(first_ns, elapsed_ns)) * kMicrosecondsPerNanosecond;
    done_.push_back(timing);
    free(next);
    pending_.pop_front();
    return true;
}

std::vector<Timing> GlTimers::take() {
    Kept<QueryBuffer> results;  // a buffer of the engine's would take them
    if (keeps_state_ && !pending_.empty()) results.set(0);
    while (take_next()) {
    }
    results.restore();
    return std::exchange(done_, {});
}

}  // namespace gnomon::gl
