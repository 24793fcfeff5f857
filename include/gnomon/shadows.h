#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/light.h"
#include "gnomon/reason.h"
#include "gnomon/result.h"
#include "gnomon/shadow_tuning.h"

/// Shadows for an engine with its own meshes, scene and renderer: hand over meshes, casters and lights, get each
/// light's visibility at every pixel. Needs an OpenGL 4.5 core context; every call is made on its thread.
namespace gnomon {

/// Handle of something added. Valid until that is removed; a removed one never names anything again.
template <class Kind>
struct Handle {
    std::uint32_t index = 0xffffffffu;  // slot; this value: none
    std::uint32_t version = 0;          // generation: differs from earlier uses of the index
    /// Returns whether the handle was ever given out.
    explicit operator bool() const { return index != 0xffffffffu; }
    bool operator==(const Handle&) const = default;
};
/// Handle of a mesh.
using MeshId = Handle<struct MeshKind>;
/// Handle of a caster, a drawable or air.
using CasterId = Handle<struct CasterKind>;
/// Handle of a light.
using LightId = Handle<struct ShadowLightKind>;

/// Alpha test of a mesh: light passes where alpha is below the cutoff. Repeats beyond [0, 1], filtered linearly.
struct AlphaMask {
    glm::uvec2 size_px{0, 0};                  // 0: the mesh is opaque
    std::span<const std::uint8_t> alpha = {};  // size_px.x * size_px.y bytes, first row at v = 0
    float cutoff = 0.5f;                       // (0, 1]
};

/// Triangles, copied when the mesh is added.
struct MeshDesc {
    std::string_view name = {};                   // in error messages and captures
    std::span<const glm::vec3> positions_m = {};  // mesh space, metres, finite
    std::span<const std::uint32_t> indices = {};  // three per triangle, counter-clockwise from outside
    bool two_sided = false;  // seen from inside too: never counts as solid. Open meshes cast from both sides either way
    AlphaMask mask = {};     // holes of leaves and fences; needs uvs
    std::span<const glm::vec2> uvs = {};  // one per position, for the mask; else empty
    /// Share of light that passes through each of its surfaces, per channel, 0 to 1. 0: none. Above 0 the mesh is a
    /// translucent caster: it casts coloured light in place of a shadow (Mask::tint_texture). A body is crossed twice.
    glm::vec3 transmittance{0.0f};
};

/// Box in world space, metres, unless a field names another space.
struct Bounds {
    glm::dvec3 min_m{0.0}, max_m{0.0};  // least and greatest corner, finite
};

/// Components of a position in a vertex buffer: three of them. snorm16 and unorm16 stand for [-1, 1] and [0, 1]. Their
/// scale belongs into CasterDesc::world_from_mesh.
enum class PositionFormat : std::uint8_t { float32, float16, snorm16, unorm16 };
/// Bits of an index in a buffer.
enum class IndexSize : std::uint8_t { u32, u16 };

/// Triangles in buffers of your own, which depth passes draw from there: nothing is copied. Filters that read triangles
/// treat them by depth (LightStatus::by_depth), visibility queries do not see them. They have no alpha mask. The
/// buffers live, unmapped or mapped persistently, until the mesh is removed.
struct BufferMeshDesc {
    std::string_view name = {};                       // in error messages and captures
    unsigned vertex_buffer = 0, index_buffer = 0;     // OpenGL's names; may be the same
    std::uint32_t stride_bytes = 12;                  // from vertex to vertex, at most 2048
    std::uint64_t position_offset_bytes = 0;          // from the buffer's start to vertex 0's position
    PositionFormat format = PositionFormat::float32;  // type of its three components
    std::uint32_t vertex_count = 0;                   // indices with base_vertex are below; that is not checked
    IndexSize index_size = IndexSize::u32;            // as glDrawElements takes them
    std::uint32_t first_index = 0, index_count = 0;   // three per triangle
    std::int32_t base_vertex = 0;                     // added to each index
    Bounds bounds = {};                               // mesh space; contains all positions
};

/// Placed mesh: a caster, a receiver, or both. Maps cover declared receivers alone: declare every surface that shadows
/// shall fall on, the ground too.
struct CasterDesc {
    MeshId mesh = {};                                // triangles; none: dropped
    glm::dmat4 world_from_mesh{1.0};                 // affine; may mirror, scale and shear
    bool casts = true;                               // false: light passes through it
    bool receives = true;                            // maps are fitted to it; a mask darkens its pixels either way
    ShadowLayers cast_layers = kAllShadowLayers;     // it darkens under lights that share a bit
    ShadowLayers receive_layers = kAllShadowLayers;  // for fits; by pixel: gnomon_takes_shadow() in lookup_glsl()
};

/// View of a light's map into which an engine draws a caster with code of its own. The map is bound, with its viewport.
/// Depth test, clip depths of [0, 1] and all else that a depth pass needs are set; culling is off. Draw with any
/// program that gives gl_Position = clip_from_world * position; its fragment shader needs no output. That state is
/// reset afterwards. Other state that the draw changes stays changed.
struct DrawableView {
    glm::mat4 clip_from_world{1.0f};   // exact enough near the world's origin
    glm::mat4 clip_from_anchor{1.0f};  // takes positions minus anchor_m, subtracted in double: exact anywhere
    glm::dvec3 anchor_m{0.0};          // world, metres
    std::uint32_t size_px = 0;         // edge of the map
    LightId light;                     // owner of the map
};

/// Caster that the engine draws: wind, terrain, tessellation, GPU skinning, particles. Filters that read triangles
/// treat it by depth (docs/how-to/foliage.md). Visibility queries do not see it.
struct DrawableDesc {
    std::function<void(const DrawableView&)> draw =
        {};                // called within render(), for each map that shows it; must not throw, nor call this object
    Bounds bounds = {};    // contains all that is drawn
    bool casts = true;     // false: it only receives
    bool receives = true;  // false: no map is fitted to it
    ShadowLayers cast_layers = kAllShadowLayers;     // as CasterDesc::cast_layers
    ShadowLayers receive_layers = kAllShadowLayers;  // as CasterDesc::receive_layers
};

/// Box of air: a receiver without a surface, for fog and particles. Maps hold what darkens any place in the part of it
/// that a camera sees. Such places are looked up by gnomon_visibility(light, position) of lookup_glsl(); a mask shows
/// none of them. Draws nothing and casts nothing.
///
/// Places have no slope: one reads the map as if a plane through it faced the light. LightShadow::max_error_px holds
/// from an eighth of the way to the box's farthest point that the camera sees. Nearer air is looked up in the same
/// texels. Cost: as a mesh with the same bounds. Fit boxes closely: whatever is in one has to be in the maps.
struct AirDesc {
    glm::dmat4 world_from_box{1.0};  // places the cube from -1/2 to 1/2; affine; its bounds in the world count
    ShadowLayers receive_layers = kAllShadowLayers;  // as CasterDesc::receive_layers
};

/// Light. Its kind, range, cone and size decide where its shadow falls. Colour and intensity decide whether it is on,
/// and its rank under a budget. They may stay at their defaults where the engine has other units.
struct LightDesc {
    std::string name = {};  // in captures and messages; empty: "light" and a number; a repeated one gets .1, .2, …
    Light light = {};       // kind, colour, intensity, range, cone and size
    glm::dvec3 position_m{0.0};  // lamps: world
    /// Way in which a sun, spot, rectangle or disc shines, world; any length above 0. How a spot's map turns about it
    /// is Gnomon's choice.
    glm::dvec3 direction{0.0, -1.0, 0.0};
    /// Way of the X axis of a rectangle or tube, world; any length. What of it points along `direction` is left out. 0:
    /// Gnomon's choice.
    glm::dvec3 right{0.0};
    LightShadow shadow = {};  // accuracy and cost of its shadow
};

/// Range of depths in clip space after division by w. minus_one_to_one is OpenGL's default; zero_to_one is what
/// glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE) sets. GLM's perspective() has zero_to_one where
/// GLM_FORCE_DEPTH_ZERO_TO_ONE is defined.
enum class ClipDepth : std::uint8_t { minus_one_to_one, zero_to_one };

/// Components of a normal texture. snorm: [-1, 1], as float and SNORM formats have. unorm: [0, 1], n = 2 x - 1.
enum class NormalFormat : std::uint8_t { snorm, unorm };
/// Axes of its normals.
enum class NormalSpace : std::uint8_t { world, view };

/// View that needs shadows: a camera, and the depth buffer that the engine has drawn with it.
struct View {
    glm::dmat4 world_from_view{1.0};  // camera to world: rigid, looks along -Z, +Y up
    /// Projection, as the depths were drawn with it, jitter included. Perspective or orthographic; reversed, infinite
    /// and off-centre ones are read as they are. A flipped y or an oblique near plane is refused ("view.projection").
    glm::dmat4 clip_from_view{1.0};
    ClipDepth clip_depth = ClipDepth::minus_one_to_one;  // as the depths were drawn
    /// GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE of D16, D24 or D32F, with stencil or without. Pixel (0, 0) is the
    /// lower left one. The window's own depths and renderbuffers cannot be read.
    unsigned depth_texture = 0;
    glm::uvec2 size_px{0, 0};  // drawn part of it
    /// The same kind of texture with geometric normals, and as many samples. 0: they are derived from the depths, less
    /// exactly.
    unsigned normal_texture = 0;
    NormalFormat normal_format = NormalFormat::snorm;  // how normal_texture stores them
    NormalSpace normal_space = NormalSpace::world;     // along which axes
    /// Lights of the mask, a layer each, in this order. A handle that names no usable light has a layer of 1. Empty:
    /// all usable lights; a light's layer is then lookup_index().
    std::span<const LightId> lights = {};
    /// Casters of other layers throw no shadows in this view. Receivers of other layers have no part in its maps: their
    /// pixels may be lit. Views that see other casters or receivers of the scene share no maps, and budgets are split
    /// evenly among such groups of views.
    ShadowLayers cast_layers = kAllShadowLayers, receive_layers = kAllShadowLayers;
    /// False: no mask is drawn and no texture is read, for shaders that look lights up themselves (lookup_glsl()).
    bool wants_mask = true;
    /// True: the textures show nothing but what add_caster() added. The mask then covers what each light reaches
    /// of that, not all of its range and cone, and takes less time. Other surfaces may have 0.
    bool shows_only_added = false;
    /// Number of the frame, for the random taps of poisson_rotated, poisson_stratified, pcss and soft_triangles. Each
    /// of 1024 numbers has its own pattern, so that temporal antialiasing averages them. 0: the same pattern in every
    /// frame. Other filters do not depend on it.
    std::uint32_t noise_frame = 0;
};

/// Visibility of a view's lights.
struct Mask {
    /// GL_TEXTURE_2D_ARRAY of R8, a layer per light and sample: light i has layers i * samples to i * samples + samples
    /// - 1. 1 where the light arrives, 0 where it does not, and where the surface faces away or is out of its reach.
    /// 0 also where there is no surface. Normals are turned toward the viewer: for light through leaves take
    /// gnomon_visibility(light, position). Its size is View::size_px. Gnomon's own; valid until the next render(). 0:
    /// no mask was wanted, there are no lights, or `failure` has the reason.
    unsigned texture = 0;
    std::uint32_t layers = 0;  // lights times samples
    /// GL_TEXTURE_2D_ARRAY of RGBA8 with the same layers: the colour in which translucent casters let a light through,
    /// by which to multiply what `texture` lets arrive. 1 where there is no surface. 0: no light has translucent
    /// casters in its maps, so that all of it would be 1. Valid as long as `texture`.
    unsigned tint_texture = 0;
    /// Samples of the depth texture, 1 without multisampling. A forward shader reads the layer of a sample that it
    /// covers: findLSB(gl_SampleMaskIn[0]).
    std::uint32_t samples = 1;
    /// Reason why the view could not be read, or its mask not made; empty: none. "view.projection", "view.size",
    /// "view.depth", "view.normals", "view.lights", "context.other" (not that of create()), "instances_full", or the
    /// device's: "out_of_memory", "invalid_value", "incomplete_target", "compile_failed", "link_failed",
    /// "context_lost". "view.lights": lights times samples exceed the device's layers; name fewer in View::lights.
    std::string_view failure = {};
};

/// What became of a light's shadow in the last render(), over all views.
struct LightStatus {
    LightState state = LightState::skipped;         // the worst over all views
    Reason reason = Reason::none;                   // reason_code() names it, reason_text() explains it
    double predicted_error_px = 0.0;                // bound on how far edges of resolved casters are off, pixels
    bool keeps_max_error = false;                   // predicted_error_px is within LightShadow::max_error_px
    ResolvedWidth resolved;                         // how wide a caster must be to be resolved
    ShadowFilter filter = ShadowFilter::automatic;  // that its maps are read with; automatic: it has no shadow
    std::uint32_t maps = 0, maps_drawn = 0;         // cascades, faces or views; drawn in this frame
    std::uint32_t draws = 0;                        // draw calls into them
    std::uint32_t by_depth = 0;                     // casters without triangles that its filter treats by depth
    std::uint64_t bytes = 0;                        // memory of its maps
    std::optional<double> gpu_us;                   // time of its maps and its mask on the GPU; empty: not measured yet
};

/// Caster or light left out of the last render(). All else is unaffected; it returns once the cause is gone.
struct Dropped {
    CasterId caster;  // none: `light` is meant
    LightId light;    // none: `caster` is meant
    /// Stable code. Casters: "unknown_mesh", "meshes_full" (no device memory), "buffer_lost" (deleted, or made too
    /// small), "non_finite_transform" (also bounds that are no box), "zero_scale" (no area). Lights: "absurd_light"
    /// (numbers out of range), "non_finite_transform", "zero_rotation" (no direction).
    std::string_view reason;
};

/// Totals of the last render().
struct RenderStatus {
    bool still = false;                       // nothing changed since the last call: no map was drawn
    std::uint32_t maps_drawn = 0, draws = 0;  // maps drawn, and draw calls into them
    std::uint64_t bytes = 0;                  // memory of all maps
    double cpu_us = 0.0;                      // time of the call
    std::optional<double> gpu_us;             // time of all that it submitted; empty: not measured yet
    std::string_view failure;                 // code of the device's failure; empty: none
};

/// Limits on all shadows together. Over a limit, the least visible lights get less, and their status has the reason.
struct Budget {
    std::uint64_t bytes = 0;  // memory of maps; 0: no limit
    float gpu_ms = 0.0f;      // time per frame, as measured on this device; 0: no limit
};

/// What an engine leaves to the GLSL that looks up all lights in one program (Shadows::lookup_glsl()). Its numbers are
/// written into the text.
struct LookupOptions {
    std::uint32_t first_texture_unit = 16;  // first of texture_unit_count units in a row
    /// At least 5: three for buffers, two for each size and format of maps. Each counts as a sampler of your shader;
    /// OpenGL guarantees 16.
    std::uint32_t texture_unit_count = 12;
    std::uint32_t storage_binding = 7;  // for a shader storage buffer: alpha tests of casters
    /// Parts that the text has. Each costs time to compile, and on software devices to run. A light that needs what is
    /// left out is looked up by the nearest part, or is lit.
    bool suns = true, spots = true, points = true;
    bool alpha_tests = true;  // casters with an AlphaMask let light through
    bool antialias = false;   // LightShadow::antialias counts; the area is that of the view's pixel at the position
    /// Filters that the text has; each must read depths. Empty: triangles, pcss, pcf_bilinear and pcf_grid,
    /// which give four others to the same result.
    std::vector<ShadowFilter> filters = {};
};

/// What is chosen once, when a Shadows is created.
struct ShadowsOptions {
    Budget budget = {};  // as set_budget() sets it; none by default
    /// Lets one program look up all lights: maps become layers of shared arrays. Empty: masks alone.
    std::optional<LookupOptions> lookup = {};
    bool time_gpu = false;  // measure gpu_us by timer queries; implied by a budget in milliseconds
    /// Receives warnings and errors of the GL implementation about Gnomon's calls; advice and notes are left out.
    /// Empty: none.
    std::function<void(std::string_view)> message = {};
    /// Number of threads that search for casters and fit maps, up to 8, the calling one among them. The others start
    /// with the first frame of 16 lights or more, and sleep between calls. They call neither you nor OpenGL. 1: the
    /// calling thread does all. Default: 0, as many as the processor runs at once.
    std::uint32_t threads = 0;
};

/// Owner of maps, programs and copies of meshes in one OpenGL context. render() is called once per frame; all else at
/// any time between. The context must be current in every call, and when the object is destroyed: one object per
/// context, one thread at a time. Contexts that share its objects have limits (docs/how-to/own_context.md). A removed
/// or empty handle is ignored; handles are those of one object.
class Shadows {
public:
    /// Creates the system for the current context. Errors: "gl.version" (below 4.5 core), "gpu.scene" (no memory).
    static Result<std::unique_ptr<Shadows>> create(const ShadowsOptions& options = {});
    ~Shadows();
    Shadows(const Shadows&) = delete;
    Shadows& operator=(const Shadows&) = delete;

    /// Adds a mesh. Cost: in proportion to its triangles. Errors: "mesh.empty", "mesh.index", "mesh.position",
    /// "mesh.mask" (sizes do not fit). Where the device has no room for it, its casters are in dropped() until there
    /// is.
    Result<MeshId> add_mesh(const MeshDesc& mesh);
    /// Adds a mesh that stays in your buffers. Each render() queries the size of each such buffer, not of each mesh.
    /// Errors: "mesh.empty", "mesh.layout", "mesh.bounds", "mesh.buffer" (no buffer, or a range beyond its end).
    Result<MeshId> add_buffer_mesh(const BufferMeshDesc& mesh);
    /// Announces that the content of such a mesh's buffers changed, with its bounds in mesh space. Maps that show it
    /// are drawn again. After writes by shaders, call glMemoryBarrier() for vertices and indices before render().
    void mesh_changed(MeshId mesh, const Bounds& bounds);
    /// Removes a mesh. Casters that still have it are dropped until they are removed or have another.
    void remove(MeshId mesh);

    /// Adds a placed mesh. Maps that show it are drawn again.
    CasterId add_caster(const CasterDesc& caster);
    /// Moves a caster. Maps that show it are drawn again if the matrix differs.
    void set_transform(CasterId caster, const glm::dmat4& world_from_mesh);
    /// Replaces all fields of a caster. What is equal costs nothing.
    void set_caster(CasterId caster, const CasterDesc& desc);
    /// Removes a caster, a drawable or air.
    void remove(CasterId caster);

    /// Adds a caster that the engine draws. redraw() and remove() take it; to change other fields, remove it and add
    /// another.
    CasterId add_drawable(const DrawableDesc& drawable);
    /// Announces that a drawable draws something else from now on, within `bounds`. Maps that show it are drawn again.
    /// Without this call they stay, at no cost. `moves_at_most_m`: bound on how far any of its points has moved since
    /// the last call. Lights with LightShadow::refresh_error_px keep their maps while that allows it, and bias by it.
    /// Infinity: unknown.
    void redraw(CasterId drawable, const Bounds& bounds,
                double moves_at_most_m = std::numeric_limits<double>::infinity());

    /// Adds a box of air. Where its bounds are not finite, or it has no area, it is in dropped().
    CasterId add_air(const AirDesc& air);
    /// Moves or changes a box of air. What is equal costs nothing.
    void set_air(CasterId air, const AirDesc& desc);

    /// Adds a light. Its shadow is in the next render().
    LightId add_light(const LightDesc& light);
    /// Changes a light. What is equal costs nothing.
    void set_light(LightId light, const LightDesc& desc);
    /// Sets what few need: filters' taps, fits, formats (gnomon/shadow_tuning.h).
    void tune(LightId light, const ShadowTuning& tuning);
    /// Removes a light and frees its maps.
    void remove(LightId light);

    /// Sets the limits from the next render() on.
    void set_budget(const Budget& budget);

    /// Draws the maps that changed, and a mask per view, in the same order. The masks stay valid until the next call.
    /// No views: takes what was set, for visibility(). From the 32nd on, views share one bit of bookkeeping: maps may
    /// be drawn needlessly. Throws only std::bad_alloc while storage grows; nothing is allocated while nothing does.
    std::span<const Mask> render(std::span<const View> views);
    /// Does the same for one view.
    Mask render(const View& view) { return render(std::span(&view, 1)).front(); }

    /// Returns GLSL (4.30 or newer, without a version line) that looks up any number of lights, for forward, clustered,
    /// blended and volume shaders. Paste it into any stage; it stays the same for the life of the object. It gives:
    /// - `int gnomon_light_count()`
    /// - `float gnomon_visibility(int light, vec3 position, vec3 normal)`: the share of the light that arrives. light:
    ///   lookup_index(). position: from the view's camera, in the world's axes, metres. With a negative near plane of
    ///   an orthographic view: from the middle of that plane. normal: geometric, unit, facing the viewer
    /// - `float gnomon_visibility(int light, vec3 position)`: the same for a place in the air: fog, particles; declare
    ///   it (AirDesc)
    /// - `bool gnomon_takes_shadow(int light, int layers)`: the light's shadows fall on receivers of these layers
    /// - `gnomon_uniform_visibility(…)`: faster, where all invocations look up the same light at once.
    /// Errors: "lookup.off" (ShadowsOptions::lookup is empty), "lookup.bindings", "lookup.rows".
    Result<std::string> lookup_glsl() const;
    /// Binds what the text reads for one view of the last render(), at the options' units and bindings. They stay
    /// bound. Call it before the draws of that view. Returns false if the view could not be read, or the device has no
    /// room.
    bool bind_lookup(std::size_t view = 0);
    /// Returns the light's number in the text. -1: it has none; skip it, since the text does not check. Valid from
    /// render() to the next change of lights.
    int lookup_index(LightId light) const;
    /// Returns a sentence for a person: which filter of the text looks the light up for that view, or why it is lit.
    std::string_view lookup_status(LightId light, std::size_t view = 0) const;

    /// Returns what became of a light in the last render().
    LightStatus status(LightId light) const;
    /// Returns the totals of the last render().
    const RenderStatus& status() const;
    /// Lists what the last render() had to leave out.
    std::span<const Dropped> dropped() const;

    /// Returns the share of a light that reaches a place, 0 to 1, for gameplay. Rays decide, independent of views and
    /// maps. Casters and lights are as the last render() took them; it may have had no views. `radius_m`: size of what
    /// receives; 0: a point.
    float visibility(LightId light, const glm::dvec3& position_m, double radius_m = 0.0);

private:
    struct State;
    explicit Shadows(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon
