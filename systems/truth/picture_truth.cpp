#include "systems/truth/picture_truth.h"

#include <algorithm>
#include <utility>

#include "systems/truth/light_shares.h"

namespace gnomon::truth {
namespace {

/// Number of rows that a thread takes at a time: neighbouring places share their walk through the trees.
constexpr std::uint32_t kRowsAtOnce = 4;
/// Cost per row: one ray for the surface, five for its light, one for colours, and the few of each share.
constexpr std::uint64_t kSeeing = 1, kLighting = 5, kTinting = 1;
std::uint64_t share_cost(const LightItem& light, bool over_area) {
    const ShareRays few = share_steps(light, over_area).few;
    return few.count() + (over_area ? few.places : 0);
}

/// A share of a light to trace, and where it is put.
struct Share {
    std::optional<LightTruth> TracedLight::*member;
    LightItem light;
    bool over_area;
};

/// Returns the shares by which filters of the light may be judged.
std::vector<Share> shares_of(const LightItem& light) {
    std::vector<Share> shares;
    if (has_size(light)) shares.push_back({&TracedLight::source, light, false});
    if (!light.shadow.antialias) return shares;
    shares.push_back({&TracedLight::area, as_point(light), true});
    if (has_size(light)) shares.push_back({&TracedLight::source_and_area, light, true});
    return shares;
}

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
        if (scene.lights[i].has_shadow) truth.lights.push_back({i, {}, {}, {}, {}, {}});
    const std::uint32_t height = camera.viewport_px.y;
    visibility::CasterTrees translucent(library, visibility::TreesOf::translucent);
    const bool has_glass = std::any_of(library.materials.begin(), library.materials.end(), assets::transmits);
    if (has_glass) translucent.update(scene);
    std::uint64_t work_per_row = kSeeing;
    for (TracedLight& traced : truth.lights) {
        work_per_row += kLighting;
        if (translucent.counts().triangles > 0 && scene.lights[traced.light].shadow.translucent_casters) {
            traced.tint.emplace();
            work_per_row += kTinting;
        }
        for (const Share& share : shares_of(scene.lights[traced.light]))
            work_per_row +=
                2 * share_cost(share.light, share.over_area);  // as many again for pixels that need many: a guess
    }
    state.all = std::max<std::uint64_t>(height * work_per_row, 1);

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
        if (traced.tint) {
            traced.tint->reset(truth.seen.count());
            share_rows(height, threads, kTinting, state, [&] {
                return [&](std::uint32_t row, std::uint32_t rows) {
                    trace_tint_rows(scene, light, truth.seen, {row, rows}, translucent, *traced.tint);
                };
            });
        }
        for (const Share& share : shares_of(scene.lights[traced.light])) {
            LightTruth& shares = (traced.*share.member).emplace();
            shares.reset(truth.seen.count());
            const ShareTrace trace(scene, share.light, truth.seen, share.over_area ? &surfaces : nullptr, shares);
            const auto trace_rows_by = [&](const auto& trace_part) {
                share_rows(height, threads, share_cost(share.light, share.over_area), state, [&] {
                    return
                        [&, queries = visibility::LightQueries(trees)](std::uint32_t row, std::uint32_t rows) mutable {
                            trace_part(RowRange{row, rows}, queries);
                        };
                });
            };
            trace_rows_by([&](RowRange rows, auto& queries) { trace.trace_few(rows, queries); });
            const LightTruth few = shares;
            trace_rows_by([&](RowRange rows, auto& queries) { trace.trace_undecided(rows, few, queries); });
            if (!share.over_area) continue;
            for (std::size_t i = 0; i < shares.scored.size(); ++i)
                if (traced.truth.ambiguous[i] != 0) shares.scored[i] = 0;
        }
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
