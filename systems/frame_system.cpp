#include "systems/frame_system.h"

#include <algorithm>
#include <chrono>

#include "engine/core/zone.h"
#include "systems/after_submission.h"
#include "systems/debug/debug_painter.h"
#include "systems/extract/names.h"
#include "systems/lighting/lighting_system.h"
#include "systems/shadow/shadow_system.h"

namespace gnomon {

Result<std::unique_ptr<FrameSystem>> FrameSystem::create(gl::Device& device, const assets::MeshLibrary& library,
                                                         const shadow::History& fit_history) {
    auto scene = GpuScene::create(device, library);
    if (!scene) return scene.error();
    return std::unique_ptr<FrameSystem>(new FrameSystem(device, library, fit_history, std::move(scene).value()));
}

FrameSystem::FrameSystem(gl::Device& device, const assets::MeshLibrary& library, const shadow::History& fit_history,
                         GpuScene scene)
    : device_(device),
      library_(library),
      gpu_scene_(std::move(scene)),
      shadows_(std::make_unique<shadow::ShadowSystem>(device, fit_history)),
      lighting_(std::make_unique<lighting::LightingSystem>(device)),
      debug_(std::make_unique<debug::DebugPainter>(device)) {
    feedback_.spare = &lighting_->spare();
}

FrameSystem::~FrameSystem() = default;

const shadow::History& FrameSystem::fit_history() const { return shadows_->fit_history(); }

void FrameSystem::run(ecs::Registry& world, const FrameSettings& settings) {
    GNOMON_ZONE("gnomon::Frame::run");
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t compiled_before = device_.compiled_programs();
    commands_.clear();
    report_.clear();

    const TransformReport& transforms = transforms_.update(world);
    gpu_scene_.update_meshes(commands_);
    extractor_.update(world, library_, transforms, settings.viewport_px, snapshot_, gpu_scene_.lacking_meshes());
    report_.dropped = snapshot_.dropped;
    const bool held = frozen_.has_value() && settings.freeze_fits;
    if (!held) lighting_->collect_depths(feedback_.sampled_depths);
    if (!gpu_scene_.update(snapshot_, commands_))
        for (const InstanceItem& item : snapshot_.instances)
            if (item.gpu_slot >= gpu_scene_.capacity())
                report_.dropped.push_back({item.entity, name_of(world, item.entity), DropReason::instances_full});
    feedback_.exposure = most_exposure(settings);
    const shadow::ShadowFrame& shadows = update_shadows(settings);
    const bool sample_depths = !held && shadows_->wants_sampled_depths(snapshot_);
    if (!sample_depths && !held) feedback_.sampled_depths = {};  // outdated when needed next
    const bool measure_exposure =
        settings.leave_out_dim_lights && !settings.exposure_ev && shadows_->contribution_culling().wants_exposure();
    if (!measure_exposure) lighting_->forget_exposure();
    outcome_.clear();
    has_picture_ =
        !shadows.inputs.empty() && lighting_->record(shadows.inputs.front(), snapshot_, gpu_scene_,
                                                     {settings.exposure_ev, settings.programs_per_frame,
                                                      measure_exposure, sample_depths, shadows_->maps().room()},
                                                     commands_, outcome_);
    shadows_->report(snapshot_, outcome_, report_);
    if (has_picture_) {
        const ConsumerItem* fitted = frozen_ && !frozen_->empty() ? &frozen_->front() : nullptr;
        debug_->record(settings.debug, {snapshot_, shadows, gpu_scene_, *lighting_, fitted}, commands_);
    }
    if (has_picture_ && settings.present) {
        const gl::Rect all{0, 0, static_cast<std::int32_t>(settings.viewport_px.x),
                           static_cast<std::int32_t>(settings.viewport_px.y)};
        commands_.add(gl::Blit{lighting_->picture_target(), {}, all, all});
    }
    report_.programs_compiled = device_.compiled_programs() - compiled_before;
    report_.cpu_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();

    const gl::SubmitResult result = device_.submit(commands_);
    if (settings.repeatable && (sample_depths || measure_exposure)) device_.finish();
    timed_lights_.submitted(result.submission, report_);
    // Measured times differ from run to run.
    const bool learn_costs = settings.shadow_budget.gpu_ms > 0.0f && !settings.repeatable;
    timed_lights_.tell(
        after_submission({device_, snapshot_, gpu_scene_, *shadows_, lighting_.get()}, result, learn_costs, report_),
        report_);
}

/// Returns the largest factor of the picture's radiance; empty: unknown, or not needed.
std::optional<double> FrameSystem::most_exposure(const FrameSettings& settings) {
    if (!settings.leave_out_dim_lights) return std::nullopt;
    if (settings.exposure_ev) return lighting::exposure_scale(*settings.exposure_ev);
    return lighting_->most_exposure(snapshot_.consumers.empty() ? ecs::Entity{} : snapshot_.consumers.front().entity);
}

/// Updates the shadows. While fits are frozen, the stages see the frozen cameras as the scene's consumers.
const shadow::ShadowFrame& FrameSystem::update_shadows(const FrameSettings& settings) {
    const auto update = [&]() -> const shadow::ShadowFrame& {
        return shadows_->update(snapshot_, gpu_scene_,
                                {settings.shadows, settings.shadow_budget, feedback_, settings.rays}, commands_,
                                report_);
    };
    if (!settings.freeze_fits) frozen_.reset();
    if (!settings.freeze_fits || snapshot_.consumers.empty()) return update();
    if (!frozen_) frozen_ = snapshot_.consumers;
    pictures_ = snapshot_.consumers;
    std::swap(snapshot_.pictures, pictures_);  // swapped, so that names keep their memory from frame to frame
    std::swap(snapshot_.consumers, *frozen_);
    const shadow::ShadowFrame& shadows = update();
    std::swap(snapshot_.consumers, *frozen_);
    std::swap(snapshot_.pictures, pictures_);
    return shadows;
}

gl::TargetHandle FrameSystem::picture_target() const {
    return has_picture_ ? lighting_->picture_target() : gl::TargetHandle{};
}

gl::TextureHandle FrameSystem::picture_texture() const {
    return has_picture_ ? lighting_->picture_texture() : gl::TextureHandle{};
}

const std::vector<debug::Label>& FrameSystem::debug_labels() const { return debug_->labels(); }

bool FrameSystem::read_picture(std::vector<std::uint8_t>& rgba) {
    if (!has_picture_) return false;
    const glm::uvec2 size = lighting_->size_px();
    const std::size_t row = std::size_t{size.x} * 4;
    std::vector<std::uint8_t> upward(row * size.y);
    if (!device_.read_texture(lighting_->picture_texture(), 0, std::as_writable_bytes(std::span(upward)))) return false;
    rgba.resize(upward.size());
    for (std::size_t y = 0; y < size.y; ++y)
        std::copy_n(upward.begin() + static_cast<std::ptrdiff_t>((size.y - 1 - y) * row), row,
                    rgba.begin() + static_cast<std::ptrdiff_t>(y * row));
    return true;
}

bool FrameSystem::read_visibility(std::uint32_t light, std::vector<float>& values) {
    if (!has_picture_) return false;
    gl::CommandList list;
    if (!lighting_->record_visibility(shadows_->frame().inputs.front(), light, gpu_scene_, list)) return false;
    if (device_.submit(list).failure != gl::Failure::none) return false;
    values.resize(std::size_t{lighting_->size_px().x} * lighting_->size_px().y);
    return device_.read_texture(lighting_->visibility_texture(), 0, std::as_writable_bytes(std::span(values)));
}

}  // namespace gnomon
