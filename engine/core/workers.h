#pragma once
#include <cstddef>
#include <memory>

#include "engine/core/jobs.h"

namespace gnomon {

/// Threads that share jobs with the calling thread. They start with the first call that needs them, and sleep between
/// calls. A call allocates nothing once they run.
class Workers final : public Jobs {
public:
    /// Most threads that share one call: more gain little, since a call ends with its longest job.
    static constexpr std::size_t kMost = 8;

    /// Starts no thread yet. `threads`: how many share a call, with the calling one, up to kMost. 0: as many as the
    /// processor runs at once. 1: the calling thread does all.
    explicit Workers(std::size_t threads);
    ~Workers() override;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    std::size_t threads() const override { return threads_; }

private:
    struct Shared;
    void share(Size size, Call call, const void* job) override;

    std::size_t threads_;
    std::unique_ptr<Shared> shared_;  // null: no thread was needed yet
};

}  // namespace gnomon
