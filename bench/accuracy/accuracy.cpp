#include "bench/accuracy/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>

#include "bench/accuracy/edge_error_bounds.h"
#include "bench/accuracy/surface_mismatch.h"
#include "bench/accuracy/unexplained_errors.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/oracle/caster_pieces.h"

namespace gnomon::bench {
namespace {

// Automatic choices (sizes, caches) can have settled in the second frame at the earliest.
constexpr int kSettlingFrames = 2;
// Timings of a query may arrive this many frames late.
constexpr std::uint32_t kTimingLag = 3;
// Two ways to the same bound differ in their last digits.
constexpr double kRounding = 1.0e-9;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Bit for bit, so that NaN equals itself.
std::size_t count_differing(const std::vector<float>& a, const std::vector<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0;
    return count;
}

std::optional<Error> read_lights(Stage& stage, Accuracy& accuracy, std::vector<std::uint32_t>& indices) {
    const SceneSnapshot& snapshot = stage.frame().snapshot();
    if (snapshot.consumers.empty()) return Error{"no usable camera", accuracy.scene, "", "bench.camera"};
    for (std::uint32_t i = 0; i < snapshot.lights.size(); ++i) {
        if (!snapshot.lights[i].has_shadow) {
            accuracy.unshadowed.push_back(snapshot.lights[i].name);
            continue;
        }
        LightAccuracy light;
        light.report = stage.frame().report().lights[i];
        if (!stage.frame().read_visibility(i, light.measured))
            return Error{"visibility of light '" + snapshot.lights[i].name + "' cannot be read", accuracy.scene, "",
                         "bench.visibility"};
        const LightItem& item = snapshot.lights[i];
        if (item.shadow.translucent_casters && oracle::has_translucent_casters(snapshot, stage.library(), item) &&
            !is_left_out(light.report) && !stage.frame().read_tint(i, light.tint.emplace().measured))
            return Error{"colours of light '" + item.name + "' cannot be read", accuracy.scene, "", "bench.visibility"};
        accuracy.lights.push_back(std::move(light));
        indices.push_back(i);
    }
    return std::nullopt;
}

/// Adds the visibility of more frames with other noise, and divides: the mean of all.
std::optional<Error> average_noise(Stage& stage, std::uint32_t rounds, const std::vector<std::uint32_t>& indices,
                                   Accuracy& accuracy) {
    std::vector<float> more;
    for (std::uint32_t round = 1; round < rounds; ++round) {
        stage.set_noise_frame(round);
        stage.run_frame();
        for (std::size_t k = 0; k < indices.size(); ++k) {
            std::vector<float>& sum = accuracy.lights[k].measured;
            if (!stage.frame().read_visibility(indices[k], more) || more.size() != sum.size())
                return Error{"visibility of light '" + accuracy.lights[k].report.name + "' cannot be read",
                             accuracy.scene, "", "bench.visibility"};
            std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus<>());
        }
    }
    stage.set_noise_frame(0);
    for (LightAccuracy& light : accuracy.lights)
        for (float& visible : light.measured) visible /= static_cast<float>(rounds);
    return std::nullopt;
}

void judge_edges(const TracedPicture& picture, const oracle::CasterPieces& pieces, const EdgeBounds& bounds,
                 const AccuracyOptions& options, LightAccuracy& light) {
    EdgeAccuracy& edges = light.edges.emplace();
    const std::uint32_t index = picture.light;
    const oracle::PrimaryHits& hits = picture.hits;
    const auto exceptions = [&](const oracle::TexelAt& texel_at) {
        return oracle::edge_exceptions(picture.tracer, hits, picture.scene.consumers.front(),
                                       picture.scene.lights[index], picture.truth, light.metrics.edge, texel_at);
    };
    const auto texel_at = [&](const glm::dvec3& point, const glm::dvec3& normal) {
        return bounds.at(index, point, normal, options.telling);
    };
    edges.exceptions = exceptions(texel_at);
    const auto target_at = [&](const glm::dvec3& point, const glm::dvec3& normal) {
        return bounds.of_target(index, point, normal, options.target_factor);
    };
    if (light.report.keeps_max_error) edges.contract = exceptions(target_at);
    const auto resolving_at = [&](const glm::dvec3& point, const glm::dvec3& normal) {
        return bounds.resolving(index, point, normal, options.telling);
    };
    edges.resolved = oracle::resolved_edges(picture.tracer, hits, picture.scene.consumers.front(),
                                            picture.scene.lights[index], picture.truth, light.metrics.edge,
                                            pieces.seen_from(picture.scene.lights[index]), resolving_at);
    const double stated_m = light.report.resolved.m * options.stating * (1.0 + kRounding);
    const bool rays = shadow::filter_row(light.report.filter.filter).rays != nullptr;
    for (std::size_t i = 0; i < hits.count(); ++i) {
        if (picture.truth.scored[i] == 0) continue;
        const glm::dvec3 &point = hits.position_rel_m[i], &normal = hits.normal_ws[i];
        const double stated_px = bounds.stated_px(index, point, normal);
        edges.needs_wider += !rays && bounds.resolved_m(index, point, normal) > stated_m;
        edges.beyond_stated += stated_px > 0.0 && texel_at(point, normal).error_px > stated_px * (1.0 + kRounding);
    }
}

void judge_source(const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits, const LightItem& light,
                  LightAccuracy& accuracy) {
    SoftAccuracy& soft = accuracy.soft.emplace();
    soft.source = oracle::source_size(light);
    soft.truth = tracer.trace_source(hits, light, {});
    soft.metrics = oracle::compare_soft(hits, soft.truth, accuracy.measured);
}

/// Judges the light by the lit share of pixels' areas, if it shows that or `side` is not 0.
void judge_area(const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits, const SceneSnapshot& scene,
                std::uint32_t light, std::uint32_t side, LightAccuracy& accuracy) {
    const bool shown = scene.lights[light].shadow.antialias &&
                       shadow::filter_row(accuracy.report.filter.filter).area_shares != shadow::AreaShares::none;
    if (is_left_out(accuracy.report) || (!shown && side == 0)) return;
    AreaAccuracy& area = accuracy.area.emplace();
    area.shown = shown;
    oracle::AreaSampling sampling{.of_source = accuracy.soft.has_value()};
    if (side > 0) sampling.side = side;
    area.truth = tracer.trace_area(scene.consumers.front(), hits, accuracy.truth, scene.lights[light], sampling);
    area.metrics = oracle::compare_area(area.truth, accuracy.measured, accuracy.truth.ambiguous);
}

void judge_tint(Stage& stage, const oracle::PrimaryHits& hits, const LightItem& light, LightAccuracy& accuracy) {
    if (!accuracy.tint) return;
    accuracy.tint->truth = oracle::trace_tint(stage.frame().snapshot(), stage.library(),
                                              stage.frame().snapshot().consumers.front().position_ws_m, hits, light);
    accuracy.tint->metrics = oracle::compare_tint(hits, accuracy.tint->truth, accuracy.tint->measured);
}

std::optional<Error> judge_air(Stage& stage, const std::vector<std::uint32_t>& indices, Accuracy& accuracy) {
    if (stage.frame().snapshot().air.fogs.empty()) return std::nullopt;
    const auto air = measure_air(stage, indices);
    if (!air) return air.error();
    for (std::size_t k = 0; k < indices.size(); ++k) accuracy.lights[k].air = air.value()[k];
    return std::nullopt;
}

JudgedErrors judged_errors(const LightAccuracy& light) {
    const oracle::Metrics& m = light.metrics;
    const oracle::FarErrors& far = light.far;
    return {m.fraction(m.wrong), m.fraction(m.leak), m.fraction(m.acne),
            m.fraction(far.false_shadow + far.crease_shadow), m.fraction(far.false_light + far.crease_light)};
}

void trace_truth(Stage& stage, const AccuracyOptions& options, const std::vector<std::uint32_t>& indices,
                 Accuracy& accuracy) {
    const auto start = std::chrono::steady_clock::now();
    const SceneSnapshot& snapshot = stage.frame().snapshot();
    const ConsumerItem& camera = snapshot.consumers.front();
    const oracle::ReferenceTracer tracer(snapshot, stage.library(), camera.position_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(camera);
    const auto other = other_surfaces(stage, tracer, hits);
    for (std::size_t k = 0; k < indices.size(); ++k) {
        const LightItem& light = snapshot.lights[indices[k]];
        accuracy.lights[k].truth = tracer.trace_light(hits, light, true);
        if (other) accuracy.lights[k].other_surface = leave_out(*other, accuracy.lights[k].truth);
        if (oracle::source_size(light) > 0.0 && !is_left_out(accuracy.lights[k].report))
            judge_source(tracer, hits, light, accuracy.lights[k]);
        judge_tint(stage, hits, light, accuracy.lights[k]);
        judge_area(tracer, hits, snapshot, indices[k], options.area_side, accuracy.lights[k]);
    }
    accuracy.trace_s = seconds_since(start);
    accuracy.camera_ws_m = camera.position_ws_m;
    const EdgeBounds bounds(snapshot, stage.device().info(), stage.frame().fit_history());
    const std::vector<std::uint8_t> creases = oracle::creases(hits);
    std::optional<oracle::CasterPieces> pieces;
    if (options.with_edges) pieces.emplace(tracer, snapshot, stage.library());
    for (std::size_t k = 0; k < indices.size(); ++k) {
        LightAccuracy& light = accuracy.lights[k];
        if (is_left_out(light.report)) continue;
        light.metrics = oracle::compare(
            {accuracy.size_px, light.measured, light.truth.visibility, light.truth.scored, light.truth.ambiguous});
        const TracedPicture picture{tracer, hits, creases, snapshot, indices[k], light.truth};
        if (pieces) judge_edges(picture, *pieces, bounds, options, light);
        light.far = errors_beyond_texels(picture, bounds, light.measured);
        const bool shows_shares =
            shows_areas(light) ||
            shadow::filter_row(snapshot.lights[indices[k]].shadow.filter).width == shadow::FilterWidth::source;
        if (!shows_shares) light.judged = judged_errors(light);
    }
}

void time_lights(Stage& stage, const AccuracyOptions& options, const std::vector<std::uint32_t>& indices,
                 Accuracy& accuracy) {
    std::vector<std::vector<double>> gpu_us(indices.size()), cpu_us(indices.size());
    stage.set_economy(false);
    for (std::uint32_t i = 0; i < options.timed_frames + kTimingLag; ++i) {
        stage.run_frame();
        if (i < kTimingLag) continue;
        for (std::size_t k = 0; k < indices.size(); ++k) {
            const LightReport& report = stage.frame().report().lights[indices[k]];
            cpu_us[k].push_back(report.cpu_us);
            if (report.gpu_us) gpu_us[k].push_back(*report.gpu_us);
        }
    }
    std::vector<float> redrawn;
    for (std::size_t k = 0; k < indices.size(); ++k) {
        LightAccuracy& light = accuracy.lights[k];
        light.redrawn_differs = options.noise_rounds > 1 ? 0 : light.measured.size();
        if (options.noise_rounds <= 1 && stage.frame().read_visibility(indices[k], redrawn) &&
            redrawn.size() == light.measured.size())
            light.redrawn_differs = count_differing(light.measured, redrawn);
        light.gpu_us = spread_of(gpu_us[k]);
        light.cpu_us = spread_of(cpu_us[k]);
    }
}

}  // namespace

Result<Accuracy> measure_accuracy(Stage& stage, const AccuracyOptions& options) {
    Accuracy accuracy;
    accuracy.scene = stage.scene_name();
    accuracy.device = stage.device().info().name;
    // What is judged are lookups, and what a light holds its maps.
    (void)stage.apply_setting("keep_visibility=off");
    for (int i = 0; i < kSettlingFrames; ++i) stage.run_frame();
    std::vector<std::uint32_t> indices;
    if (!stage.frame().snapshot().consumers.empty())
        accuracy.size_px = stage.frame().snapshot().consumers.front().viewport_px;
    if (auto error = read_lights(stage, accuracy, indices)) return *error;
    if (options.noise_rounds > 1)
        if (auto error = average_noise(stage, options.noise_rounds, indices, accuracy)) return *error;
    trace_truth(stage, options, indices, accuracy);
    if (auto error = judge_air(stage, indices, accuracy)) return *error;
    if (options.timed_frames > 0) time_lights(stage, options, indices, accuracy);
    accuracy.gl_complaints = stage.gl_complaints();
    return accuracy;
}

}  // namespace gnomon::bench
