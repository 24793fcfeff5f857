#include "engine/core/workers.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon {

struct Workers::Shared {
    ~Shared() {
        {
            const std::lock_guard lock(mutex);
            ends = true;
        }
        begins.notify_all();
        for (std::thread& thread : threads) thread.join();
    }

    /// Starts threads until `wanted` run. Fewer do where the system gives no more.
    void provide(std::size_t wanted) {
        threads.reserve(kMost);
        while (threads.size() < wanted) {
            try {
                threads.emplace_back([this, thread = threads.size() + 1] { wait(thread); });
            } catch (const std::system_error&) {
                return;
            }
        }
    }

    void begin(Size size, Call wanted, const void* with) {
        {
            const std::lock_guard lock(mutex);
            call = wanted;
            job = with;
            jobs = size.jobs;
            next = 0;
            taking = size.threads;
            running = taking - 1;
            ++calls;
        }
        begins.notify_all();
    }

    /// Blocks until the other threads have ended.
    void finish() {
        std::unique_lock lock(mutex);
        ended.wait(lock, [this] { return running == 0; });
        if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
    }

    void run(std::size_t thread) {
        try {
            for (std::size_t i = next++; i < jobs; i = next++) call(job, i, thread);
        } catch (...) {
            next = jobs;
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    }

    void wait(std::size_t thread) {
        std::uint64_t seen = 0;
        for (std::unique_lock lock(mutex);;) {
            begins.wait(lock, [&] { return ends || calls != seen; });
            if (ends) return;
            seen = calls;
            if (thread >= taking) continue;
            lock.unlock();
            run(thread);
            lock.lock();
            if (--running == 0) ended.notify_one();
        }
    }

    std::mutex mutex;
    std::condition_variable begins, ended;
    std::vector<std::thread> threads;
    std::uint64_t calls = 0;  // number of calls so far
    std::size_t taking = 0;   // threads of the present call, the calling one included
    std::size_t running = 0;  // other threads of it that have not ended
    bool ends = false;
    Call call = nullptr;
    const void* job = nullptr;
    std::size_t jobs = 0;
    std::atomic<std::size_t> next = 0;  // index of the next job
    std::exception_ptr failure;
};

Workers::Workers(std::size_t threads)
    : threads_(std::clamp<std::size_t>(threads > 0 ? threads : std::thread::hardware_concurrency(), 1, kMost)) {}
Workers::~Workers() = default;

void Workers::share(Size size, Call call, const void* job) {
    std::size_t taking = size.threads;
    if (taking > 1) {
        if (!shared_) shared_ = std::make_unique<Shared>();
        shared_->provide(taking - 1);
        taking = std::min(taking, shared_->threads.size() + 1);
    }
    if (taking <= 1) {
        for (std::size_t i = 0; i < size.jobs; ++i) call(job, i, 0);
        return;
    }
    shared_->begin({size.jobs, taking}, call, job);
    shared_->run(0);
    shared_->finish();
}

}  // namespace gnomon
