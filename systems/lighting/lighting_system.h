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
#include "systems/lighting/depth_sampler.h"
#include "systems/lighting/exposure_meter.h"
#include "systems/lighting/kept_visibility.h"
#include "systems/lighting/light_programs.h"
#include "systems/lighting/lighting_targets.h"
#include "systems/lighting/lookup_times.h"
#include "systems/lighting/picture_range.h"
#include "systems/lighting/ray_list.h"
#include "systems/report.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Matches ExposureBlock in shaders/lighting/post/exposure.glsl (std140).
struct ExposureRecord {
    float scale = -1.0f;  // below 0: automatic
    float top_mip = 0.0f;
    float radiance_per_one = 1.0f;  // what 1 in the picture stands for
    float without_surfaces = 1.0f;  // scale, where it is automatic and nothing lit is seen
};

/// Matches KeptBlock in shaders/lighting/lights/visibility_cache.glsl (std140).
struct KeptRecord {
    glm::ivec4 area{0};
};

struct LightingSettings {
    std::optional<float> exposure_ev;                   // EV100; empty: from the picture's own logarithmic mean
    std::uint32_t most_rows = LightPrograms::kNoLimit;  // so many programs of lights are compiled in one frame at most
    bool measure_exposure = false;                      // read the picture's own back, for most_exposure()
    bool sample_depths = false;  // count the picture's pixels by view distance, for collect_depths()
    std::uint64_t most_kept_bytes = ~std::uint64_t{0};  // of what pixels saw (KeptVisibility), over all pictures
};

/// Deferred lighting: surfaces, one pass per light over its screen rectangle and before its farthest depth, blended
/// surfaces, exposure. Reads of the shadow system only the LightingInputs it is handed. Owns its device objects.
class LightingSystem {
public:
    explicit LightingSystem(gl::Device& device);
    ~LightingSystem();
    LightingSystem(const LightingSystem&) = delete;
    LightingSystem& operator=(const LightingSystem&) = delete;

    /// Records the picture of one consumer. Lights whose program fails, or has to wait, are looked up with one tap
    /// (LightingLight::plain); if that fails as well they are drawn unshadowed, or not at all. All of it is reported.
    /// False if something that no picture can do without could not be had: nothing was recorded then, and
    /// report.failure says why.
    bool record(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                const LightingSettings& settings, gl::CommandList& list, FrameReport& report);

    /// To be called after each submission of what record() recorded: which it was, and whether it was executed without
    /// failure. What pixels saw is kept only where this is called: a still picture then reads it instead of looking
    /// lights up, to the same bits (docs/economy.md, "What pixels saw").
    void submitted(std::uint64_t submission, bool drawn);
    /// Timers of earlier submissions: what was saved by it, for later reports.
    void learn(std::span<const gl::Timing> timings) { lookup_times_.learn(timings); }
    /// What of its memory only saves time.
    SpareMemory& spare() { return kept_; }

    /// Records the visibility of one light (index into inputs.lights) into visibility_texture(), over the surfaces of
    /// the last record() of the same inputs. False if it cannot be done.
    bool record_visibility(const shadow::LightingInputs& inputs, std::uint32_t light, const GpuScene& gpu,
                           gl::CommandList& list);

    /// A picture of how one light's maps are looked up, over the surfaces of the last record() of `inputs`.
    struct Lookups {
        const shadow::LightingInputs& inputs;
        std::uint32_t light;        // index into inputs.lights
        std::string_view fragment;  // a shader that includes debug/lookup.glsl; lives as long as this system
        gl::Rect area;              // of the picture
        gl::BufferHandle block;     // the shader's own, binding 5
        std::uint32_t block_size;
    };
    /// Records it, blended over the picture; nothing if the light has no map. False if it cannot be done.
    bool record_lookups(const Lookups& lookups, const GpuScene& gpu, gl::CommandList& list);

    /// Where the pixels of an earlier picture lie, the newest that is known: see DepthSampler::collect().
    void collect_depths(SampledDepths& depths) { depths_.collect(depths); }

    /// The most that the automatic exposure of the next picture of `camera` can be: see ExposureMeter::bound().
    double most_exposure(ecs::Entity camera) { return exposure_.bound(camera); }
    void forget_exposure() { exposure_.forget(); }

    /// Binds the camera (uniforms 0) and the surfaces (textures 0 to 3) of the last record(), as
    /// shaders/lighting/gbuffer/gbuffer_read.glsl names them.
    void bind_surface_textures(gl::CommandList& list) const;

    gl::TextureHandle picture_texture() const { return targets_.picture; }  // srgb8_a8
    gl::TargetHandle picture_target() const { return targets_.picture_target; }
    gl::TextureHandle visibility_texture() const { return targets_.visibility; }  // r32f
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
        double distance_m;  // from the camera, for their order: of the nearest instance's end; blended: of its middle
    };

    /// What evaluates a light, and what it reads.
    struct LightProgram {
        gl::ProgramHandle program{};
        gl::TextureHandle map{}, triangles{};
        gl::SamplerHandle sampler{};
        visibility::RayBuffers rays{};
        gl::TextureHandle second{}, bounds{};                  // of a map of sheets
        gl::BufferHandle ends{};                               // and of a source with a size
        gl::ProgramHandle verdicts_program{}, rays_program{};  // {0}: `program` itself asks the rays
        gl::ProgramHandle decided_program{};                   // leaves to `program` what takes it long; {0}: nothing
        Reason lacks = Reason::none;                           // why it is not the light's own row
        bool unshadowed = false;
    };
    /// One light's pass over the picture.
    struct LightPass {
        LightProgram own;
        KeptVisibility::Plan kept;
        gl::ProgramHandle reads{};  // of kept.use: instead of `own`
        LightProgram fills;         // and before that
    };
    void plan_passes(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                     const LightingSettings& settings);
    void plan_kept(const shadow::LightingLight& light, ecs::Entity entity, std::uint64_t surfaces, LightPass& pass);
    std::uint64_t surfaces_signature(const shadow::LightingInputs& inputs, const SceneSnapshot& scene) const;
    void bind_kept(const LightPass& pass, std::uint32_t index, gl::CommandList& list) const;
    void record_fill(const LightPass& pass, std::uint32_t index, const GpuScene& gpu, gl::CommandList& list);
    void report_kept(const LightPass& pass, std::uint32_t index, const LightItem& light, FrameReport& frame);
    LightProgram light_program(const shadow::LightingLight& light, RowOutput output);
    gl::Failure prepare(const shadow::LightingInputs& inputs, const SceneSnapshot& scene);
    void collect_draws(const ConsumerItem& consumer, const SceneSnapshot& scene, const GpuScene& gpu);
    void add_mesh_run(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t first, std::uint32_t count,
                      const ConsumerItem& consumer);
    void upload(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                const LightingSettings& settings, gl::CommandList& list);
    gl::ProgramHandle surface_program(bool unlit);
    void record_surfaces(const GpuScene& gpu, gl::CommandList& list);
    void record_lights(const shadow::LightingInputs& inputs, const SceneSnapshot& scene, const GpuScene& gpu,
                       gl::CommandList& list, FrameReport& report);
    void record_blended(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                        FrameReport& report);
    void record_finish(gl::CommandList& list);
    void bind_scene(const GpuScene& gpu, gl::CommandList& list) const;
    void bind_material(const GpuScene& gpu, std::uint32_t material, gl::CommandList& list) const;
    void bind_rays(const visibility::RayBuffers& rays, const GpuScene& gpu, gl::CommandList& list) const;
    void bind_light(const LightProgram& program, std::uint32_t index, const GpuScene& gpu, gl::CommandList& list) const;
    void record_look_up(const LightProgram& light, std::uint32_t index, const gl::Rect& area,
                        std::optional<float> depth, const GpuScene& gpu, gl::CommandList& list) const;
    void record_kept(const LightPass& pass, std::uint32_t index, const shadow::LightingLight& light,
                     gl::CommandList& list) const;
    void record_rays(const LightProgram& light, std::uint32_t index, const gl::Rect& area, std::optional<float> depth,
                     const GpuScene& gpu, gl::CommandList& list) const;
    gl::Rect viewport() const;

    gl::Device& device_;
    LightPrograms programs_;
    LightingTargets targets_;
    RayList ray_list_;
    DepthSampler depths_;
    ExposureMeter exposure_;
    KeptVisibility kept_;
    LookupTimes lookup_times_;
    MidstFinder midst_;
    std::vector<LightPass> passes_;  // of the last record(): one per light of its inputs
    GrowingBuffer items_, uniforms_;
    bool has_places_ = false;  // of the last record(): surfaces say where exactly they are
    gl::SamplerHandle point_sampler_{}, mip_sampler_{};
    std::uint32_t light_stride_ = 0, kept_stride_ = 0, lights_offset_ = 0, kept_offset_ = 0, ambient_offset_ = 0,
                  exposure_offset_ = 0;
    std::vector<std::uint32_t> visible_;
    std::vector<double> farthest_m_;  // of those, by instance
    std::vector<DrawItem> draw_items_;
    std::vector<SurfaceDraw> draws_, blended_;
    std::vector<std::byte> uniform_scratch_;
};

}  // namespace gnomon::lighting
