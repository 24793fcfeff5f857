#include "bench/draws/draw_costs.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <variant>

#include "bench/scaling/many_lights_scene.h"
#include "bench/text/printf_string.h"
#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/passes/depth_pass.h"
#include "systems/shadow/request/map_textures.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kMap_px = 64, kWarmFrames = 3, kMirroredOf = 10;
constexpr double kSpacing_m = 2.0, kHeight_m = 50.0;

struct Kind {
    const char* name;
    bool triangles, parallel;
};
constexpr std::array kKinds{Kind{"depths, parallel light", false, true}, Kind{"depths, lamp", false, false},
                            Kind{"triangles, lamp", true, false}};

/// Makes boxes, each a mesh of its own: every other one is known to be solid.
assets::MeshLibrary boxes(std::uint32_t count) {
    assets::MeshLibrary library;
    library.materials.emplace_back();
    const assets::Mesh solid = box_mesh("box", glm::dvec3(-0.5), glm::dvec3(0.5));
    assets::Mesh open = solid;
    open.topology = {};
    for (std::uint32_t i = 0; i < count; ++i) library.meshes.push_back(i % 2 == 0 ? open : solid);
    return library;
}

SceneSnapshot scene_of(const DrawCostOptions& options) {
    SceneSnapshot scene;
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(options.casters))));
    for (std::uint32_t i = 0; i < options.casters; ++i) {
        InstanceItem item;
        item.mesh = item.gpu_slot = i;
        const glm::dvec2 cell(i % side, i / side);
        const glm::dvec2 at = kSpacing_m * (cell - 0.5 * (static_cast<double>(side) - 1.0));
        item.translation_ws_m = {at.x, 0.0, at.y};
        item.winding.mirrored = i % kMirroredOf == 1;
        if (item.winding.mirrored) item.basis[0][0] = -1.0;
        item.bounds_ws = {item.translation_ws_m - 0.5, item.translation_ws_m + 0.5};
        item.casts = true;
        scene.instances.push_back(item);
        scene.changed_instances.push_back(i);
    }
    scene.gpu_slot_count = options.casters;
    for (std::uint32_t v = 0; v < options.views; ++v) {
        LightItem light;
        light.has_shadow = true;
        light.name = "light";
        scene.lights.push_back(light);
    }
    return scene;
}

double elapsed_us(std::chrono::steady_clock::time_point from) {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - from).count();
}

/// Takes every instance out of the draws of a list.
void empty_draws(gl::CommandList& list) {
    std::vector<gl::BufferHandle> records;
    for (gl::Command& command : list.commands) {
        if (auto* draw = std::get_if<gl::DrawMeshes>(&command)) draw->item_count = 0;
        if (const auto* many = std::get_if<gl::DrawMeshesIndirect>(&command)) records.push_back(many->records);
    }
    for (const gl::Command& command : list.commands) {
        const auto* upload = std::get_if<gl::UpdateBuffer>(&command);
        if (!upload || records.empty() || upload->buffer != records.front()) continue;
        for (std::uint32_t at = 0; at < upload->size; at += sizeof(gl::MeshDrawRecord))
            std::memset(list.bytes.data() + upload->first + at + offsetof(gl::MeshDrawRecord, item_count), 0,
                        sizeof(std::uint32_t));
    }
}

/// Views of one kind on a device, one light each, that all show all casters.
class Views {
public:
    Views(gl::Device& device, const GpuScene& gpu, SceneSnapshot& scene, const Kind& kind)
        : device_(device), gpu_(gpu), scene_(scene), pass_(device) {
        const auto count = static_cast<std::uint32_t>(scene.lights.size());
        const auto casters = static_cast<std::uint32_t>(scene.instances.size());
        for (std::uint32_t i = 0; i < casters; ++i) fitted_.casters.push_back(i);
        const double reach_m = kSpacing_m * std::sqrt(static_cast<double>(casters));
        for (std::uint32_t v = 0; v < count; ++v) {
            shadow::ShadowView view;
            view.light = v;
            view.casters = {0, casters};
            view.static_casters = casters;
            view.projection =
                kind.parallel ? shadow::ViewProjection::orthographic : shadow::ViewProjection::perspective;
            view.pose.axis_back = {0.0, 1.0, 0.0};
            view.pose.apex_m = kHeight_m;
            // Looks down on the plain: x and z across the map, y to depth.
            view.clip_from_anchor = glm::mat4(0.0f);
            view.clip_from_anchor[0][0] = view.clip_from_anchor[2][1] = static_cast<float>(1.0 / reach_m);
            view.clip_from_anchor[1][2] = 0.25f;
            view.clip_from_anchor[3] = {0.0f, 0.0f, 0.5f, 1.0f};
            fitted_.views.push_back(view);
            fitted_.lights.emplace_back().views = {v, 1};
            shadow::MapAssignment& map = maps_.emplace_back();
            map.size_px = kMap_px;
            map.texture = layer(gl::Format::d32f);
            if (kind.triangles) map.triangles = layer(shadow::kTriangleFormat);
            gl::TargetDesc target{.label = "map", .colours = {}, .depth = {map.texture, 0}};
            if (kind.triangles) target.colours.push_back({map.triangles, 0});
            map.target = device_.create_target(target).handle;
        }
        decisions_.resize(count);
        updates_.resize(count);
        statuses_.resize(count);
    }
    ~Views() {
        for (const shadow::MapAssignment& map : maps_) {
            device_.destroy(map.target);
            device_.destroy(map.texture);
            device_.destroy(map.triangles);
        }
    }
    Views(const Views&) = delete;
    Views& operator=(const Views&) = delete;

    /// Returns false if the device failed, or a view could not be drawn.
    bool measure(const DrawCostOptions& options, DrawCost& cost) {
        for (LightItem& light : scene_.lights) light.tuning.maps.multi_draw = cost.multi_draw;
        std::vector<double> record_us, submit_us, drawn_us;
        for (std::uint32_t frame = 0; frame < kWarmFrames + options.frames; ++frame) {
            const std::array us{record(), submit(true), submit(false)};
            if (us[1] < 0.0 || us[2] < 0.0) return false;
            if (frame < kWarmFrames) continue;
            record_us.push_back(us[0]);
            submit_us.push_back(us[1]);
            drawn_us.push_back(us[2]);
        }
        for (const LightReport& light : report_.lights) {
            cost.draws += light.counts.draws;
            cost.commands += light.counts.draw_commands;
        }
        cost.upload_bytes = list_.bytes.size();
        cost.record_us = spread_of(record_us);
        cost.submit_us = spread_of(submit_us);
        cost.drawn_us = spread_of(drawn_us);
        return cost.draws == std::uint64_t{options.casters} * options.views;
    }

private:
    gl::TextureHandle layer(gl::Format format) {
        return device_
            .create_texture(
                {.label = "map", .kind = gl::TextureKind::array, .format = format, .width = kMap_px, .height = kMap_px},
                {})
            .handle;
    }
    double record() {
        list_.clear();
        report_.lights.assign(scene_.lights.size(), {});
        const shadow::DrawnViews drawn{fitted_, decisions_, maps_, updates_, statuses_};
        const shadow::PassInputs in{scene_, gpu_, drawn};
        const auto start = std::chrono::steady_clock::now();
        pass_.prepare(in, {statuses_, {}});
        pass_.record(in, {list_, report_, {}});
        return elapsed_us(start);
    }
    double submit(bool without_draws) {
        gl::CommandList emptied;
        if (without_draws) {
            emptied = list_;
            empty_draws(emptied);
        }
        device_.finish();
        const auto start = std::chrono::steady_clock::now();
        const bool done = device_.submit(without_draws ? emptied : list_).failure == gl::Failure::none;
        if (!without_draws) device_.finish();
        return done ? elapsed_us(start) : -1.0;
    }

    gl::Device& device_;
    const GpuScene& gpu_;
    SceneSnapshot& scene_;
    shadow::DepthPass pass_;
    shadow::FittedViews fitted_;
    std::vector<shadow::BudgetDecision> decisions_;
    std::vector<shadow::MapAssignment> maps_;
    std::vector<shadow::UpdatePlan> updates_;
    std::vector<shadow::LightStatus> statuses_;
    FrameReport report_;
    gl::CommandList list_;
};

nlohmann::ordered_json to_json(const Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"count", spread.count}};
}

}  // namespace

Result<DrawCosts> measure_draw_costs(const DrawCostOptions& options) {
    auto context = platform::make_headless_context(false);
    if (!context) return context.error();
    auto device = gl::make_gl45_device({});
    if (!device) return device.error();
    gl::Device& gl = *device.value();
    const assets::MeshLibrary library = boxes(options.casters);
    SceneSnapshot scene = scene_of(options);
    auto gpu = GpuScene::create(gl, library);
    if (!gpu) return gpu.error();
    gl::CommandList uploads;
    gpu.value().update(scene, uploads);
    const Error undrawn{"the device did not draw", {}, {}, "bench.frame"};
    if (gl.submit(uploads).failure != gl::Failure::none) return undrawn;
    DrawCosts costs{gl.info().name, options, {}};
    for (const Kind& kind : kKinds) {
        Views views(gl, gpu.value(), scene, kind);
        for (const bool multi_draw : {false, true}) {
            DrawCost& cost = costs.rows.emplace_back();
            cost.maps = kind.name;
            cost.multi_draw = multi_draw;
            if (!views.measure(options, cost)) return undrawn;
        }
    }
    return costs;
}

std::string draw_costs_markdown(const DrawCosts& costs) {
    std::string text = "Device: " + costs.device + ". " +
                       formatted("%u casters, each a mesh of its own, in each of %u views. Medians of %u frames.\n\n",
                                 costs.options.casters, costs.options.views, costs.options.frames);
    text +=
        "| maps | multi_draw | draws | commands | KiB uploaded | recording, ms | submitting, ms | with the device's "
        "draws, "
        "ms |\n|---|---|---|---|---|---|---|---|\n";
    for (const DrawCost& row : costs.rows)
        text += formatted("| %s | %s | %llu | %llu | %llu | %.2f | %.2f | %.1f |\n", row.maps,
                          row.multi_draw ? "on" : "off", static_cast<unsigned long long>(row.draws),
                          static_cast<unsigned long long>(row.commands),
                          static_cast<unsigned long long>(row.upload_bytes / 1024), row.record_us.median / 1000.0,
                          row.submit_us.median / 1000.0, row.drawn_us.median / 1000.0);
    return text;
}

std::string draw_costs_json(const DrawCosts& costs) {
    nlohmann::ordered_json json;
    json["device"] = costs.device;
    json["casters"] = costs.options.casters;
    json["views"] = costs.options.views;
    json["rows"] = nlohmann::ordered_json::array();
    for (const DrawCost& row : costs.rows)
        json["rows"].push_back({{"maps", row.maps},
                                {"multi_draw", row.multi_draw},
                                {"draws", row.draws},
                                {"draw_commands", row.commands},
                                {"upload_bytes", row.upload_bytes},
                                {"record_us", to_json(row.record_us)},
                                {"submit_us", to_json(row.submit_us)},
                                {"drawn_us", to_json(row.drawn_us)}});
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::bench
