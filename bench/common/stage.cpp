#include "bench/common/stage.h"

#include <chrono>
#include <cstdio>

#include "bench/frame/animate_all.h"
#include "engine/gl/device_gl45.h"
#include "gnomon/light.h"
#include "sample_game/support/scene/mist.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/scene_proxies.h"

namespace gnomon::bench {

Result<std::unique_ptr<Stage>> Stage::open(const StageOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    auto scene = game::load_scene(options.scene);
    if (!scene) return scene.error();
    std::unique_ptr<Stage> stage(new Stage);
    if (auto error = stage->spawn(options, std::move(scene).value())) return *error;
    stage->load_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (auto error = stage->prepare(options)) return *error;
    return stage;
}

Result<std::unique_ptr<Stage>> Stage::open(const StageOptions& options, assets::SceneData scene) {
    std::unique_ptr<Stage> stage(new Stage);
    if (auto error = stage->spawn(options, std::move(scene))) return *error;
    if (auto error = stage->prepare(options)) return *error;
    return stage;
}

Stage::~Stage() = default;

std::optional<Error> Stage::spawn(const StageOptions& options, assets::SceneData scene) {
    for (assets::Node& node : scene.nodes)
        if (node.parent == assets::kNone) node.translation_m += options.offset_m;
    options_ = options;
    scene_name_ = options.scene ? options.scene->string() : "built-in";
    spawned_ = game::spawn_scene(std::move(scene), world_, library_);
    time_s_ = options.time_s;
    moving_ = everything_moving(spawned_, world_);
    game::set_time(spawned_, time_s_, world_);
    for (const std::string& setting : options.settings)
        if (auto error = apply_setting(setting)) return error;
    game::provide_proxies(spawned_, world_, library_);
    ecs::Entity mist = ecs::kNull;
    game::set_mist(spawned_.bounds_ws, options.mist_per_m, mist, world_);
    for (const game::NamedEntity& light : spawned_.lights)
        if (const auto opened = game::settings_of(world_, light.entity)) opened_.emplace_back(light.entity, *opened);
    if (!options.camera) return std::nullopt;
    const auto camera = game::find_camera(spawned_, *options.camera);
    if (!camera) return camera.error();
    game::activate_camera(spawned_, camera.value(), world_);
    return std::nullopt;
}

std::optional<Error> Stage::prepare(const StageOptions& options) {
    auto context = platform::make_headless_context(false);
    if (!context) return context.error();
    context_ = std::move(context).value();
    auto device = gl::make_gl45_device([this](gl::MessageSeverity severity, std::string_view text) {
        if (severity < gl::MessageSeverity::medium) return;
        ++gl_complaints_;
        std::fprintf(stderr, "OpenGL: %.*s\n", static_cast<int>(text.size()), text.data());
    });
    if (!device) return device.error();
    device_ = std::move(device).value();
    device_->set_timing(device_->info().is_software ? gl::TimingMode::finish : gl::TimingMode::query);
    auto frame = FrameSystem::create(*device_, library_);
    if (!frame) return frame.error();
    frame_ = std::move(frame).value();
    settings_.viewport_px = options.size_px;
    settings_.repeatable = true;
    return std::nullopt;
}

void Stage::run_frame() {
    frame_->run(world_, settings_);
    const gl::Failure failure = frame_->report().failure;
    if (failure != gl::Failure::none)
        throw FailedFrame({std::string("the frame failed: ") + gl::to_text(failure), {}, {}, "bench.frame"});
}

std::optional<Error> Stage::apply_setting(const std::string& key_value) {
    game::LightSettings probe;
    if (auto error = game::apply_setting(probe, key_value)) return error;
    for (const game::NamedEntity& light : spawned_.lights)
        game::change_settings(world_, light.entity,
                              [&](game::LightSettings& settings) { (void)game::apply_setting(settings, key_value); });
    return std::nullopt;
}

std::optional<Error> Stage::start_over(std::span<const std::string> settings, LightKinds kinds) {
    game::LightSettings probe;
    for (const std::string& setting : settings)
        if (auto error = game::apply_setting(probe, setting)) return error;
    for (const auto& [entity, opened] : opened_) {
        game::put_settings(world_, entity, opened);  // a light's size stays when its shadow goes
        world_.remove<LightShadow>(entity);
    }
    run_frame();
    for (const auto& [entity, opened] : opened_) {
        const auto* light = world_.get<Light>(entity);
        if (!light || !holds(kinds, light->kind)) continue;
        game::LightSettings now = opened;
        for (const std::string& setting : settings) (void)game::apply_setting(now, setting);
        now.tuning.reuse.keep_visibility = false;
        game::put_settings(world_, entity, now);
    }
    return std::nullopt;
}

void Stage::set_economy(bool on) {
    for (const game::NamedEntity& light : spawned_.lights)
        game::change_settings(world_, light.entity,
                              [on](game::LightSettings& settings) { settings.tuning.reuse.economy = on; });
}

}  // namespace gnomon::bench
