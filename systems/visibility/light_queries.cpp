#include "systems/visibility/light_queries.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "systems/visibility/blocked_rays.h"
#include "systems/visibility/light_rays.h"
#include "systems/visibility/near_order.h"

namespace gnomon::visibility {
namespace {

/// Places sorted together: more lie closer to each other, fewer balance the threads better.
constexpr std::size_t kMostPerBlock = std::size_t{1} << 16, kLeastPerBlock = std::size_t{1} << 10;
constexpr std::size_t kBlocksPerThread = 4;

struct Batch {
    const SceneSnapshot& scene;
    const CasterTrees& trees;
    const LightRays& light;
    ShadowLayers layers;
    double nearest_m;
    std::span<const Place> places;
    std::span<float> answers;
};

}  // namespace

/// State of one thread.
struct LightQueries::Worker {
    NearOrder order;
    rays::RayPacket rays;
    rays::PerLane<std::uint32_t> place_of_lane{};
    rays::PerLane<double> weight_of_lane{};
    std::vector<double> weights;  // sums over a place's rays, where these have weights
    std::uint32_t hint = 0;

    void answer(const Batch& batch, std::size_t first, std::size_t count) {
        const std::span<const Place> places = batch.places.subspan(first, count);
        const std::span<float> answers = batch.answers.subspan(first, count);
        std::fill(answers.begin(), answers.end(), 0.0f);
        weights.assign(count, 0.0);
        rays.last = batch.light.last();
        rays.count = 0;
        for (const std::uint32_t i : order.of(places)) {
            const std::size_t samples = batch.light.count(places[i].radius_m);
            for (std::size_t sample = 0; sample < samples; ++sample) {
                LightRay ray;
                const Reach reach = batch.light.ray(places[i], sample, ray);
                if (reach == Reach::all) answers[i] += 1.0f;
                if (reach == Reach::all) weights[i] += 1.0;
                if (reach != Reach::ray) continue;
                rays.from[rays.count] = ray.from_ws_m;
                rays.along[rays.count] = ray.along;
                rays.first[rays.count] = batch.nearest_m > 0.0 ? batch.nearest_m / glm::length(ray.along) : 0.0;
                place_of_lane[rays.count] = i;
                weight_of_lane[rays.count] = ray.weight;
                weights[i] += ray.weight;
                if (++rays.count == rays::kLanes) send(batch, answers);
            }
        }
        if (rays.count > 0) send(batch, answers);
        for (std::size_t i = 0; i < count; ++i) {
            const bool weighted = batch.light.weighted(places[i]);
            const double all = weighted ? weights[i] : static_cast<double>(batch.light.count(places[i].radius_m));
            answers[i] = all > 0.0 ? std::min(answers[i] / static_cast<float>(all), 1.0f) : 0.0f;
        }
    }

    /// Adds 1 to the results of places with an unblocked ray.
    void send(const Batch& batch, std::span<float> answers) {
        rays::Lanes lit = rays.lanes() & ~blocked_rays(batch.scene, batch.trees, batch.layers, rays, hint);
        for (; lit != 0; lit &= lit - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(lit));
            answers[place_of_lane[lane]] += static_cast<float>(weight_of_lane[lane]);
        }
        rays.count = 0;
    }
};

LightQueries::LightQueries(CasterTrees& trees) : trees_(&trees) {}
LightQueries::~LightQueries() = default;
LightQueries::LightQueries(LightQueries&&) noexcept = default;
LightQueries& LightQueries::operator=(LightQueries&&) noexcept = default;

void LightQueries::ask(const SceneSnapshot& scene, const LightItem& light, std::span<const Place> places,
                       const QueryOptions& options, std::span<float> answers) {
    if (places.empty()) return;
    trees_->update(scene);
    fill_disk(std::max(options.samples, 1u), disk_);
    const LightRays rays(light, disk_);
    const Batch batch{scene, *trees_, rays, light.shadow.layers, options.nearest_m, places, answers};
    const std::size_t threads = std::max(options.threads, 1u);
    const std::size_t block = std::clamp(places.size() / (kBlocksPerThread * threads), kLeastPerBlock, kMostPerBlock);
    const std::size_t needed = std::min(threads, (places.size() + block - 1) / block);
    while (workers_.size() < needed) workers_.push_back(std::make_unique<Worker>());
    std::atomic<std::size_t> next{0};
    const auto work = [&](Worker& worker) {
        for (std::size_t at = next.fetch_add(block); at < places.size(); at = next.fetch_add(block))
            worker.answer(batch, at, std::min(block, places.size() - at));
    };
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < needed; ++i) helpers.emplace_back([&, i] { work(*workers_[i]); });
    work(*workers_[0]);
    for (std::thread& helper : helpers) helper.join();
}

}  // namespace gnomon::visibility
