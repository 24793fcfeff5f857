#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "systems/shadow/frame/instance_layers.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Reused storage of one thread's searches and fits; its contents are meaningless between two lights.
struct StageScratch {
    SetScratch sets;
    FitScratch fits;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> drawn;  // choose_proxies()
};

/// What one thread found, of the lights that it took in no order.
struct ThreadResults {
    ReceiverCasterSets sets;
    FittedViews fitted;
};

/// What culling and fitting keep from frame to frame, so that a steady frame allocates nothing.
struct StageStorage {
    InstanceLayers layers;               // layers at the last select_sets()
    std::vector<StageScratch> scratch;   // one per thread
    std::vector<ThreadResults> results;  // one per thread; empty while one does all
    std::vector<std::size_t> thread_of;  // one per light: the thread that took it
    std::vector<std::uint32_t> taking;   // lights that the last fit_views() fitted, by index
};

/// Provides scratch for as many threads; for several also results, of `lights`.
inline void provide_threads(std::size_t threads, std::size_t lights, StageStorage& storage) {
    storage.scratch.resize(std::max(storage.scratch.size(), threads));
    for (StageScratch& scratch : storage.scratch) scratch.sets.layers = &storage.layers;
    if (threads == 1) return;
    storage.results.resize(std::max(storage.results.size(), threads));
    storage.thread_of.resize(lights);
}

}  // namespace gnomon::shadow
