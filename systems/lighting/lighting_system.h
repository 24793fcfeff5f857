#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/lighting/ambient.h"
#include "systems/lighting/area_table.h"
#include "systems/lighting/catcher_pass.h"
#include "systems/lighting/depth_sampler.h"
#include "systems/lighting/edge_pass.h"
#include "systems/lighting/exposure_meter.h"
#include "systems/lighting/fog_record.h"
#include "systems/lighting/kept_visibility.h"
#include "systems/lighting/light_lookup.h"
#include "systems/lighting/lighting_targets.h"
#include "systems/lighting/lookup_times.h"
#include "systems/lighting/picture_range.h"
#include "systems/lighting/ray_list.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Uniform block; matches ExposureBlock in shaders/lighting/post/exposure.glsl (std140).
struct ExposureRecord {
    float scale = -1.0f;  // < 0: automatic
    float top_mip = 0.0f;
    float radiance_per_one = 1.0f;  // radiance of 1 in the picture
    float without_surfaces = 1.0f;  // scale of an automatic exposure without lit surfaces
};

struct LightingSettings {
    std::optional<float> exposure_ev;                   // EV100; empty: from the picture's logarithmic mean
    std::uint32_t most_rows = LightPrograms::kNoLimit;  // maximum number of light programs compiled per frame
    bool measure_exposure = false;                      // read the picture's exposure back, for most_exposure()
    bool sample_depths = false;  // count the picture's pixels by view distance, for collect_depths()
    std::uint64_t most_kept_bytes = ~std::uint64_t{0};  // limit of KeptVisibility, over all pictures
    glm::dvec2 jitter_px{0.0};  // from a pixel's middle to the place that it shows, each within 0.5
    bool transparent = false;   // nothing is drawn behind all surfaces; the picture's alpha is its coverage
    std::uint32_t noise_round = 0;  // shadow::in_round()
};

/// Deferred lighting: surfaces, a pass per light, shadow catchers, blended surfaces, fog, exposure. A light's pass is
/// limited to its screen rectangle and to its farthest depth. Its only input from the shadow system are LightingInputs.
/// Owns its device objects.
class LightingSystem {
public:
    explicit LightingSystem(gl::Device& device);
    ~LightingSystem();
    LightingSystem(const LightingSystem&) = delete;
    LightingSystem& operator=(const LightingSystem&) = delete;

    /// Records the picture of one consumer. A light without its program (failed, or compiled later) is looked up with
    /// one tap (LightingLight::plain). If that fails too it is drawn unshadowed, or not at all. The outcome has all of
    /// it. Returns false if an essential object is missing: nothing is recorded, and outcome.failure has the reason.
    bool record(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                const LightingSettings& settings, gl::CommandList& list, shadow::LightingOutcome& outcome);

    /// Reports a submission of what record() recorded: its number, and success. Visibility is cached only if this is
    /// called. A still picture then reads it instead of looking lights up, to the same bits
    /// (docs/explanation/caching.md).
    void submitted(std::uint64_t submission, bool drawn);
    /// Learns lookup times from timers of earlier submissions, for reports of the saving.
    void learn(std::span<const gl::Timing> timings) { lookup_times_.learn(timings); }
    /// Returns the memory that only saves time.
    SpareMemory& spare() { return kept_; }

    /// Records the visibility of one light (index into inputs.lights) into visibility_texture(), for the surfaces of
    /// the last record() with the same inputs. Returns false if impossible.
    bool record_visibility(const shadow::LightingInputs& inputs, std::uint32_t light, const GpuScene& gpu,
                           gl::CommandList& list);

    /// Records into tint_texture() the colour that one light's translucent casters let through to each surface, as
    /// record_visibility() does with its visibility. White: all. Returns false if impossible.
    bool record_tint(const shadow::LightingInputs& inputs, std::uint32_t light, gl::CommandList& list);

    /// Picture of one light's map lookups, over the surfaces of the last record() of `inputs`.
    struct Lookups {
        const shadow::LightingInputs& inputs;
        std::uint32_t light;        // index into inputs.lights
        std::string_view fragment;  // shader that includes debug/lookup.glsl; outlives this system
        gl::Rect area;              // part of the picture
        gl::BufferHandle block;     // the shader's own, at bindings::kShownScaleBlock
        std::uint32_t block_size;
    };
    /// Records it, blended over the picture; nothing if the light has no map. Returns false if impossible.
    bool record_lookups(const Lookups& lookups, const GpuScene& gpu, gl::CommandList& list);

    /// Returns the newest known view distances of an earlier picture: see DepthSampler::collect().
    void collect_depths(SampledDepths& depths) { depths_.collect(depths); }

    /// Bounds the automatic exposure of the next picture of `camera`: see ExposureMeter::bound().
    double most_exposure(ecs::Entity camera) { return exposure_.bound(camera); }
    void forget_exposure() { exposure_.forget(); }

    /// Binds the camera (uniforms 0) and the surfaces (textures 0 to 3) of the last record(), as in
    /// shaders/lighting/gbuffer/gbuffer_read.glsl.
    void bind_surface_textures(gl::CommandList& list) const;

    gl::TextureHandle picture_texture() const { return targets_.picture; }  // srgb8_a8
    gl::TargetHandle picture_target() const { return targets_.picture_target; }
    gl::TextureHandle visibility_texture() const { return targets_.visibility; }  // r32f
    gl::TextureHandle tint_texture() const { return targets_.tint; }              // rgba32f; w is 1
    glm::uvec2 size_px() const { return targets_.size_px(); }

private:
    struct DrawItem {
        std::uint32_t instance, first_triangle;
    };
    struct SurfaceDraw {
        std::uint32_t material, first_index, index_count;
        std::int32_t base_vertex;
        std::uint32_t first_item, item_count;
        bool mirrored, two_sided;
        double distance_m;  // from the camera, for sorting: to the nearest instance's far end; blended: to its centre
    };

    /// Pass of one light over the picture.
    struct LightPass {
        LightProgram own;
        KeptVisibility::Plan kept;
        gl::ProgramHandle reads{};  // replaces `own` for kept.use; follows it where `own` draws shares (EdgePass)
        LightProgram fills;         // runs before that, to fill
        gl::Rect read_area{};       // what `reads` reads
        gl::TextureHandle source{};
        bool is_kept() const { return reads && kept.texture; }
    };
    void plan_passes(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                     const LightingSettings& settings);
    void plan_kept(const shadow::LightingLight& light, ecs::Entity entity, std::uint64_t surfaces,
                   std::uint32_t noise_round, LightPass& pass);
    std::uint64_t surfaces_signature(const SceneSnapshot& scene) const;
    void bind_kept(const LightPass& pass, std::uint32_t index, gl::CommandList& list) const;
    void record_fill(const LightPass& pass, std::uint32_t index, const GpuScene& gpu, gl::CommandList& list);
    void note_kept(const LightPass& pass, std::uint32_t index, const LightItem& light,
                   shadow::LightingOutcome& outcome);
    LightProgram light_program(const shadow::LightingLight& light, ShaderPass output);
    gl::Failure prepare(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, bool transparent);
    /// Collects what the camera sees; `jitters`: within a pixel beyond the picture's edges as well.
    void collect_draws(const ConsumerItem& consumer, const SceneSnapshot& scene, const GpuScene& gpu, bool jitters);
    void add_mesh_run(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t first, std::uint32_t count,
                      const ConsumerItem& consumer);
    void add_catcher(const InstanceItem& item, const GpuScene& gpu);
    void upload(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                const LightingSettings& settings, gl::CommandList& list);
    gl::ProgramHandle surface_program(bool unlit);
    void record_surfaces(const GpuScene& gpu, gl::CommandList& list);
    void record_lights(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                       gl::CommandList& list, shadow::LightingOutcome& outcome);
    void plan_forward(const shadow::LightingInputs& inputs, ShaderPass output, shadow::LightingOutcome& outcome);
    void record_catchers(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                         shadow::LightingOutcome& outcome);
    void draw_catchers(const gl::PipelineState& state, const GpuScene& gpu, gl::CommandList& list) const;
    void record_blended(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                        shadow::LightingOutcome& outcome);
    void collect_fogs(const ConsumerItem& consumer, const SceneSnapshot& scene);
    LightProgram fog_program(const shadow::LightingLight& light);
    void record_fogs(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                     shadow::LightingOutcome& outcome);
    void record_finish(bool transparent, gl::CommandList& list);
    void bind_scene(const GpuScene& gpu, gl::CommandList& list) const;
    void bind_material(const GpuScene& gpu, std::uint32_t material, gl::CommandList& list) const;
    void bind_rays(const visibility::RayBuffers& rays, const GpuScene& gpu, gl::CommandList& list) const;
    void bind_light(const LightProgram& program, std::uint32_t index, const GpuScene& gpu, gl::CommandList& list) const;
    void record_look_up(const LightProgram& light, std::uint32_t index, const gl::Rect& area,
                        std::optional<float> depth, const GpuScene& gpu, gl::CommandList& list) const;
    void record_edges(const LightProgram& light, std::uint32_t index, const gl::Rect& area, std::optional<float> depth,
                      const GpuScene& gpu, gl::CommandList& list) const;
    void record_kept(const LightPass& pass, std::uint32_t index, const shadow::LightingLight& light,
                     gl::CommandList& list) const;
    void record_rays(const LightProgram& light, std::uint32_t index, const gl::Rect& area, std::optional<float> depth,
                     const GpuScene& gpu, gl::CommandList& list) const;
    gl::Rect viewport() const;

    gl::Device& device_;
    LightPrograms programs_;
    LightingTargets targets_;
    RayList ray_list_;
    EdgePass edges_;
    AreaTable area_table_;
    CatcherPass caught_;
    DepthSampler depths_;
    ExposureMeter exposure_;
    KeptVisibility kept_;
    LookupTimes lookup_times_;
    MidstFinder midst_;
    std::vector<LightPass> passes_;               // last record(): one per light of its inputs
    std::vector<LightProgram> forward_programs_;  // one per light, of what is drawn forward now; may be empty
    GrowingBuffer items_, uniforms_;
    shadow::CameraRecord camera_;  // last record(): that of its inputs, jittered
    bool has_places_ = false;      // the last record() wrote exact positions of surfaces
    gl::SamplerHandle point_sampler_{}, mip_sampler_{};
    std::uint32_t light_stride_ = 0, kept_stride_ = 0, lights_offset_ = 0, kept_offset_ = 0, ambient_offset_ = 0,
                  exposure_offset_ = 0, fog_stride_ = 0, fogs_offset_ = 0;
    std::vector<std::uint32_t> visible_;
    std::vector<std::uint32_t> fogs_;  // indices into SceneAir::fogs, the farthest first
    std::vector<double> farthest_m_;  // per visible instance
    std::vector<DrawItem> draw_items_;
    std::vector<SurfaceDraw> draws_, blended_, catchers_;
    std::vector<std::byte> uniform_scratch_;
};

}  // namespace gnomon::lighting
