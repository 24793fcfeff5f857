#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/common/configuration.h"
#include "engine/gl/device.h"
#include "engine/platform/context.h"
#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "gnomon/result.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/frame_system.h"

namespace gnomon::bench {

struct StageOptions {
    std::optional<std::filesystem::path> scene;  // empty: the built-in scene
    std::optional<std::string> camera;           // name or index; empty: the first
    glm::uvec2 size_px{1280, 720};
    std::vector<std::string> settings;  // KEY=VALUE, for every light with a shadow
    double time_s = 0.0;                // scene time
    glm::dvec3 offset_m{0.0};           // moves the whole scene
    float mist_per_m = 0.0f;            // fog in all of the scene, as game::set_mist(); 0: none
};

/// Frame that the device did not draw.
struct FailedFrame : std::runtime_error {
    explicit FailedFrame(Error why) : std::runtime_error(to_line(why)), error(std::move(why)) {}
    Error error;  // "bench.frame"
};

/// The real pipeline on a headless context, with a scene spawned and still.
class Stage {
public:
    /// Errors: those of the loader, the context and the device; "set.*"; "camera.unknown".
    static Result<std::unique_ptr<Stage>> open(const StageOptions& options);
    /// Opens a stage with a scene that was made, not loaded; `options.scene` is its name.
    static Result<std::unique_ptr<Stage>> open(const StageOptions& options, assets::SceneData scene);
    ~Stage();

    /// Runs a frame. Throws FailedFrame if the device failed: a measurement of what was not drawn would lie.
    void run_frame();
    /// Moves everything in the scene to where it is at that time, see everything_moving(). Before the first call only
    /// nodes that the file moves have left their places.
    void move_to(double time_s) {
        game::apply_motion(moving_, time_s, world_);
        game::play(spawned_.played, time_s, world_);
    }
    void show_shadows(bool on) { settings_.shadows = on; }
    void use_rays(bool on) { settings_.rays = on; }
    void set_size(glm::uvec2 size_px) { settings_.viewport_px = size_px; }
    void set_noise_frame(std::uint32_t frame) { settings_.noise_frame = frame; }
    void set_economy(bool on);
    /// Applies "KEY=VALUE" to every light with a shadow. Errors: "set.*".
    std::optional<Error> apply_setting(const std::string& key_value);
    /// Resets every light of these kinds to how the scene was opened, with these settings. Lights of other kinds cast
    /// no shadows. Runs a frame without shadows in between, so that neither fits nor maps keep any history. Lights are
    /// looked up in every frame, also still ones (ShadowTuning::Reuse::keep_visibility): otherwise rows would not
    /// differ. Errors: "set.*"; then nothing is changed.
    std::optional<Error> start_over(std::span<const std::string> settings, LightKinds kinds = kAllKinds);

    FrameSystem& frame() { return *frame_; }
    gl::Device& device() { return *device_; }
    const assets::MeshLibrary& library() const { return library_; }
    ecs::Registry& world() { return world_; }
    const FrameSettings& settings() const { return settings_; }
    double time_s() const { return time_s_; }  // time of the scene when it was opened
    const game::SpawnedScene& spawned() const { return spawned_; }
    const std::string& scene_name() const { return scene_name_; }
    const StageOptions& options() const { return options_; }
    double load_s() const { return load_s_; }                       // file to entities; 0: it was made
    std::uint32_t gl_complaints() const { return gl_complaints_; }  // debug messages of medium or high severity

private:
    Stage() = default;
    std::optional<Error> spawn(const StageOptions& options, assets::SceneData scene);
    std::optional<Error> prepare(const StageOptions& options);

    std::unique_ptr<platform::Context> context_;
    std::unique_ptr<gl::Device> device_;
    ecs::Registry world_;
    assets::MeshLibrary library_;
    game::SpawnedScene spawned_;
    std::vector<game::MovingEntity> moving_;
    std::vector<std::pair<ecs::Entity, game::LightSettings>> opened_;  // as the scene and the options have them
    FrameSettings settings_;
    std::unique_ptr<FrameSystem> frame_;
    StageOptions options_;
    std::string scene_name_;
    double time_s_ = 0.0, load_s_ = 0.0;
    std::uint32_t gl_complaints_ = 0;
};

}  // namespace gnomon::bench
