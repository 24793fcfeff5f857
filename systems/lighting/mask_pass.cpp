#include "systems/lighting/mask_pass.h"

#include <algorithm>

#include "engine/core/zone.h"
#include "shaders/bindings.h"
#include "systems/extract/volumes.h"
#include "systems/frame_timers.h"

namespace gnomon::lighting {
namespace {

std::size_t sample_count(const DepthPicture& picture) { return std::max<std::size_t>(picture.samples.size(), 1); }

}  // namespace

gl::Failure MaskPass::make_surfaces(glm::uvec2 size) {
    if (surfaces_ && size == size_px_) return gl::Failure::none;
    release();
    gl::Failure failure = gl::Failure::none;
    const auto make = [&](gl::TextureHandle& texture, const char* label, gl::Format format) {
        if (failure != gl::Failure::none) return;
        const auto made = device_.create_texture({label, gl::TextureKind::flat, format, size.x, size.y, 1, 1}, {});
        texture = made.handle;
        failure = made.failure;
    };
    make(depth_, "imported depth", gl::Format::d32f);
    make(normals_, "imported normals", gl::Format::rgba16_snorm);
    make(material_, "imported material", gl::Format::rgba8);
    if (failure == gl::Failure::none) {
        const auto made = device_.create_target({"imported surfaces", {{normals_, -1}}, {depth_, -1}});
        surfaces_ = made.handle;
        failure = made.failure;
    }
    if (failure == gl::Failure::none) {
        const auto made = device_.create_target({"imported material", {{material_, -1}}, {}});
        same_material_ = made.handle;
        failure = made.failure;
    }
    if (failure != gl::Failure::none) release();
    size_px_ = size;
    return failure;
}

gl::Failure MaskPass::make_layers(std::size_t layers) {
    if (mask_ && targets_.size() == layers) return gl::Failure::none;
    release_layers();
    const auto made = device_.create_texture({"shadow mask", gl::TextureKind::array, gl::Format::r8, size_px_.x,
                                              size_px_.y, static_cast<std::uint32_t>(layers), 1},
                                             {});
    mask_ = made.handle;
    gl::Failure failure = made.failure;
    for (std::size_t i = 0; i < layers && failure == gl::Failure::none; ++i) {
        const auto target =
            device_.create_target({"shadow mask", {{mask_, static_cast<std::int32_t>(i)}}, {depth_, -1}});
        if (target) targets_.push_back(target.handle);
        failure = target.failure;
    }
    if (failure != gl::Failure::none) release_layers();
    return failure;
}

/// Makes what lights need that are drawn twice, or frees it. Without room each is one draw.
void MaskPass::provide_undecided(bool wanted) {
    if (wanted == !undecided_targets_.empty()) return;
    release_undecided();
    if (!wanted) return;
    undecided_ = device_
                     .create_texture(
                         {"undecided depth", gl::TextureKind::flat, gl::Format::d32f, size_px_.x, size_px_.y, 1, 1}, {})
                     .handle;
    for (std::size_t i = 0; i < targets_.size() && undecided_; ++i) {
        const gl::TargetHandle target =
            device_.create_target({"undecided mask", {{mask_, static_cast<std::int32_t>(i)}}, {undecided_, -1}}).handle;
        if (!target) break;
        undecided_targets_.push_back(target);
    }
    if (undecided_targets_.size() < targets_.size()) release_undecided();
}

gl::Failure MaskPass::prepare(const DepthPicture& picture, std::size_t layers, std::size_t lights) {
    const std::size_t samples = sample_count(picture);
    gl::Failure failure = make_surfaces(picture.size_px);
    if (failure == gl::Failure::none && layers > 0) failure = make_layers(layers * samples);
    if (failure == gl::Failure::none && !sampler_) {
        const auto made = device_.create_sampler({.label = "imported surface"});
        sampler_ = made.handle;
        failure = made.failure;
    }
    if (failure != gl::Failure::none) return failure;
    const std::uint32_t alignment = device_.info().uniform_alignment;
    import_offset_ = aligned(sizeof(shadow::CameraRecord), alignment);
    sample_stride_ = import_offset_ + aligned(sizeof(ImportRecord), alignment);
    lights_offset_ = sample_stride_ * static_cast<std::uint32_t>(samples);
    light_stride_ = aligned(sizeof(shadow::LightRecord), alignment);
    if (!import_program(picture)) return programs_.failure();
    kept_offset_ = lights_offset_ + light_stride_ * static_cast<std::uint32_t>(std::max<std::size_t>(lights, 1));
    const bool room = uniforms_.reserve(kept_offset_ + aligned(sizeof(KeptRecord), alignment));
    return room ? gl::Failure::none : gl::Failure::out_of_memory;
}

void MaskPass::upload(const MaskInputs& in, gl::CommandList& list) {
    const shadow::LightingInputs& inputs = in.inputs;
    const DepthPicture& picture = in.picture;
    const shadow::CameraRecord camera = with_lens(inputs.camera, picture);
    const PictureLens& lens = picture.lens;
    ImportRecord record;
    record.depth = {static_cast<float>(lens.scale), static_cast<float>(lens.offset), lens.reversed ? 0.0f : 1.0f, 0.0f};
    record.normals = {static_cast<int>(picture.range), picture.view_space ? 1 : 0, 0, 0};
    bytes_.clear();
    for (std::uint32_t sample = 0; sample < sample_count(picture); ++sample) {
        shadow::CameraRecord there = camera;
        if (!picture.samples.empty()) {
            const glm::dvec2 shift = lens.shift + 2.0 * picture.samples[sample] / glm::dvec2(picture.size_px);
            there.lens.x = static_cast<float>(shift.x);
            there.lens.y = static_cast<float>(shift.y);
        }
        record.normals.z = static_cast<int>(sample);
        put_record(bytes_, sample * sample_stride_, there);
        put_record(bytes_, sample * sample_stride_ + import_offset_, record);
    }
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i)
        put_record(bytes_, lights_offset_ + i * light_stride_,
                   shadow::in_round(inputs.lights[i].record, in.noise_round));
    const KeptRecord all{{0, 0, static_cast<int>(size_px_.x), static_cast<int>(size_px_.y)}};
    put_record(bytes_, kept_offset_, all);
    list.update(uniforms_.handle(), 0, std::span<const std::byte>(bytes_));
}

void MaskPass::bind_camera(std::uint32_t sample, gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kCameraBlock, uniforms_.handle(), sample * sample_stride_,
                              sizeof(shadow::CameraRecord)});
}

/// Records a layer's light over the surfaces that were imported last. If some pixels are slow there are two draws. The
/// first removes the depth of finished pixels, so that only the others pass the second one's depth test.
void MaskPass::record_light(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample,
                            const LightProgram& program, const gl::Rect& area, gl::CommandList& list) const {
    const std::uint32_t light = in.layers[layer];
    list.add(gl::SetScissor{area});
    const auto draw = [&](gl::ProgramHandle used, bool takes_depth) {
        list.add(gl::SetPipeline{
            {used, gl::CullMode::none, false, gl::DepthTest::less, takes_depth, false, gl::Blend::off}});
        bind_inputs(in, layer, sample, program, list);
        if (program.edges) bind_shares(list);
        list.add(gl::DrawTriangle{masked_depth(in.inputs.lights[light].area, in.picture)});
    };
    if (program.edges) return draw(program.edges.reads, false);
    if (program.decided_program) draw(program.decided_program, true);
    draw(program.program, false);
}

/// Binds what EdgePass has found.
void MaskPass::bind_shares(gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kKeptBlock, uniforms_.handle(), kept_offset_, sizeof(KeptRecord)});
    list.add(gl::BindTexture{bindings::kKeptVisibilityUnit, edges_.shares(), sampler_});
}

/// Records a light's visibility into the pass of edges.
void MaskPass::record_edges(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample,
                            const LightProgram& program, const gl::Rect& area, gl::CommandList& list) const {
    const auto bind = [&] { bind_inputs(in, layer, sample, program, list); };
    const float depth = masked_depth(in.inputs.lights[in.layers[layer]].area, in.picture);
    edges_.record(program, {depth_, area, depth}, sampler_, bind, list);
}

/// Binds what a light's programs read: surfaces, its maps, or its visibility as EdgePass has found it.
void MaskPass::bind_inputs(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample, const LightProgram& program,
                           gl::CommandList& list) const {
    bind_camera(sample, list);
    list.add(gl::BindTexture{bindings::kSurfaceDepthUnit, depth_, sampler_});
    list.add(gl::BindTexture{bindings::kSurfaceNormalUnit, normals_, sampler_});
    list.add(gl::BindTexture{bindings::kSurfaceMaterialUnit, material_, sampler_});
    list.add(gl::BindUniforms{bindings::kLightBlock, uniforms_.handle(),
                              lights_offset_ + in.layers[layer] * light_stride_, sizeof(shadow::LightRecord)});
    bind_maps(program, list);
    bind_triangles(program, in.gpu, list);
}

LightProgram MaskPass::program_of(const shadow::LightingLight& light) {
    const gl::ProgramHandle own = programs_.row(light.row, ShaderPass::visibility);
    if (own) {
        LightProgram used{own, light.map, light.triangles, light.sampler};
        if (light.row.area_shares == shadow::AreaShares::marked && edges_.is_there()) {
            shadow::ShaderKey middles = light.row;
            middles.area_shares = shadow::AreaShares::none;
            LightProgram steps = used;
            steps.decided_program = programs_.row(middles, ShaderPass::decided_middles);
            steps.program = programs_.row(middles, ShaderPass::undecided_middles);
            steps.edges = {programs_.mark_edges(), programs_.row(light.row, ShaderPass::crossed_areas),
                           programs_.row(kept_row(light.row), ShaderPass::kept_visibility)};
            if (steps.decided_program && steps.program && steps.edges) return steps;
        }
        if (light.row.triangles && light.row.area_shares != shadow::AreaShares::marked && !undecided_targets_.empty())
            used.decided_program = programs_.row(light.row, ShaderPass::decided_visibility);
        return used;
    }
    return fallback_program(programs_, light, ShaderPass::visibility, Reason::filter_program_failed);
}

/// Records a layer per light, over the surfaces of one sample.
void MaskPass::record_layers(const MaskInputs& in, std::uint32_t sample, gl::CommandList& list) {
    const ConsumerItem& consumer = in.scene.consumers[in.inputs.consumer];
    const auto samples = static_cast<std::uint32_t>(sample_count(in.picture));
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
    for (std::uint32_t layer = 0; layer < in.layers.size(); ++layer) {
        const std::size_t target = std::size_t{layer} * samples + sample;
        const bool is_light = in.layers[layer] < in.inputs.lights.size();
        LightProgram used;
        gl::Rect area{};  // the picture may show more than the scene declares
        if (is_light) {
            const shadow::LightingLight& light = in.inputs.lights[in.layers[layer]];
            used = program_of(light);
            const gl::Rect masked = masked_area(light.area, in.picture);
            if (masked.width > 0 && used.program) area = in_picture(masked, consumer, in.picture);
        }
        if (area.width > 0 && used.edges) record_edges(in, layer, sample, used, area, list);
        const bool two = area.width > 0 && used.decided_program && !used.edges;
        if (two) list.add(gl::CopyTexture{depth_, undecided_, 0, area});
        list.add(gl::BeginPass{two ? undecided_targets_[target] : targets_[target],
                               all,
                               false,
                               0.0f,
                               true,
                               {is_light ? 0.0f : 1.0f, 0.0f, 0.0f, 0.0f}});
        if (area.width > 0) {
            const shadow::LightingLight& light = in.inputs.lights[in.layers[layer]];
            list.add(gl::BeginGroup{in.scene.lights[light.light].name});
            list.add(gl::BeginTimer{lighting_timer(light.light)});
            record_light(in, layer, sample, used, area, list);
            list.add(gl::EndTimer{lighting_timer(light.light)});
            list.add(gl::EndGroup{});
        }
        list.add(gl::EndPass{});
    }
}

bool MaskPass::record(const MaskInputs& in, gl::CommandList& list, shadow::LightingOutcome& outcome) {
    GNOMON_ZONE("mask");
    outcome.failure = prepare(in.picture, in.layers.size(), in.inputs.lights.size());
    if (outcome.failure != gl::Failure::none) return false;
    provide_tints(in);
    if (in.layers.empty()) {
        release_layers();
        edges_.provide(false, size_px_);
        return true;
    }
    provide_undecided(std::any_of(in.layers.begin(), in.layers.end(), [&](std::uint32_t layer) {
        return layer < in.inputs.lights.size() && in.inputs.lights[layer].row.triangles;
    }));
    edges_.provide(std::any_of(in.layers.begin(), in.layers.end(),
                               [&](std::uint32_t layer) {
                                   return layer < in.inputs.lights.size() &&
                                          in.inputs.lights[layer].row.area_shares == shadow::AreaShares::marked;
                               }),
                   size_px_);
    upload(in, list);
    list.add(gl::BeginGroup{"shadow mask"});
    import_material(in.picture, list);
    const gl::Rect reached = reached_pixels(in);
    for (std::uint32_t sample = 0; sample < sample_count(in.picture); ++sample) {
        import(in.picture, reached, sample, list);
        record_layers(in, sample, list);
        if (tints_) record_tints(in, sample, list);
    }
    list.add(gl::EndGroup{});
    for (const std::uint32_t layer : in.layers) {
        if (layer >= in.inputs.lights.size()) continue;
        const shadow::LightingLight& light = in.inputs.lights[layer];
        const LightProgram used = program_of(light);
        if (used.lacks != Reason::none)
            outcome.failures.push_back({light.light, used.lacks, used.unshadowed, false, light.plain.accuracy});
    }
    return true;
}

void MaskPass::release_undecided() {
    for (const gl::TargetHandle target : undecided_targets_) device_.destroy(target);
    undecided_targets_.clear();
    device_.destroy(undecided_);
    undecided_ = {};
}

void MaskPass::release_layers() {
    release_undecided();
    release_tints();
    for (const gl::TargetHandle target : targets_) device_.destroy(target);
    targets_.clear();
    device_.destroy(mask_);
    mask_ = {};
}

void MaskPass::release() {
    release_layers();
    for (gl::TargetHandle* target : {&surfaces_, &same_material_}) {
        device_.destroy(*target);
        *target = {};
    }
    for (gl::TextureHandle* texture : {&depth_, &normals_, &material_}) {
        device_.destroy(*texture);
        *texture = {};
    }
    device_.destroy(sampler_);
    sampler_ = {};
    size_px_ = {0, 0};
}

}  // namespace gnomon::lighting
