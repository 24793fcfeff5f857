#pragma once
#include <algorithm>
#include <cstddef>

namespace gnomon {

/// Runs the jobs of one call, on several threads or on the calling one alone (workers.h).
class Jobs {
public:
    virtual ~Jobs() = default;

    /// Returns how many jobs may run at once, 1 or more.
    virtual std::size_t threads() const = 0;

    /// Calls job(index, thread) once for each index below `count`, on at most `most` threads. `thread`, below both,
    /// differs between jobs that run at once. Jobs begin in the order of their indices. Returns when all have ended.
    /// Throws the first exception of a job; jobs that have not begun by then are left out.
    template <class Job>
    void run(std::size_t count, std::size_t most, const Job& job) {
        share(
            {count, std::min({count, most, threads()})},
            [](const void* of, std::size_t index, std::size_t thread) {
                (*static_cast<const Job*>(of))(index, thread);
            },
            &job);
    }

protected:
    using Call = void (*)(const void* job, std::size_t index, std::size_t thread);
    struct Size {
        std::size_t jobs, threads;
    };

private:
    virtual void share(Size size, Call call, const void* job) = 0;
};

}  // namespace gnomon
