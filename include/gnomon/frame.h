#pragma once
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/box.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "gnomon/reason.h"
#include "gnomon/result.h"

namespace gnomon::ecs {
class Registry;
}
namespace gnomon::assets {
struct MeshLibrary;
}

namespace gnomon::debug {

struct ViewDrawer;

/// A debug view.
struct ViewRow {
    std::string_view name;     // for example "cascades"
    bool needs_light;          // false: it can show all lights at once
    std::string_view meaning;  // one line
    const ViewDrawer* drawer;  // how Gnomon draws it
};

/// Lists all views.
std::span<const ViewRow> view_table();
/// Finds a view by name; null if there is none.
const ViewRow* find_view(std::string_view name);

/// Debug view to draw over the picture; docs/how-to/debug.md shows all.
struct Request {
    const ViewRow* view = nullptr;            // null: none, at no cost
    std::string light = {};                   // name of the light; empty: all, for views that can show all
    std::optional<std::uint32_t> layer = {};  // one of its maps; empty: all
    gl::Rect area = {};                       // part of the picture in pixels, y up; without width: whole picture
};

/// Text for the application to draw, because views draw only pictures.
struct Label {
    glm::ivec2 at_px{0};                   // upper left corner of the text, from the picture's lower left
    std::string text;                      // one line
    std::optional<glm::vec3> swatch = {};  // sRGB; a square of this colour before the text
};

}  // namespace gnomon::debug

namespace gnomon::shadow {

/// Limits on all shadows together (docs/how-to/budgets.md).
struct ShadowBudget {
    static constexpr std::uint64_t kUnlimited = ~std::uint64_t{0};  // for `bytes`
    /// GPU memory of all lights: maps, triangles, moments, copies. 0: 256 MB, and in proportion more for pictures with
    /// more pixels than 1920 x 1080. Lights with a given size or accuracy then come on top. Raise it where lights
    /// report budget_shrunk and the device has the memory.
    std::uint64_t bytes = 0;
    float gpu_ms = 0.0f;     // GPU time per frame for drawing maps and looking them up; 0, negative or NaN: no limit
    std::uint64_t rays = 0;  // predicted rays per frame of lights that use rays; 0: no limit
    bool operator==(const ShadowBudget&) const = default;
};

/// What the fits of all lights remember from frame to frame. It needs no device and outlives one.
struct History;

}  // namespace gnomon::shadow

/// Gnomon's own renderer of a registry, for programs without one. Each frame gives a picture, and a report of the work
/// for each light with the reasons. An engine with a renderer takes gnomon/shadows.h instead.
namespace gnomon {

/// Numbers behind the result of a light or one of its views.
struct Why {
    std::uint32_t receivers = 0;    // visible and in the light's range, by their bounds
    std::uint32_t casters = 0;      // able to darken those receivers' visible part
    std::uint64_t bytes_saved = 0;  // bytes of maps that were not made, or not written
    double stale_px = 0.0;          // additional error of edges because maps show casters at an earlier place
    /// Maximum contribution of the light to a pixel, in 8 bit steps of the picture. Empty: exposure unknown, or not
    /// computed.
    std::optional<double> display_steps;
    std::optional<double> saved_us;  // drawing time saved, by its last measurement; empty: never measured
};

/// View that a light's map has room for: a cascade, a spot's view, a face of a cube.
struct ViewReport {
    std::uint32_t layer = 0;                  // cascade or face
    LightState state = LightState::rendered;  // rendered; reused; or skipped: neither drawn nor looked up
    Reason reason = Reason::none;             // why it has that state
    Why why;                                  // numbers behind it
};

/// Visibility of a light per pixel, kept from an earlier frame instead of looked up (docs/explanation/caching.md).
struct KeptReport {
    Reason reason = Reason::none;    // visibility_kept: this frame read it, in at least one picture
    std::uint64_t bytes = 0;         // over all pictures; part of LightCounts::bytes
    std::optional<double> saved_us;  // lighting time saved on the GPU, by the last measurement of its lookup
};

/// Reduction of a light by a budget, and its numbers.
struct BudgetReport {
    std::uint32_t wanted_px = 0, px = 0;        // edge of its maps
    std::uint32_t wanted_views = 0, views = 0;  // layers of its map
    std::uint32_t refresh_frames = 1;           // moving content is drawn once in this number of frames
    bool plain = false;                         // looked up with one tap instead of its filter
    std::uint64_t wanted_bytes = 0, bytes = 0;  // bytes of its map
    double wanted_us = 0.0, us = 0.0;           // GPU time per frame, by the model
    double harm = 0.0;                          // share of the picture that is wrong because of it, by the model
};

/// Filter of a light, and the reason.
struct FilterReport {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: the light is skipped
    Reason reason = Reason::none;                   // map_too_coarse: chosen by the accuracy target
    std::optional<double> usual_error_px;           // error of the default filter's maps, in that case
    std::optional<double> usual_resolved_px;        // width that a caster must have for those maps to resolve it
};

/// Views of a light in FrameReport::views.
struct ReportedViews {
    std::uint32_t first = 0, count = 0;  // count 0: it has none
};

/// Maps of a light, and the work on them in this frame.
struct LightCounts {
    std::uint32_t views = 0;              // rendered or reused
    std::uint32_t views_drawn = 0;        // drawn in this frame
    std::uint64_t texels = 0;             // size of its map
    std::uint64_t bytes = 0;              // its memory, kept visibility included
    BytesByPart parts;                    // the same by part
    std::uint32_t draws = 0, clears = 0;  // draws of meshes, or parts of them, and clears of maps in this frame
    std::uint32_t draw_commands = 0;      // commands that make those draws; one makes all that need the same state
    std::uint64_t triangles = 0;          // drawn into maps in this frame
    std::uint64_t full_triangles = 0;     // the same without proxies
    std::uint32_t by_depth = 0;           // casters without triangles, where its filter reads those of others
};

/// Result of the shadow stages for one light.
struct LightReport {
    ecs::Entity entity;                      // its entity
    std::string name;                        // its Name, made unique
    LightKind kind = LightKind::point;       // as Light::kind
    LightState state = LightState::skipped;  // what the frame did for its shadow
    Reason reason = Reason::none;            // why it has that state
    double predicted_error_px = 0.0;         // bound on the error of edges of resolved casters, over its views
    bool keeps_max_error = false;            // meets LightShadow::max_error_px, apart from the picture's own pixel
    ResolvedWidth resolved;                  // how wide a caster must be to be resolved, over its views
    LightCounts counts;                      // maps and work
    double cpu_us = 0.0;           // time of the shadow stages for this light alone; those of lights on threads overlap
    std::optional<double> gpu_us;  // shadow and lighting pass, from the newest measured frame; empty: not measured
    Why why;                       // numbers behind its state
    KeptReport kept;               // visibility per pixel kept from earlier frames
    FilterReport filter;           // filter that reads its map
    std::optional<BudgetReport> budget;  // empty: no budget is set, or the light needed no map
    ReportedViews views;                 // its views; empty if skipped
};

/// Returns true if the light is lit everywhere on purpose, because its shadow would be invisible. Pixels that it should
/// darken are then no errors.
inline bool is_left_out(const LightReport& light) {
    return light.state == LightState::skipped &&
           (light.reason == Reason::light_off || light.reason == Reason::below_display_step);
}

/// Shared resources of lights with rays (exact, exact_soft): trees over the casters, on the device and on the host, and
/// data of pictures. All 0: no light uses rays.
struct RayReport {
    std::uint64_t bytes = 0, host_bytes = 0;              // trees over casters
    std::uint64_t list_bytes = 0;                         // undecided pixels and their results
    std::uint64_t place_bytes = 0;                        // exact surface positions, per pixel
    std::uint64_t sheet_bytes = 0, sheet_host_bytes = 0;  // vertex data for drawing maps of sheets
    std::uint64_t triangles = 0, instances = 0;           // in the trees
    std::uint32_t meshes_written = 0;                     // deformed meshes in this frame
    bool instances_written = false;                       // something moved in this frame
};

/// Why an entity could not be used; reason_code() spells it.
enum class DropReason : std::uint8_t {
    non_finite_transform,  // NaN or infinity in its place
    zero_rotation,         // a rotation of length 0
    parent_missing,        // its parent is dead, or has no Transform
    parent_cycle,          // it is its own ancestor
    unknown_mesh,          // MeshRef::mesh is beyond the library, or removed
    zero_scale,            // it has no extent
    absurd_light,          // a number of its Light is out of range
    absurd_camera,         // a number of its Camera is out of range
    instances_full,        // the device has no record for it: neither drawn nor casting
    meshes_full,           // the device has no room for its mesh: neither drawn nor casting
    buffer_lost,           // a buffer of its mesh is the engine's, and was deleted or made smaller
    absurd_fog,            // a number of its FogVolume is out of range, or it has a MeshRef as well
};
/// Returns the code's name, as reports and files spell it.
const char* reason_code(DropReason reason);

/// Entity that was unusable in this frame, and the reason. Others are unaffected.
struct DroppedEntity {
    ecs::Entity entity = {};                               // its entity
    std::string name = {};                                 // its Name; empty: none
    DropReason reason = DropReason::non_finite_transform;  // why it is left out
};

/// What the last frame did, light by light, and the reasons.
struct FrameReport {
    std::vector<LightReport> lights;     // one per entity with a Light, by entity index
    std::vector<ViewReport> views;       // views of all lights, in their order
    std::vector<DroppedEntity> dropped;  // entities that were unusable
    bool still = false;                  // no input of shadows changed: the stages' results of the last frame are valid
    std::uint32_t samples = 1;           // per pixel in the picture, at most FrameSettings::still_samples
    std::uint64_t programs_compiled = 0;          // in this frame, failures included
    double shadow_cpu_us = 0.0;                   // time of all shadow stages on the CPU, microseconds
    double cpu_us = 0.0;                          // time of the whole frame on the CPU, microseconds
    std::optional<double> gpu_us, shadow_gpu_us;  // the same on the GPU; empty: not measured
    gl::Failure failure = gl::Failure::none;      // failure of an essential resource, or of the submission
    RayReport rays;                               // resources of lights with rays
    /// Returns the views of one of its lights.
    std::span<const ViewReport> views_of(const LightReport& light) const {
        return std::span(views).subspan(light.views.first, light.views.count);
    }
    /// Clears the last frame. Lights and dropped entities stay, because their names own memory; the stages overwrite
    /// them.
    void clear() {
        views.clear();
        still = false;
        samples = 1;
        programs_compiled = 0;
        shadow_cpu_us = cpu_us = 0.0;
        gpu_us.reset();
        shadow_gpu_us.reset();
        failure = gl::Failure::none;
        rays = {};
    }
};

/// What the application chooses for one frame. The defaults suit a game.
struct FrameSettings {
    glm::uvec2 viewport_px{1280, 720};      // size of the picture, each 1 to the device's largest texture
    std::optional<float> exposure_ev = {};  // EV100; empty: automatic
    bool shadows = true;                    // false: every light is treated as if its LightShadow were disabled
    bool present = false;                   // copy the picture to the window at the end
    /// Block at the end of a frame for what the GPU measures (CascadeSplits::sampled; automatic exposure with faint
    /// lights). Every run then draws the same pictures. Otherwise nothing blocks, and measurements arrive some frames
    /// later.
    bool repeatable = false;
    debug::Request debug = {};  // drawn over the picture; none by default
    /// Keep shadows fitted to the cameras of the first frame with this flag, while the picture follows its own camera.
    /// Lights and casters stay live: shadows follow them as the frozen cameras need it.
    bool freeze_fits = false;
    /// Cost limit for shadows; the least visible ones get less until it is met (docs/how-to/budgets.md).
    shadow::ShadowBudget shadow_budget = {};
    /// Skip shadows that cannot be seen in the picture (docs/explanation/caching.md).
    bool leave_out_dim_lights = true;
    /// Maximum number of light programs compiled per frame. Until its program is compiled, a light is looked up with
    /// one tap and reports filter_program_waits. Default: no limit.
    std::uint32_t programs_per_frame = ~0u;
    bool rays = true;  // false: lights with rays get a filtered map instead
    /// Maximum number of samples per pixel. While nothing changes, each run() adds one and draws no map; the picture is
    /// their mean. Once all are there, run() draws only that mean. Each change begins with the pixel's middle again.
    /// Default: that alone. Debug views have one sample.
    std::uint32_t still_samples = 1;
    /// Number of the frame, for filters with random taps or rays; see View::noise_frame (gnomon/shadows.h). Samples of
    /// a still picture count on from it by themselves. 0: the same pattern in every frame. Set it where pictures are
    /// averaged outside; each change of it restarts still_samples.
    std::uint32_t noise_frame = 0;
    /// Smooth stair-steps of edges by what the picture itself shows, while it has fewer than 8 samples per pixel.
    bool smooth_edges = false;
    /// Draw nothing behind the surfaces, for a picture to be laid over another one (docs/how-to/compositing.md). Its
    /// alpha is 1 on surfaces and 0 beside them; blended surfaces and shadow catchers lie between. Colours are
    /// multiplied by alpha, as light. Default: an opaque sky.
    bool transparent = false;
    /// Measure gpu_us. Software devices finish their work around each timer, which slows frames down. A budget in
    /// milliseconds measures by itself, except there.
    bool time_gpu = false;
};

/// What is chosen once, when a Frame is created.
struct FrameOptions {
    /// Receives messages of the GL implementation about Gnomon's calls. Empty: none.
    std::function<void(std::string_view)> message = {};
    /// Memory of a frame that lost its context: pictures continue bit for bit. Null: a new beginning.
    std::shared_ptr<const shadow::History> history = nullptr;
    std::uint32_t threads = 0;  // as ShadowsOptions::threads (gnomon/shadows.h)
};

/// Device behind a frame.
struct FrameDevice {
    std::string name;               // the renderer and OpenGL's version, as the driver states them
    std::uint32_t max_side_px = 0;  // longest side of a picture
};

/// Draws a registry: transforms, shadows, lighting. The OpenGL 4.5 core context must be current in every call, and when
/// the object is destroyed. Calls leave its state as it was, except the window's picture (FrameSettings::present).
class Frame {
public:
    /// Creates the renderer for the current context. `library` must outlive it. Between frames meshes may come to the
    /// library and go (MeshLibrary::add(), replace(), remove()). Errors: "gl.version" (below 4.5 core), "gpu.scene" (no
    /// memory).
    static Result<std::unique_ptr<Frame>> create(const assets::MeshLibrary& library, const FrameOptions& options = {});
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    /// Draws one frame of `world` for its first active camera. Never throws; failures are in report(). Reads the
    /// world's changes with its own cursors, independent of other readers.
    void run(ecs::Registry& world, const FrameSettings& settings);
    /// Returns what the last run() did, light by light. Valid until the next one.
    const FrameReport& report() const;
    /// Returns the device that draws.
    const FrameDevice& device() const;

    /// Returns the last frame's picture, a GL_TEXTURE_2D of GL_SRGB8_ALPHA8; 0: none was drawn. It is Gnomon's, and
    /// valid until the next run(). Until then a program may draw over it, through a framebuffer of its own.
    unsigned picture_texture() const;
    /// Reads it: viewport_px, 4 bytes sRGB per pixel, top row first. Returns false if there is none.
    bool read_picture(std::vector<std::uint8_t>& rgba);
    /// Reads how much of a light arrives at each pixel: a float per pixel, bottom row first. 1: lit. 0: shadowed,
    /// facing away or out of range. -1: no surface. Returns false if there is none.
    bool read_visibility(ecs::Entity light, std::vector<float>& values);
    /// Reads the colour that a light's translucent casters let through to each pixel's surface: red, green, blue, and
    /// 1, in the same order. 1: all of it, also where there is no surface. Returns false if there is no picture.
    bool read_tint(ecs::Entity light, std::vector<glm::vec4>& values);

    /// Returns the share of a light that reaches a place, 0 to 1, for gameplay. Rays decide, independent of cameras and
    /// maps. Casters and lights are those of the last run(). `radius_m`: size of what receives; 0: a point.
    float visibility(ecs::Entity light, const glm::dvec3& position_m, double radius_m = 0.0);

    /// Returns the labels of the last frame's debug view; empty without one.
    const std::vector<debug::Label>& debug_labels() const;
    /// Returns a copy of what FrameOptions::history takes.
    std::shared_ptr<const shadow::History> history() const;

private:
    struct State;
    explicit Frame(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// Place of a visibility query: a point, or a sphere; the half of it that faces the light receives.
struct LitPlace {
    glm::dvec3 position_m{0.0};  // world
    double radius_m = 0.0;       // 0: a point
};

/// Effort and limits of a query; the defaults serve games.
struct VisibilityOptions {
    /// Rays per place where the place or the light has a size (Light::source_radius_m, sun_radius_rad); at least 1.
    /// Elsewhere one ray is all there is. The same places on both in every query, spread evenly.
    std::uint32_t samples = 16;
    /// Distance along the ray below which casters are ignored, to leave out the surface under the place, metres. A
    /// surface exactly at the place, to double's rounding, is always ignored.
    double nearest_m = 0.0;
    unsigned threads = 1;  // that share the places, this one included; at least 1
};

/// Visibility of lights for rules of a game, servers and tests: rays alone, without a registry, a device or a picture.
/// Costs no memory before the first ask(). A copy makes its own trees.
class VisibilityQueries {
public:
    /// Creates queries without casters. `library`, with complete() meshes, must outlive them. Bent ones count at rest.
    explicit VisibilityQueries(const assets::MeshLibrary& library);
    /// Copies casters and their places.
    VisibilityQueries(const VisibilityQueries& other);
    /// Replaces all of it by copies.
    VisibilityQueries& operator=(const VisibilityQueries& other);
    /// Moves all of it; `other` may only be assigned or destroyed then.
    VisibilityQueries(VisibilityQueries&& other) noexcept;
    /// Replaces all of it by what `other` has.
    VisibilityQueries& operator=(VisibilityQueries&& other) noexcept;
    ~VisibilityQueries();

    /// Adds a caster and returns its number: 0, 1, … It casts nothing until it is placed, nor once its mesh was
    /// replaced or removed.
    std::size_t add_caster(std::uint32_t mesh);
    /// Moves a caster. The same place costs nothing. A place that is not finite, or has no volume, casts nothing.
    void place(std::size_t caster, const WorldTransform& at);

    /// Sets shares[i] to the share of `light` that reaches places[i], 0 to 1; both spans have equal length. 0 beyond
    /// its range and outside its cone; attenuation and angles of incidence do not count. Both faces of casters block,
    /// except where an alpha mask has a hole. Exact in double; results do not depend on batches,
    /// order or threads.
    void ask(const Light& light, const WorldTransform& light_at, std::span<const LitPlace> places,
             std::span<float> shares, const VisibilityOptions& options = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gnomon
