#pragma once
#include <algorithm>
#include <cstddef>

#include "engine/core/jobs.h"

namespace gnomon::shadow {

/// Lights for each thread, at least. One takes some 0.1 ms (docs/results/many_lights.md): fewer are not worth a thread.
inline constexpr std::size_t kLightsPerThread = 8;

/// Returns how many threads share this many lights. `jobs`: null: the calling one does all.
inline std::size_t threads_for(const Jobs* jobs, std::size_t lights) {
    return jobs ? std::clamp<std::size_t>(lights / kLightsPerThread, 1, jobs->threads()) : 1;
}

/// Calls job(index, thread) once for each index below `lights`, on as many threads as share them (Jobs::run()).
template <class Job>
void for_each_light(Jobs* jobs, std::size_t lights, const Job& job) {
    const std::size_t threads = threads_for(jobs, lights);
    if (threads > 1) return jobs->run(lights, threads, job);
    for (std::size_t i = 0; i < lights; ++i) job(i, std::size_t{0});
}

}  // namespace gnomon::shadow
