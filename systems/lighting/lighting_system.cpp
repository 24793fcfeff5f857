#include "systems/lighting/lighting_system.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "engine/core/zone.h"
#include "engine/math/frustum.h"
#include "shaders/bindings.h"
#include "systems/extract/instance_order.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/volumes.h"
#include "systems/frame_timers.h"
#include "systems/lighting/jittered_camera.h"

namespace gnomon::lighting {
namespace {

/// Bounds the distance from a place to anything in a box. Drawing in this order hides much of the rest before it is
/// shaded. Small and near objects come first, grounds and walls, which reach far, last.
double farthest_m(const math::Aabb& box, const glm::dvec3& place) {
    return glm::distance(math::centre(box), place) + 0.5 * glm::distance(box.min, box.max);
}

/// Scales a light's radiance for its passes; w is its source's size. Finite for any intensity.
glm::vec4 in_picture(const glm::vec4& radiance, float per_radiance) {
    constexpr float kMost = 1.0e30f;  // as in lighting/lights/light_sample.glsl
    const glm::vec3 scaled = glm::min(glm::vec3(radiance) * per_radiance, glm::vec3(kMost));
    return glm::vec4(scaled, radiance.w);
}

}  // namespace

LightingSystem::LightingSystem(gl::Device& device)
    : device_(device),
      programs_(device),
      targets_(device),
      ray_list_(device),
      edges_(device),
      area_table_(device),
      caught_(device),
      depths_(device),
      exposure_(device),
      kept_(device),
      items_(device, "surface draw items"),
      uniforms_(device, "lighting uniforms") {}

LightingSystem::~LightingSystem() {
    device_.destroy(point_sampler_);
    device_.destroy(mip_sampler_);
}

gl::Rect LightingSystem::viewport() const {
    return {0, 0, static_cast<std::int32_t>(size_px().x), static_cast<std::int32_t>(size_px().y)};
}

/// Makes missing objects that every picture needs. Returns the reason of a failure.
gl::Failure LightingSystem::prepare(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                                    bool transparent) {
    if (!targets_.resize(scene.consumers[inputs.consumer].viewport_px)) return targets_.failure();
    const auto ensure = [&](gl::SamplerHandle& sampler, const gl::SamplerDesc& desc) {
        if (sampler) return gl::Failure::none;
        const auto made = device_.create_sampler(desc);
        sampler = made.handle;
        return made.failure;
    };
    gl::Failure failure = ensure(point_sampler_, {.label = "surface"});
    if (failure == gl::Failure::none)
        failure = ensure(mip_sampler_, {.label = "luminance", .linear = true, .mipmaps = true});
    if (failure != gl::Failure::none) return failure;
    const std::uint32_t alignment = device_.info().uniform_alignment;
    ambient_offset_ = aligned(sizeof(shadow::CameraRecord), alignment);
    exposure_offset_ = ambient_offset_ + aligned(sizeof(AmbientRecord), alignment);
    lights_offset_ = exposure_offset_ + aligned(sizeof(ExposureRecord), alignment);
    light_stride_ = aligned(sizeof(shadow::LightRecord), alignment);
    kept_stride_ = aligned(sizeof(KeptRecord), alignment);
    kept_offset_ = lights_offset_ + light_stride_ * static_cast<std::uint32_t>(inputs.lights.size());
    fog_stride_ = aligned(sizeof(FogRecord), alignment);
    fogs_offset_ = kept_offset_ + kept_stride_ * static_cast<std::uint32_t>(inputs.lights.size());
    const auto asks = [](const shadow::LightingLight& light) { return light.row.rays; };
    const bool wanted = std::any_of(inputs.lights.begin(), inputs.lights.end(), asks);
    const auto lists = [](const shadow::LightingLight& light) { return light.row.sheets; };
    ray_list_.provide(std::any_of(inputs.lights.begin(), inputs.lights.end(), lists), targets_.size_px(),
                      targets_.depth);
    const auto shares = [](const shadow::LightingLight& light) {
        return light.row.area_shares == shadow::AreaShares::marked;
    };
    edges_.provide(std::any_of(inputs.lights.begin(), inputs.lights.end(), shares), targets_.size_px());
    const auto leaves = [](const shadow::LightingLight& light) { return light.row.triangles; };
    targets_.provide_undecided(std::any_of(inputs.lights.begin(), inputs.lights.end(), leaves));
    has_places_ = targets_.provide_places(wanted) && wanted && programs_.surface(true);
    if (!programs_.surface(has_places_) || !programs_.luminance() || !programs_.tonemap(transparent))
        return programs_.failure();
    caught_.provide(!catchers_.empty(), targets_.size_px());
    const auto shows_area = [](const LightItem& light) { return light_facts(light.kind).area(); };
    if (!area_table_.provide(std::any_of(scene.lights.begin(), scene.lights.end(), shows_area)))
        return gl::Failure::out_of_memory;
    const bool room = items_.reserve(std::max<std::size_t>(draw_items_.size(), 1) * sizeof(DrawItem)) &&
                      uniforms_.reserve(fogs_offset_ + std::uint64_t{fog_stride_} * fogs_.size());
    return room ? gl::Failure::none : gl::Failure::out_of_memory;
}

void LightingSystem::add_mesh_run(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t first,
                                  std::uint32_t count, const ConsumerItem& consumer) {
    const InstanceItem& head = scene.instances[visible_[first]];
    const GpuScene::MeshRange& mesh = gpu.mesh(head.mesh);
    for (std::uint32_t s = 0; s < mesh.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(mesh.first_submesh + s);
        const bool blend = gpu.material(submesh.material).alpha_mode == assets::AlphaMode::blend;
        // Blended instances are drawn one by one, sorted; others in one draw.
        const std::uint32_t step = blend ? 1 : count;
        for (std::uint32_t i = 0; i < count; i += step) {
            const std::uint32_t nearest = visible_[first + i];
            const glm::dvec3 middle_ws_m = math::centre(scene.instances[nearest].bounds_ws);
            (blend ? blended_ : draws_)
                .push_back({submesh.material, submesh.first_index, submesh.index_count, mesh.base_vertex,
                            static_cast<std::uint32_t>(draw_items_.size()), step, head.winding.mirrored,
                            gpu.material(submesh.material).double_sided || head.winding.folded,
                            blend ? glm::distance(middle_ws_m, consumer.position_ws_m) : farthest_m_[nearest]});
            for (std::uint32_t k = 0; k < step; ++k)
                draw_items_.push_back({scene.instances[visible_[first + i + k]].gpu_slot, submesh.first_index / 3});
        }
    }
}

void LightingSystem::collect_draws(const ConsumerItem& consumer, const SceneSnapshot& scene, const GpuScene& gpu,
                                   bool jitters) {
    visible_.clear();
    draw_items_.clear();
    draws_.clear();
    blended_.clear();
    catchers_.clear();
    farthest_m_.resize(scene.instances.size());
    const math::Frustum frustum = jitters ? jittered_frustum(consumer) : consumer_frustum(consumer);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        if (!item.visible || is_air(item) || item.gpu_slot >= gpu.capacity() ||
            !math::may_overlap(frustum, item.bounds_ws))
            continue;
        if (item.shadow_catcher) {
            add_catcher(item, gpu);
            continue;
        }
        visible_.push_back(i);
        farthest_m_[i] = farthest_m(item.bounds_ws, consumer.position_ws_m);
    }
    const auto key = [&](std::uint32_t i) {
        return std::tuple(scene.instances[i].mesh * 2 + (scene.instances[i].winding.mirrored ? 1u : 0u), farthest_m_[i],
                          i);
    };
    std::sort(visible_.begin(), visible_.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for_each_mesh_run(scene, visible_, [&](std::uint32_t, std::uint32_t first, std::uint32_t count) {
        // Mirrored instances of a mesh come last, because their front faces have the opposite winding.
        const auto begin = visible_.begin() + first;
        const auto middle =
            std::find_if(begin, begin + count, [&](std::uint32_t i) { return scene.instances[i].winding.mirrored; });
        const auto plain = static_cast<std::uint32_t>(middle - begin);
        if (plain > 0) add_mesh_run(scene, gpu, first, plain, consumer);
        if (plain < count) add_mesh_run(scene, gpu, first + plain, count - plain, consumer);
    });
    // Ties are broken by item; a stable sort would allocate.
    std::sort(draws_.begin(), draws_.end(), [](const SurfaceDraw& a, const SurfaceDraw& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.first_item < b.first_item;
    });
    std::sort(blended_.begin(), blended_.end(), [](const SurfaceDraw& a, const SurfaceDraw& b) {
        return a.distance_m != b.distance_m ? a.distance_m > b.distance_m : a.first_item < b.first_item;
    });
}

void LightingSystem::upload(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                            const LightingSettings& settings, gl::CommandList& list) {
    const SceneLight falls = scene_light(scene, midst_.find(scene));
    const PictureRange range = picture_range(falls, gpu.most_emissive(), settings.exposure_ev);
    AmbientRecord ambient = ambient_for(falls, range.per_radiance);
    ambient.sky_lux.w = range.per_radiance;
    ambient.ground_lux.w = range.per_unlit;
    ExposureRecord exposure;
    exposure.top_mip = static_cast<float>(kLuminanceTopMip);
    exposure.radiance_per_one = 1.0f / range.per_radiance;
    if (gpu.any_unlit()) exposure.without_surfaces = range.per_radiance / range.per_unlit;
    if (settings.exposure_ev) exposure.scale = exposure_scale(*settings.exposure_ev);
    uniform_scratch_.clear();
    put_record(uniform_scratch_, 0, camera_);
    put_record(uniform_scratch_, ambient_offset_, ambient);
    put_record(uniform_scratch_, exposure_offset_, exposure);
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
        const std::uint32_t offset = lights_offset_ + i * light_stride_;
        put_record(uniform_scratch_, offset, shadow::in_round(inputs.lights[i].record, settings.noise_round));
        const glm::vec4 radiance = in_picture(inputs.lights[i].record.radiance, range.per_radiance);
        put_record(uniform_scratch_, offset + offsetof(shadow::LightRecord, radiance), radiance);
    }
    for (std::uint32_t i = 0; i < passes_.size(); ++i) {
        const gl::Rect& area = passes_[i].read_area;
        const KeptRecord record{{area.x, area.y, area.width, area.height}};
        if (passes_[i].reads) put_record(uniform_scratch_, kept_offset_ + i * kept_stride_, record);
    }
    const glm::dvec3& anchor_ws_m = scene.consumers[inputs.consumer].position_ws_m;
    for (std::uint32_t i = 0; i < fogs_.size(); ++i) {
        const FogItem& fog = scene.air.fogs[fogs_[i]];
        put_record(uniform_scratch_, fogs_offset_ + i * fog_stride_,
                   fog_record(fog, scene.instances[fog.instance], anchor_ws_m, settings.noise_round));
    }
    list.update(items_.handle(), 0, std::span<const DrawItem>(draw_items_));
    list.update(uniforms_.handle(), 0, std::span<const std::byte>(uniform_scratch_));
}

void LightingSystem::bind_scene(const GpuScene& gpu, gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kCameraBlock, uniforms_.handle(), 0, sizeof(shadow::CameraRecord)});
    list.add(gl::BindUniforms{bindings::kAmbientBlock, uniforms_.handle(), ambient_offset_, sizeof(AmbientRecord)});
    list.add(gl::BindTexels{bindings::kInstanceUnit, gpu.instances()});
    list.add(gl::BindTexels{bindings::kTriangleNormalUnit, gpu.triangle_normals()});
    if (gpu.colours()) list.add(gl::BindTexels{bindings::kColourUnit, gpu.colours()});
    list.add(gl::BindMeshes{gpu.vertices(), gpu.indices(), items_.handle()});
}

void LightingSystem::bind_material(const GpuScene& gpu, std::uint32_t material, gl::CommandList& list) const {
    const GpuScene::MaterialInfo& info = gpu.material(material);
    list.add(gl::BindTexture{bindings::kBaseColourUnit, info.texture, info.sampler});
    list.add(gl::BindUniforms{bindings::kMaterialBlock, gpu.material_uniforms(), info.uniform_offset,
                              sizeof(MaterialRecord)});
}

gl::ProgramHandle LightingSystem::surface_program(bool unlit) {
    const gl::ProgramHandle own = unlit ? programs_.unlit_surface(has_places_) : gl::ProgramHandle{};
    return own ? own : programs_.surface(has_places_);
}

void LightingSystem::record_surfaces(const GpuScene& gpu, gl::CommandList& list) {
    list.add(gl::BeginGroup{"surfaces"});
    list.add(gl::BeginTimer{kSurfaceTimer});
    list.add(gl::BeginPass{
        has_places_ ? targets_.places_target : targets_.surface_target, viewport(), true, 0.0f, true, {}});
    std::uint32_t bound = 0xffffffffu;
    gl::PipelineState state{surface_program(false), gl::CullMode::none, false, gl::DepthTest::greater, true, false,
                            gl::Blend::off};
    bool first = true;
    for (const SurfaceDraw& draw : draws_) {
        gl::PipelineState wanted = state;
        wanted.program = surface_program(gpu.material(draw.material).unlit);
        wanted.cull = draw.two_sided ? gl::CullMode::none : gl::CullMode::back;
        wanted.front_is_clockwise = draw.mirrored;
        if (first || !(wanted == state)) list.add(gl::SetPipeline{wanted});
        if (first) bind_scene(gpu, list);
        state = wanted;
        first = false;
        if (draw.material != bound) bind_material(gpu, draw.material, list);
        bound = draw.material;
        list.add(
            gl::DrawMeshes{draw.first_index, draw.index_count, draw.base_vertex, draw.first_item, draw.item_count});
    }
    list.add(gl::EndPass{});
    list.add(gl::EndTimer{kSurfaceTimer});
    list.add(gl::EndGroup{});
}

void LightingSystem::bind_surface_textures(gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kCameraBlock, uniforms_.handle(), 0, sizeof(shadow::CameraRecord)});
    list.add(gl::BindTexture{bindings::kSurfaceDepthUnit, targets_.depth, point_sampler_});
    list.add(gl::BindTexture{bindings::kSurfaceColourUnit, targets_.colour, point_sampler_});
    list.add(gl::BindTexture{bindings::kSurfaceNormalUnit, targets_.normals, point_sampler_});
    list.add(gl::BindTexture{bindings::kSurfaceMaterialUnit, targets_.material, point_sampler_});
}

void LightingSystem::record_finish(bool transparent, gl::CommandList& list) {
    const auto side = static_cast<std::int32_t>(kLuminanceSide_px);
    list.add(gl::BeginGroup{"exposure"});
    list.add(gl::BeginTimer{kFinishTimer});
    list.add(gl::BeginPass{targets_.luminance_target, {0, 0, side, side}, false, 0.0f, false, {}});
    list.add(gl::SetPipeline{
        {programs_.luminance(), gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    list.add(gl::BindTexture{bindings::kMeteredDepthUnit, targets_.depth, point_sampler_});
    list.add(gl::BindTexture{bindings::kMeteredPictureUnit, targets_.light_sum, point_sampler_});
    list.add(gl::BindUniforms{bindings::kExposureBlock, uniforms_.handle(), exposure_offset_, sizeof(ExposureRecord)});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::GenerateMips{targets_.luminance});
    list.add(gl::BeginPass{targets_.picture_target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetPipeline{
        {programs_.tonemap(transparent), gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    list.add(gl::BindTexture{bindings::kPictureUnit, targets_.light_sum, point_sampler_});
    list.add(gl::BindTexture{bindings::kLuminanceUnit, targets_.luminance, mip_sampler_});
    list.add(gl::BindTexture{bindings::kPictureDepthUnit, targets_.depth, point_sampler_});
    list.add(gl::BindUniforms{bindings::kCameraBlock, uniforms_.handle(), 0, sizeof(shadow::CameraRecord)});
    list.add(gl::BindUniforms{bindings::kAmbientBlock, uniforms_.handle(), ambient_offset_, sizeof(AmbientRecord)});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::EndTimer{kFinishTimer});
    list.add(gl::EndGroup{});
}

bool LightingSystem::record(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                            const LightingSettings& settings, gl::CommandList& list, shadow::LightingOutcome& outcome) {
    GNOMON_ZONE("lighting");
    const ecs::Entity camera = scene.consumers[inputs.consumer].entity;
    collect_draws(scene.consumers[inputs.consumer], scene, gpu, settings.jitter_px != glm::dvec2(0.0));
    collect_fogs(scene.consumers[inputs.consumer], scene);
    passes_.clear();
    camera_ = jittered(inputs.camera, settings.jitter_px);
    programs_.next_frame(settings.most_rows);
    programs_.set_some_unlit(gpu.any_unlit());
    programs_.set_coloured(static_cast<bool>(gpu.colours()));
    outcome.failure = prepare(inputs, scene, settings.transparent);
    if (outcome.failure != gl::Failure::none) {
        // Freed memory returns only after the device has finished its work; then there may be room.
        device_.finish();
        outcome.failure = prepare(inputs, scene, settings.transparent);
        if (outcome.failure != gl::Failure::none) return false;
    }
    plan_passes(inputs, scene, settings);
    upload(inputs, scene, gpu, settings, list);
    record_surfaces(gpu, list);
    if (area_table_.buffer()) list.add(gl::BindStorage{bindings::kAreaTableBuffer, area_table_.buffer()});
    if (settings.sample_depths)
        depths_.record({camera, targets_.depth, point_sampler_, uniforms_.handle(), targets_.size_px()}, list);
    record_lights(inputs, scene, gpu, list, outcome);
    record_catchers(inputs, gpu, list, outcome);
    record_blended(inputs, gpu, list, outcome);
    record_fogs(inputs, gpu, list, outcome);
    record_finish(settings.transparent, list);
    outcome.ray_list_bytes = ray_list_.bytes();
    outcome.position_bytes = targets_.place_bytes();
    if (settings.measure_exposure)
        exposure_.record({camera, targets_.luminance, mip_sampler_, uniforms_.handle(), exposure_offset_}, list);
    return true;
}

bool LightingSystem::record_visibility(const shadow::LightingInputs& inputs, std::uint32_t light, const GpuScene& gpu,
                                       gl::CommandList& list) {
    if (light >= inputs.lights.size() || !targets_.ensure_visibility()) return false;
    LightProgram used = light_program(inputs.lights[light], ShaderPass::visibility);
    if (!used.program || used.unshadowed) return false;
    const LightPass* pass = light < passes_.size() ? &passes_[light] : nullptr;
    const bool kept = pass && pass->is_kept() && kept_.holds(pass->kept.texture);
    if (kept) used = {};
    if (kept) used.program = programs_.row(kept_row(inputs.lights[light].row), ShaderPass::kept_visibility);
    const bool edges = used.edges && pass && pass->source == edges_.shares();
    const gl::ProgramHandle reader = edges ? used.edges.reads : used.program;
    if (!reader) return false;
    constexpr float kNoSurface = -1.0f;
    list.add(gl::BeginGroup{"visibility"});
    if (used.verdicts_program) record_rays(used, light, {}, {}, gpu, list);
    if (edges) record_edges(used, light, viewport(), {}, gpu, list);
    list.add(gl::BeginPass{targets_.visibility_target, viewport(), false, 0.0f, true, {kNoSurface, 0.0f, 0.0f, 0.0f}});
    list.add(gl::SetPipeline{{reader, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    bind_surface_textures(list);
    if (kept || edges)
        bind_kept(*pass, light, list);
    else
        bind_light(used, light, gpu, list);
    if (used.verdicts_program) ray_list_.bind_answers(list);
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    if (used.verdicts_program) ray_list_.unbind_answers(list);
    list.add(gl::EndGroup{});
    return true;
}

bool LightingSystem::record_tint(const shadow::LightingInputs& inputs, std::uint32_t light, gl::CommandList& list) {
    if (light >= inputs.lights.size() || !targets_.ensure_tint()) return false;
    const shadow::LightingLight& item = inputs.lights[light];
    const gl::ProgramHandle program = programs_.row(kept_row(item.row), ShaderPass::tint);
    if (!program) return false;
    list.add(gl::BeginGroup{"tint"});
    list.add(gl::BeginPass{targets_.tint_target, viewport(), false, 0.0f, true, {1.0f, 1.0f, 1.0f, 1.0f}});
    list.add(gl::SetPipeline{{program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    bind_surface_textures(list);
    list.add(gl::BindUniforms{bindings::kLightBlock, uniforms_.handle(), lights_offset_ + light * light_stride_,
                              sizeof(shadow::LightRecord)});
    bind_tint(item.tint, list);
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
    return true;
}

bool LightingSystem::record_lookups(const Lookups& lookups, const GpuScene& gpu, gl::CommandList& list) {
    const shadow::LightingLight& item = lookups.inputs.lights[lookups.light];
    if (!item.map) return true;  // nothing to look up
    // A light with rays is shown with its map's plain lookup.
    const bool rays = item.row.rays;
    const gl::ProgramHandle program = programs_.lookups(rays ? item.plain.row : item.row, lookups.fragment);
    if (!program) return false;
    list.add(gl::BeginPass{targets_.picture_target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetScissor{lookups.area});
    list.add(gl::SetPipeline{{program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::alpha}});
    bind_surface_textures(list);
    bind_light({program, item.map, item.triangles, rays ? item.plain.sampler : item.sampler}, lookups.light, gpu, list);
    list.add(gl::BindUniforms{bindings::kShownScaleBlock, lookups.block, 0, lookups.block_size});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    return true;
}

}  // namespace gnomon::lighting
