#include "bench/accuracy/reference_images.h"

#include <chrono>

#include "bench/accuracy/surface_mismatch.h"
#include "bench/compare/filter_variants.h"
#include "tests/oracle/far_errors.h"

namespace gnomon::bench {

bool is_wrong(const TracedLight& light, std::size_t pixel, float measured) {
    constexpr float kHalf = 0.5f;
    const oracle::LightTruth& truth = light.point;
    return truth.scored[pixel] && !truth.ambiguous[pixel] &&
           !((measured > kHalf) == (truth.visibility[pixel] > kHalf) && measured >= 0.0f);
}

std::vector<std::uint32_t> TracedTruths::indices() const {
    std::vector<std::uint32_t> all;
    for (const TracedLight& light : lights) all.push_back(light.index);
    return all;
}

Result<TracedTruths> trace_truths(Stage& stage, const TruthOptions& options) {
    if (options.disks)
        if (auto error = stage.start_over(disk_source())) return *error;
    stage.run_frame();
    const SceneSnapshot& scene = stage.frame().snapshot();
    if (scene.consumers.empty()) return Error{"no usable camera", stage.scene_name(), "", "bench.camera"};
    const auto start = std::chrono::steady_clock::now();
    const ConsumerItem& camera = scene.consumers.front();
    TracedTruths truths;
    truths.tracer = std::make_unique<oracle::ReferenceTracer>(scene, stage.library(), camera.position_ws_m);
    truths.hits = truths.tracer->trace_primary(camera);
    truths.creases = oracle::creases(truths.hits);
    const auto other = other_surfaces(stage, *truths.tracer, truths.hits);
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const LightItem& light = scene.lights[i];
        if (!light.has_shadow) continue;
        TracedLight& traced = truths.lights.emplace_back();
        traced.index = i;
        traced.name = light.name;
        traced.kind = light.kind;
        traced.point = truths.tracer->trace_light(truths.hits, light, true);
        if (other) traced.other_surface = leave_out(*other, traced.point);
        if (options.disks) traced.disk = truths.tracer->trace_source(truths.hits, light, {});
        if (options.area_side > 0)
            traced.area =
                truths.tracer->trace_area(camera, truths.hits, traced.point, light, {.side = options.area_side});
    }
    truths.trace_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return truths;
}

}  // namespace gnomon::bench
