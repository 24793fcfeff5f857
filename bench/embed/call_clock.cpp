#include "bench/embed/call_clock.h"

#include <epoxy/gl.h>

#include <chrono>
#include <ctime>

#include "bench/common/timed_blocks.h"

namespace gnomon::bench {
namespace {

constexpr double kUsPerS = 1.0e6, kNsPerUs = 1.0e3;
constexpr double kLeastBusy_us = 3000.0;             // more than most calls take on the processor
constexpr std::uint32_t kMostBusySteps = 1U << 26U;  // what a driver might take for a hang
constexpr int kTries = 4;
constexpr GLuint kBusyGroups = 256;

constexpr const char* kBusy = R"(#version 450 core
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Sums { uint sums[]; };
layout(location = 0) uniform uint steps;
void main() {
    uint sum = gl_GlobalInvocationID.x;
    for (uint i = 0u; i < steps; ++i) sum = sum * 1664525u + 1013904223u;
    sums[gl_GlobalInvocationID.x & 63u] = sum;
})";

double stamp_us(GLuint query) {
    GLuint64 time_ns = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &time_ns);
    return static_cast<double>(time_ns) / kNsPerUs;
}

/// Returns the calling thread's time on the processor.
double thread_us() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * kUsPerS + static_cast<double>(time.tv_nsec) / kNsPerUs;
}

}  // namespace

CallClock::CallClock(bool is_software) : is_software_(is_software) {
    if (is_software) return;
    glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(stamps_.size()), stamps_.data());
    busy_program_ = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &kBusy);
    glCreateBuffers(1, &busy_buffer_);
    glNamedBufferStorage(busy_buffer_, 64 * sizeof(GLuint), nullptr, 0);
    calibrate();
}

CallClock::~CallClock() {
    if (is_software_) return;
    glDeleteQueries(static_cast<GLsizei>(stamps_.size()), stamps_.data());
    glDeleteProgram(busy_program_);
    glDeleteBuffers(1, &busy_buffer_);
}

const char* CallClock::method() const {
    return is_software_ ? "until the device has finished" : "time stamps of a device that is kept busy";
}

/// Queues work that must end before later work begins.
void CallClock::keep_busy() {
    glUseProgram(busy_program_);
    glProgramUniform1ui(busy_program_, 0, busy_steps_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, busy_buffer_);
    glDispatchCompute(kBusyGroups, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
    glUseProgram(0);
}

void CallClock::calibrate() {
    for (double us = 0.0; us < kLeastBusy_us && busy_steps_ < kMostBusySteps; busy_steps_ *= 2) {
        glQueryCounter(stamps_[0], GL_TIMESTAMP);
        keep_busy();
        glQueryCounter(stamps_[1], GL_TIMESTAMP);
        us = stamp_us(stamps_[1]) - stamp_us(stamps_[0]);
    }
}

/// Returns false if the device may have been idle during the call.
bool CallClock::try_once(const Call& call, CallTimes& times) {
    glFinish();
    const std::clock_t cpu_start = std::clock();
    if (!is_software_) {
        keep_busy();
        glQueryCounter(stamps_[0], GL_TIMESTAMP);
    }
    const auto start = std::chrono::steady_clock::now();
    const double thread_start_us = thread_us();
    call();
    times.call_us = thread_us() - thread_start_us;
    if (!is_software_) glQueryCounter(stamps_[1], GL_TIMESTAMP);
    GLint64 queued_ns = 0;
    if (!is_software_) glGetInteger64v(GL_TIMESTAMP, &queued_ns);
    glFinish();
    times.us = is_software_
                   ? std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count()
                   : stamp_us(stamps_[1]) - stamp_us(stamps_[0]);
    times.cpu_us = static_cast<double>(std::clock() - cpu_start) * kUsPerS / CLOCKS_PER_SEC;
    return is_software_ || static_cast<double>(queued_ns) / kNsPerUs < stamp_us(stamps_[0]);
}

CallTimes CallClock::time(const Call& before, const Call& call) {
    CallTimes times;
    for (int i = 0; i < kTries; ++i) {
        before();
        if (try_once(call, times)) return times;
        if (busy_steps_ < kMostBusySteps) busy_steps_ *= 2;
    }
    ++starved_;
    return times;
}

}  // namespace gnomon::bench
