#include "engine/gl/gl45_timers.h"

#include <utility>

namespace gnomon::gl {

namespace {
constexpr double kMicrosecondsPerNanosecond = 1e-3;
}

GlTimers::~GlTimers() {
    abandon();
    for (const Pending& pending : pending_) free_queries_.push_back(pending.query);
    glDeleteQueries(static_cast<GLsizei>(free_queries_.size()), free_queries_.data());
}

GLuint GlTimers::take_query() {
    GLuint query = 0;
    if (free_queries_.empty()) {
        glCreateQueries(GL_TIME_ELAPSED, 1, &query);
    } else {
        query = free_queries_.back();
        free_queries_.pop_back();
    }
    return query;
}

bool GlTimers::begin(std::uint32_t id, std::uint64_t submission) {
    if (running_) return false;
    running_ = Running{{id, submission, 0.0}, mode_, 0, {}};
    if (mode_ == TimingMode::query) {
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
        glEndQuery(GL_TIME_ELAPSED);
        pending_.push_back({running.timing, running.query});
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
        glEndQuery(GL_TIME_ELAPSED);
        free_queries_.push_back(running_->query);
    }
    running_.reset();
    return false;
}

std::vector<Timing> GlTimers::take() {
    while (!pending_.empty()) {
        GLuint available = GL_FALSE;
        glGetQueryObjectuiv(pending_.front().query, GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) break;
        GLuint64 elapsed_ns = 0;
        glGetQueryObjectui64v(pending_.front().query, GL_QUERY_RESULT, &elapsed_ns);
        Timing timing = pending_.front().timing;
        timing.gpu_us = static_cast<double>(elapsed_ns) * kMicrosecondsPerNanosecond;
        done_.push_back(timing);
        free_queries_.push_back(pending_.front().query);
        pending_.pop_front();
    }
    return std::exchange(done_, {});
}

}  // namespace gnomon::gl
