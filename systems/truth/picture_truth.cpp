#include "systems/truth/picture_truth.h"

#include <algorithm>
#include <utility>

#include "systems/truth/source_truth.h"

namespace gnomon::truth {
namespace {

/// Number of rows that a thread takes at a time: neighbouring places share their walk through the trees.
constexpr std::uint32_t kRowsAtOnce = 4;
/// Cost per row: one ray for the surface, five for its light, the few for its source, as many again as a guess at
/// penumbrae.
constexpr std::uint64_t kSeeing = 1, kLighting = 5, kFew = kFewSamples, kUndecided = kFewSamples;

/// Calls work(first_row, rows) for all rows on several threads; `make_work` makes a `work` for each.
template <class MakeWork>
void share_rows(std::uint32_t height, unsigned threads, std::uint64_t work_per_row, TraceState& state,
                const MakeWork& make_work) {
    std::atomic<std::uint32_t> next{0};
    const auto drain = [&] {
        auto work = make_work();
        for (std::uint32_t row = next.fetch_add(kRowsAtOnce); row < height && !state.cancelled;
             row = next.fetch_add(kRowsAtOnce)) {
            const std::uint32_t rows = std::min(kRowsAtOnce, height - row);
            work(row, rows);
            state.done += rows * work_per_row;
        }
    };
    std::vector<std::thread> helpers;
    for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(drain);
    drain();
    for (std::thread& helper : helpers) helper.join();
}

}  // namespace

PictureTruth trace_picture(const SceneSnapshot& scene, const assets::MeshLibrary& library, unsigned threads,
                           TraceState& state) {
    PictureTruth truth;
    if (scene.consumers.empty()) return truth;
    const ConsumerItem& camera = scene.consumers.front();
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].has_shadow) truth.lights.push_back({i, {}, {}});
    const std::uint32_t height = camera.viewport_px.y;
    const auto sized = static_cast<std::uint64_t>(
        std::count_if(truth.lights.begin(), truth.lights.end(),
                      [&](const TracedLight& traced) { return has_size(scene.lights[traced.light]); }));
    state.all =
        std::max<std::uint64_t>(height * (kSeeing + kLighting * truth.lights.size() + (kFew + kUndecided) * sized), 1);

    visibility::CasterTrees trees(library, visibility::TreesOf::casters_and_visible);
    trees.update(scene);
    // Glass that is drawn as opaque is seen, but blocks no light.
    const bool sees_glass = std::any_of(library.materials.begin(), library.materials.end(), [](const auto& material) {
        return assets::transmits(material) && material.alpha_mode != assets::AlphaMode::blend;
    });
    visibility::CasterTrees shown(library, visibility::TreesOf::visible);
    if (sees_glass) shown.update(scene);
    truth.seen.reset(camera.viewport_px, camera.position_ws_m);
    const SurfaceTracer surfaces(scene, sees_glass ? shown : trees, camera);
    share_rows(height, threads, kSeeing, state, [&] {
        return [&, hint = kNoSurface](std::uint32_t row, std::uint32_t rows) mutable {
            for (std::uint32_t i = 0; i < rows; ++i) surfaces.trace_row(row + i, hint, truth.seen);
        };
    });
    for (TracedLight& traced : truth.lights) {
        traced.truth.reset(truth.seen.count());
        const LightItem light = as_point(scene.lights[traced.light]);
        share_rows(height, threads, kLighting, state, [&] {
            return [&, queries = visibility::LightQueries(trees)](std::uint32_t row, std::uint32_t rows) mutable {
                trace_rows(scene, light, truth.seen, {row, rows}, queries, traced.truth);
            };
        });
        if (!has_size(scene.lights[traced.light])) continue;
        LightTruth& shares = traced.source.emplace();
        shares.reset(truth.seen.count());
        const SourceTrace source(scene, scene.lights[traced.light], truth.seen, shares);
        const auto trace = [&](std::uint64_t work_per_row, const auto& trace_part) {
            share_rows(height, threads, work_per_row, state, [&] {
                return [&, queries = visibility::LightQueries(trees)](std::uint32_t row, std::uint32_t rows) mutable {
                    trace_part(RowRange{row, rows}, queries);
                };
            });
        };
        trace(kFew, [&](RowRange rows, visibility::LightQueries& queries) { source.trace_few(rows, queries); });
        const std::vector<float> few = shares.visibility;
        trace(kUndecided,
              [&](RowRange rows, visibility::LightQueries& queries) { source.trace_undecided(rows, few, queries); });
    }
    return truth;
}

BackgroundTrace::BackgroundTrace(SceneSnapshot scene, const assets::MeshLibrary& library, unsigned threads)
    : scene_(std::move(scene)) {
    // Nonzero, so that trees are made once and then only read.
    scene_.version = std::max<std::uint64_t>(scene_.version, 1);
    thread_ = std::thread([this, &library, threads] {
        truth_ = trace_picture(scene_, library, threads, state_);
        finished_ = true;
    });
}

BackgroundTrace::~BackgroundTrace() {
    state_.cancelled = true;
    if (thread_.joinable()) thread_.join();
}

const PictureTruth& BackgroundTrace::truth() {
    if (thread_.joinable()) thread_.join();
    return truth_;
}

}  // namespace gnomon::truth
