#include "systems/frame_system.h"

#include <algorithm>
#include <chrono>

#include "engine/core/zone.h"
#include "systems/after_submission.h"
#include "systems/debug/debug_painter.h"
#include "systems/extract/names.h"
#include "systems/lighting/lighting_system.h"
#include "systems/picture/edge_smoothing.h"
#include "systems/picture/picture_changes.h"
#include "systems/picture/picture_samples.h"
#include "systems/shadow/shadow_system.h"

namespace gnomon {
namespace {

/// Samples from which on a picture's mean needs no smoothing.
constexpr std::uint32_t kSmoothSamples = 8;

}  // namespace

Result<std::unique_ptr<FrameSystem>> FrameSystem::create(gl::Device& device, const assets::MeshLibrary& library,
                                                         const shadow::History& fit_history, Jobs* jobs) {
    auto scene = GpuScene::create(device, library);
    if (!scene) return scene.error();
    return std::unique_ptr<FrameSystem>(new FrameSystem(device, library, fit_history, jobs, std::move(scene).value()));
}

FrameSystem::FrameSystem(gl::Device& device, const assets::MeshLibrary& library, const shadow::History& fit_history,
                         Jobs* jobs, GpuScene scene)
    : device_(device),
      library_(library),
      gpu_scene_(std::move(scene)),
      shadows_(std::make_unique<shadow::ShadowSystem>(device, fit_history, jobs)),
      lighting_(std::make_unique<lighting::LightingSystem>(device)),
      changes_(std::make_unique<picture::PictureChanges>()),
      samples_(std::make_unique<picture::PictureSamples>(device)),
      smoothing_(std::make_unique<picture::EdgeSmoothing>(device)),
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
    const bool frozen = frozen_.has_value() && settings.freeze_fits;
    if (!frozen) lighting_->collect_depths(feedback_.sampled_depths);
    if (!gpu_scene_.update(snapshot_, commands_))
        for (const InstanceItem& item : snapshot_.instances)
            if (item.gpu_slot >= gpu_scene_.capacity())
                report_.dropped.push_back({item.entity, name_of(world, item.entity), DropReason::instances_full});
    feedback_.exposure = most_exposure(settings);
    const shadow::ShadowFrame& shadows = update_shadows(settings);
    const bool reads_back = record_picture(shadows, settings, frozen);
    if (has_picture_ && settings.present) {
        const gl::Rect all{0, 0, static_cast<std::int32_t>(settings.viewport_px.x),
                           static_cast<std::int32_t>(settings.viewport_px.y)};
        commands_.add(gl::Blit{lighting_->picture_target(), {}, all, all});
    }
    report_.programs_compiled = device_.compiled_programs() - compiled_before;
    report_.cpu_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();

    const gl::SubmitResult result = device_.submit(commands_);
    samples_->submitted(result.failure == gl::Failure::none);
    if (settings.repeatable && reads_back) device_.finish();
    timed_lights_.submitted(result.submission, report_);
    // Measured times differ from run to run.
    const bool learn_costs = settings.shadow_budget.gpu_ms > 0.0f && !settings.repeatable;
    timed_lights_.tell(
        after_submission({device_, snapshot_, gpu_scene_, *shadows_, lighting_.get()}, result, learn_costs, report_),
        report_);
}

/// Records the picture, or what a still one lacks, and reports it. Returns whether the GPU's measurements are awaited.
bool FrameSystem::record_picture(const shadow::ShadowFrame& shadows, const FrameSettings& settings, bool frozen) {
    using Draws = picture::PictureSamples::Draws;
    const bool unchanged = changes_->unchanged(snapshot_, shadows, settings) && has_picture_;
    const Draws draws = samples_->begin(unchanged, settings.still_samples, settings.viewport_px, settings.transparent);
    const glm::dvec2 jitter_px = samples_->place_px();
    const bool is_middle = jitter_px == glm::dvec2(0.0);  // measurements of other samples would move fits
    const bool wants_depths = !frozen && shadows_->wants_sampled_depths(snapshot_);
    if (!wants_depths && !frozen) feedback_.sampled_depths = {};  // outdated when needed next
    const bool wants_exposure =
        settings.leave_out_dim_lights && !settings.exposure_ev && shadows_->contribution_culling().wants_exposure();
    if (!wants_exposure) lighting_->forget_exposure();
    const bool sample_depths = wants_depths && is_middle, measure_exposure = wants_exposure && is_middle;
    if (draws != Draws::nothing) {
        outcome_.clear();
        has_picture_ = !shadows.inputs.empty() &&
                       lighting_->record(shadows.inputs.front(), snapshot_, gpu_scene_,
                                         {settings.exposure_ev, settings.programs_per_frame, measure_exposure,
                                          sample_depths, shadows_->maps().room(), jitter_px, settings.transparent,
                                          settings.noise_frame + samples_->number()},
                                         commands_, outcome_);
        if (!(outcome_.failures == shown_failures_)) samples_->restart();
        shown_failures_ = outcome_.failures;
    }
    shadows_->report(snapshot_, outcome_, report_);
    if (has_picture_) finish_picture(shadows, settings);
    return draws != Draws::nothing && (sample_depths || measure_exposure);
}

/// Records what comes after the light: samples, smoothing, debug views, which neither blurs.
void FrameSystem::finish_picture(const shadow::ShadowFrame& shadows, const FrameSettings& settings) {
    const picture::FinishedPicture finished{lighting_->picture_texture(), lighting_->picture_target(),
                                            lighting_->size_px()};
    samples_->record(finished, commands_);
    report_.samples = samples_->count();
    if (!settings.smooth_edges)
        smoothing_->release();
    else if (report_.samples < kSmoothSamples)
        smoothing_->record(finished, commands_);
    const ConsumerItem* fitted = frozen_ && !frozen_->empty() ? &frozen_->front() : nullptr;
    debug_->record(settings.debug, {snapshot_, shadows, gpu_scene_, *lighting_, fitted}, commands_);
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

bool FrameSystem::read_tint(std::uint32_t light, std::vector<glm::vec4>& values) {
    if (!has_picture_) return false;
    gl::CommandList list;
    if (!lighting_->record_tint(shadows_->frame().inputs.front(), light, list)) return false;
    if (device_.submit(list).failure != gl::Failure::none) return false;
    values.resize(std::size_t{lighting_->size_px().x} * lighting_->size_px().y);
    return device_.read_texture(lighting_->tint_texture(), 0, std::as_writable_bytes(std::span(values)));
}

}  // namespace gnomon
