#include "bench/scaling/redraws.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

#include "bench/flicker/camera_path.h"
#include "engine/gl/device_recording.h"
#include "engine/math/frustum.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"

namespace gnomon::bench {
namespace {

constexpr std::array kFits = {"tight", "stable", "quantised"};
constexpr std::array kPaths = {"still", "walk", "pan"};
/// Frames after which resting casters count as still, and unused maps are freed.
constexpr std::uint32_t kRestFrames = 100;
/// Distance of what the camera looks at. The walk goes half of it: 1.4 m/s over five seconds.
constexpr double kLookedAt_m = 14.0;
constexpr double kMoverSize_m = 0.3, kMoverPeriod_frames = 240.0;
constexpr double kNearLamp = 0.15, kNearGround = 0.9;  // shares of the mover's way

/// Counts of one light, summed over frames.
struct Counts {
    LightKind kind = LightKind::point;
    std::uint64_t drawn = 0, anew = 0, refitted = 0;
};

/// The scene and the shadow system, without pictures.
class Runner {
public:
    static Result<std::unique_ptr<Runner>> open(const StageOptions& options, const std::string& fit, bool mover) {
        auto scene = game::load_scene(options.scene);
        if (!scene) return scene.error();
        auto runner = std::make_unique<Runner>();
        runner->spawned_ = game::spawn_scene(std::move(scene).value(), runner->world_, runner->library_);
        runner->viewport_px_ = options.size_px;
        if (options.camera) {
            const auto camera = game::find_camera(runner->spawned_, *options.camera);
            if (!camera) return camera.error();
            game::activate_camera(runner->spawned_, camera.value(), runner->world_);
        }
        std::vector<std::string> settings = options.settings;
        settings.push_back("fit=" + fit);
        for (const std::string& setting : settings) {
            game::LightSettings probe;
            if (auto error = game::apply_setting(probe, setting)) return *error;
            for (const game::NamedEntity& light : runner->spawned_.lights)
                game::change_settings(runner->world_, light.entity, [&](game::LightSettings& settings_of_light) {
                    (void)game::apply_setting(settings_of_light, setting);
                });
        }
        auto gpu = GpuScene::create(runner->device_, runner->library_);
        if (!gpu) return gpu.error();
        runner->gpu_ = std::make_unique<GpuScene>(std::move(gpu).value());
        runner->shadows_ = std::make_unique<shadow::ShadowSystem>(runner->device_);
        runner->run_frame();
        runner->start_ = runner->snapshot_.consumers.front();
        if (mover) runner->add_mover();
        for (std::uint32_t i = 0; i < kRestFrames; ++i) runner->run_frame();
        return runner;
    }
    ~Runner() {
        shadows_.reset();
        gpu_.reset();
    }

    std::map<std::string, Counts> run(const std::string& path, std::uint32_t frames) {
        for (std::uint32_t i = 1; i <= frames; ++i) {
            if (path != "still") {
                const ConsumerItem at = on_path(start_, path, static_cast<double>(i) / frames, kLookedAt_m);
                world_.patch<Transform>(camera(), [&](Transform& t) { t = transform_of(at); });
            }
            if (mover_ != ecs::kNull) {
                const double way = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / kMoverPeriod_frames);
                move_to(kNearLamp + (kNearGround - kNearLamp) * way);
            }
            run_frame();
            count();
        }
        return std::exchange(counts_, {});
    }

private:
    ecs::Entity camera() const { return start_.entity; }

    /// Adds the mover: the smallest closed mesh of the scene, scaled to kMoverSize_m, between the first point light and
    /// what the camera looks at.
    void add_mover() {
        std::uint32_t mesh = 0;
        for (std::uint32_t m = 0; m < library_.meshes.size(); ++m)
            if (library_.meshes[m].topology.closed &&
                library_.meshes[m].indices.size() < library_.meshes[mesh].indices.size())
                mesh = m;
        for (const LightItem& light : snapshot_.lights)
            if (light.kind == LightKind::point) lamp_ws_m_ = light.position_ws_m;
        ground_ws_m_ = start_.position_ws_m - 0.5 * kLookedAt_m * start_.rotation_ws[2];
        mover_ = world_.create();
        const double size_m = glm::length(2.0 * math::half_extent(library_.meshes[mesh].bounds_ms));
        world_.emplace<Transform>(mover_, {.scale = glm::dvec3(kMoverSize_m / size_m)});
        world_.emplace<MeshRef>(mover_, {.mesh = mesh});
        world_.emplace<ShadowCaster>(mover_);
        move_to(kNearGround);
    }
    void move_to(double share) {
        world_.patch<Transform>(
            mover_, [&](Transform& t) { t.translation_m = lamp_ws_m_ + share * (ground_ws_m_ - lamp_ws_m_); });
    }

    void run_frame() {
        const TransformReport& transforms = transforms_.update(world_);
        extractor_.update(world_, library_, transforms, viewport_px_, snapshot_);
        list_.clear();
        report_.clear();
        gpu_->update(snapshot_, list_);
        shadows_->update(snapshot_, *gpu_, {}, list_, report_);
        (void)device_.submit(list_);
        device_.forget();
        held_ = shadows_->fit_history();
        shadows_->commit(snapshot_, true);
    }

    void count() {
        const shadow::DrawnViews frame = shadow::drawn_views(shadows_->frame());
        for (std::size_t v = 0; v < frame.count(); ++v) {
            const shadow::ShadowView& view = frame.view(v);
            const std::uint32_t light = view.light;
            if (!frame.has_map(v) || view.lit) continue;
            Counts& counts = counts_[snapshot_.lights[light].name];
            counts.kind = snapshot_.lights[light].kind;
            std::uint64_t& still = still_content_[{light, view.layer}];
            counts.drawn += frame.is_drawn(v);
            counts.anew += frame.is_drawn(v) && frame.maps[v].content.still != still;
            still = frame.maps[v].content.still;
        }
        for (std::size_t i = 0; i < snapshot_.lights.size(); ++i) {
            const shadow::LightFitHistory* before = find(held_, snapshot_.lights[i].entity, i);
            const shadow::LightFitHistory* after = find(shadows_->fit_history(), snapshot_.lights[i].entity, i);
            if (!before || !after) continue;
            for (std::size_t v = 0; v < shadow::kHistoryViews; ++v)
                counts_[snapshot_.lights[i].name].refitted += before->views[v] != after->views[v];
        }
    }

    gl::RecordingDevice device_;
    ecs::Registry world_;
    assets::MeshLibrary library_;
    game::SpawnedScene spawned_;
    TransformSystem transforms_;
    Extractor extractor_;
    std::unique_ptr<GpuScene> gpu_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    SceneSnapshot snapshot_;
    gl::CommandList list_;
    FrameReport report_;
    glm::uvec2 viewport_px_{0, 0};
    ConsumerItem start_;
    ecs::Entity mover_ = ecs::kNull;
    glm::dvec3 lamp_ws_m_{0.0}, ground_ws_m_{0.0};
    shadow::History held_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> still_content_;
    std::map<std::string, Counts> counts_;
};

std::string row(const std::string& fit, const std::string& path, bool mover, const std::string& light,
                const Counts& counts, std::uint32_t frames) {
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %s | %s | %s | %.3f | %.3f | %llu |\n", fit.c_str(), path.c_str(),
                  mover ? "one" : "none", light.c_str(), static_cast<double>(counts.drawn) / frames,
                  static_cast<double>(counts.anew) / frames, static_cast<unsigned long long>(counts.refitted));
    return text;
}

}  // namespace

Result<std::string> redraws_table(const StageOptions& options, std::uint32_t frames) {
    std::string table =
        "| fit | camera | mover | light | views drawn per frame | of them with other still casters | fits that changed "
        "|\n"
        "|---|---|---|---|---|---|---|\n";
    for (const char* fit : kFits)
        for (const char* path : kPaths)
            for (const bool mover : {false, true}) {
                auto runner = Runner::open(options, fit, mover);
                if (!runner) return runner.error();
                // The fit is a sun's: other lights would say the same three times.
                for (const auto& [light, counts] : runner.value()->run(path, frames))
                    if (counts.kind == LightKind::directional || fit == kFits.back())
                        table += row(fit, path, mover, light, counts, frames);
            }
    return table;
}

}  // namespace gnomon::bench
