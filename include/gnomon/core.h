#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

/// Shadow maps for engines on any graphics API: where the maps lie, how large they are, and what is drawn into each.
/// Predicts how far an edge may be off. Draws nothing and needs GLM alone (target Gnomon::core); the guide is
/// docs/how-to/other_graphics_apis.md.
///
/// The world is right-handed, in metres; angles are in radians. Suffixes name units and spaces: `_ws` world, `_px`
/// pixels or texels of a map's edge, `_texel` lengths in texels. Matrices are `a_from_b` and multiply columns, as
/// GLM's. Equal inputs and equal histories give equal results, to the bit. Nothing here is global: different Fits and
/// Histories may be used on different threads at the same time. Only std::bad_alloc is thrown, and only while storage
/// grows.
namespace gnomon::core {

// ---------------------------------------------------------------------------------------------------------- input

/// How a camera projects: toward its place, or along parallel lines.
enum class Projection : std::uint8_t { perspective, orthographic };

/// Camera that sees the shadows. What no camera sees has no map.
struct Camera {
    glm::dvec3 position_ws_m{0.0};                    // finite
    glm::dmat3 rotation_ws{1.0};                      // columns right, up, back: it looks along -back; scale is ignored
    Projection projection = Projection::perspective;  // which of the next two fields counts
    double fov_y_rad = 0.9;                           // perspective: full vertical angle, in (0, pi)
    double half_height_m = 5.0;                       // orthographic: half of the visible height, above 0
    double near_m = 0.05;                             // perspective: above 0
    double far_m = 1.0e9;                             // above near_m; perspective: may be infinite
    glm::uvec2 viewport_px{1280, 720};                // above 0
};

/// Kind of a light. `directional`: a sun. `spot`: a cone from a place. `point`: in all directions.
enum class LightKind : std::uint8_t { directional, spot, point };

/// How your lookup reads a map. It decides how much border a map has, how far an edge may be off, and the bias.
enum class Filter : std::uint8_t {
    hard,           // one nearest comparison
    bilinear,       // one comparison that the sampler blends over 2 x 2 texels
    grid,           // kernel_texel x kernel_texel nearest comparisons
    bilinear_grid,  // kernel_texel x kernel_texel blended comparisons
    disk,           // comparisons up to spread_texel away, in any pattern
    soft,           // penumbra by the size of the source (percentage-closer soft shadows)
    variance,       // blurred moments over kernel_texel: variance shadow maps
    exponential,    // the same: exponential variance shadow maps, two warps
    moments,        // the same: four moments
};

/// How a sun's maps follow the camera.
enum class Fit : std::uint8_t {
    tight,      // the smallest rectangle around the visible receivers, new in every frame
    stable,     // a constant size around each slice of the view, in steps of its own texels
    quantised,  // around the visible receivers, in steps: a map stays until they leave it
};

/// Where a sun's cascades end along the view.
enum class Splits : std::uint8_t {
    practical,    // mixture of logarithmic and uniform splits by split_lambda
    uniform,      // slices of equal length
    logarithmic,  // slices of equal ratio
    manual,       // split_m
    seen,         // as practical, over the depths that receivers cover
};

/// How your maps store depth: 32-bit float, or 24- or 16-bit fixed point.
enum class DepthFormat : std::uint8_t { d32f, d24, d16 };

/// Largest number of a sun's cascades.
inline constexpr std::size_t kMostCascades = 8;
/// All eight layers: the default of lights and boxes.
inline constexpr std::uint8_t kAllLayers = 0xff;

/// What a light's shadow is to be. The defaults need no tuning. Invalid values are replaced by these, and the status
/// names them.
struct Shadow {
    Filter filter = Filter::bilinear;  // how your lookup reads its maps
    float max_error_px = 0.0f;         // allowed error of an edge on screen; 0: 1, as far as usual sizes meet it
    float narrowest_caster_px = 0.0f;  // width of the narrowest caster that must count, on screen; 0: any
    std::uint32_t resolution_px = 0;   // edge of one map, cascade or face; 0: chosen by the allowed error
    std::uint32_t cascades = 0;        // sun: at most kMostCascades; 0: as few as meet the allowed error, 1 to 4
    std::uint32_t kernel_texel = 3;    // filters that say so: odd, 1 to 31
    float spread_texel = 2.0f;         // Filter::disk: 0 to 16
    DepthFormat depth_format = DepthFormat::d32f;    // as you create its maps
    float near_m = 0.0f, far_m = 0.0f;               // spot and point: depth range, metres from the light; 0: fitted
    Fit fit = Fit::quantised;                        // sun
    Splits splits = Splits::practical;               // sun
    float split_lambda = 0.7f;                       // 0 (uniform) to 1 (logarithmic)
    std::array<float, kMostCascades - 1> split_m{};  // Splits::manual: along the view, rising; 0 ends the list
    float blend = 0.1f;                              // share of a cascade that fades into the next one, 0 to 0.5
};

/// A light, as far as its maps depend on it.
struct Light {
    /// Name by which the history recognises the light. Unique, and the same from frame to frame.
    std::uint64_t id = 0;
    LightKind kind = LightKind::point;    // which of the fields below count
    glm::dvec3 position_ws_m{0.0};        // spot and point; finite
    glm::dmat3 rotation_ws{1.0};          // columns right, up, back: sun and spot shine along -back
    float range_m = 0.0f;                 // spot and point: where its light ends; 0: unlimited
    float outer_cone_rad = 0.785398163f;  // spot: half angle where its light ends, in (0, pi/2]
    float source_radius_m = 0.0f;         // spot and point: radius of the source, for Filter::soft
    float sun_radius_rad = 0.0f;          // sun: angular radius, for Filter::soft
    bool enabled = true;                  // false: it gets no maps
    std::uint8_t layers = kAllLayers;     // casters and receivers that share no bit with these take no part
    Shadow shadow = {};                   // accuracy and cost of its shadow
};

/// World-space box around something that is drawn. Corners finite, min <= max. Smaller boxes give tighter maps: a
/// terrain is better given in pieces.
struct Box {
    glm::dvec3 min_ws_m{0.0}, max_ws_m{0.0};  // least and greatest corner
    bool casts = true;                        // false: light passes through it
    bool receives = true;                     // false: no map is fitted to it
    bool visible = true;                      // false: no camera draws it; it may cast all the same
    /// Lights that share no bit with these: it casts, or receives, nothing under them.
    std::uint8_t cast_layers = kAllLayers, receive_layers = kAllLayers;
    /// Fog or particles: it has no surface, does not cast, and receives anywhere in the box. Errors are stated from an
    /// eighth of the way to its farthest point that a camera sees: a camera may stand in it.
    bool air = false;
};

/// Everything that a frame's shadows follow from. The spans are read during the call only.
struct Scene {
    std::span<const Camera> cameras;  // all that see the shadows
    std::span<const Light> lights;    // each id once
    std::span<const Box> boxes;       // casters and receivers
};

/// Conventions of your API. The constants below have them for the usual ones; change `reversed_depth` and
/// `zero_to_one` as you use them.
struct Convention {
    bool reversed_depth = true;  // near is 1, far is 0, cleared to 0, lit where the lookup's depth >= the map's
    bool zero_to_one = true;     // clip depth is 0 to w; false: -w to w, as OpenGL without glClipControl
    bool clip_y_down = false;    // clip y grows downward on the screen
    bool rows_down = false;      // texture coordinate (0, 0) is the upper left corner of a rendered map
};
/// OpenGL with glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE).
inline constexpr Convention kOpenGl{};
/// Vulkan.
inline constexpr Convention kVulkan{.clip_y_down = true, .rows_down = true};
/// Direct3D 11 and 12.
inline constexpr Convention kDirect3D{.rows_down = true};
/// Metal.
inline constexpr Convention kMetal{.rows_down = true};
/// WebGPU.
inline constexpr Convention kWebGpu{.rows_down = true};

/// What the device and its API are like.
struct Settings {
    Convention convention = kOpenGl;    // conventions of your graphics API
    std::uint32_t max_map_px = 16384;   // largest edge of a map that your device has; at least 16
    std::uint32_t max_cube_px = 16384;  // the same of a cube's face
};

// --------------------------------------------------------------------------------------------------------- output

/// What became of a light. to_text() has its name, sentence() what it means.
enum class Status : std::uint8_t {
    // The light has maps.
    fitted,              // as requested
    error_above_target,  // no map that the device has meets max_error_px and narrowest_caster_px
    resolution_clamped,  // the requested size is below 16 texels or above the device's limit
    cascades_clamped,    // more cascades than a light can have
    splits_invalid,      // split_m, split_lambda or blend is invalid: the default is used
    range_invalid,       // near_m and far_m are no range: the fitted one is used
    filter_cut,          // a setting of the filter is invalid, or beyond what its map allows
    depth_coarse,        // steps of the depth format are wider than texels
    // The light has no map, and shines as if nothing stood in its way.
    off,                  // Light::enabled is false
    invalid_light,        // a number is out of its range
    no_camera,            // no usable camera
    no_visible_receiver,  // no camera sees anything within its range
    no_caster,            // nothing can darken what is seen
    fit_degenerate,       // no finite volume to draw
};
/// Returns the status' name.
const char* to_text(Status status);
/// Returns one sentence for a person: what it means.
const char* sentence(Status status);
/// Returns whether a light with this status has maps.
constexpr bool has_maps(Status status) { return status < Status::off; }

/// Half-open range of indices.
struct Range {
    std::uint32_t first = 0, count = 0;  // first index, and number of indices
};

/// How a view projects: parallel, as a spot, or as a face of a cube.
enum class ViewKind : std::uint8_t { orthographic, perspective, cube_face };

/// Numbers of the offset that keeps a surface from shadowing itself; offset_at() computes it.
/// docs/how-to/other_graphics_apis.md has the same as shader code.
struct Bias {
    /// Sides of a texel along `axis_u` and `axis_v`: metres, or metres per metre of distance along the view
    /// (perspective, cube_face).
    glm::dvec2 texel{0.0};
    /// Half-width of the filter's footprint, and the rasteriser's snapping, texels. Filter::soft: without the penumbra;
    /// the lookup adds its half-width.
    double reach_texel = 0.0;
    double depth = 0.0;        // constant part, in stored depth
    double depth_share = 0.0;  // part in proportion to the stored depth; 0 unless perspective and reversed
};

/// One map of a light: a cascade, a spot's view, a face of a cube. Draw its casters with clip_from_anchor or
/// clip_from_world. Clamp depths instead of clipping at the near plane: casters before it cast all the same.
struct View {
    std::uint32_t light = 0;  // index into Scene::lights
    /// Sun: cascade. Point: face of its cube in the order +X -X +Y -Y +Z -Z. Spot: 0; a wide one has five faces, the
    /// one ahead first, and its single view 5 while it changes from one to the other.
    std::uint32_t layer = 0;
    ViewKind kind = ViewKind::orthographic;  // how it projects
    bool stays = false;                      // its place and its casters do not depend on what the cameras see now
    bool empty = false;                      // no caster darkens what is seen in it: treat it as lit, do not draw it
    bool mirrored = false;  // drawn as in a mirror: front faces turn clockwise (cube faces, Convention::rows_down)
    glm::dvec3 anchor_ws_m{0.0};       // origin of the float matrices: subtract it in double, or as two floats
    glm::mat4 clip_from_anchor{1.0f};  // draws the map
    glm::mat4 map_from_anchor{1.0f};   // looks it up: (u, v, stored depth) after division by w, u and v in [0, 1]
    glm::dmat4 clip_from_world{1.0};   // the same from world space, for engines with small worlds or doubles
    glm::dmat4 map_from_world{1.0};    // the same for lookups
    glm::dvec3 axis_u{1.0, 0.0, 0.0}, axis_v{0.0, 1.0, 0.0}, axis_back{0.0, 0.0, 1.0};  // unit; looks along -axis_back
    glm::dvec3 eye_ws_m{0.0};  // perspective and cube_face: where the light stands; orthographic: the anchor
    /// Depth range along -axis_back from eye_ws_m, metres. Orthographic: near_m may be negative.
    double near_m = 0.0, far_m = 0.0;
    /// Sun: distances along the camera's view that the cascade serves. The next one takes over at `to_m`, after a fade
    /// from `fade_from_m` to `fade_to_m`. All 0: it serves whatever lies in it and in none before it.
    double from_m = 0.0, to_m = 0.0, fade_from_m = 0.0, fade_to_m = 0.0;
    double texel_m = 0.0;         // largest diagonal of a texel across the light, at any visible receiver
    double edge_error_px = 0.0;   // bound on the distance on screen between a resolved caster's edge and the true one
    double resolved_px = 0.0;     // width of a caster that it resolves, at its receiver across the light, on screen
    double resolved_m = 0.0;      // the same, metres
    Bias bias;                    // numbers for offset_at()
    std::uint32_t receivers = 0;  // number of visible receivers in it
    /// Bits of the cameras that look it up, by index into Scene::cameras. All from the 32nd share the last.
    std::uint32_t cameras = 0;
    Range casters;  // Fits::casters_of()
    /// Hash of the map's size and place, and of its list of casters. While it stays and none of these moved, what was
    /// drawn into the map is still right. Never 0.
    std::uint64_t content = 0;
};

/// What one light got.
struct LightFit {
    Status status = Status::off;      // what became of it
    std::uint32_t map_px = 0;         // edge of each map, texels
    std::uint32_t layers = 0;         // maps to make room for; its views may be fewer
    bool cube = false;                // point: its views are faces of a cube
    bool meets_target = false;        // it meets max_error_px, apart from the picture's pixel, and narrowest_caster_px
    double edge_error_px = 0.0;       // largest of its views
    double resolved_px = 0.0;         // largest of its views
    double resolved_m = 0.0;          // largest of its views
    double blend = 0.0;               // sun: share of a cascade that fades into the next one
    double faces_share = 0.0;         // spot: weight of the views of faces against the single view, the last one
    glm::dmat3 cube_from_world{1.0};  // cube: turns world directions from the light into those of the cube's lookup
    Range views;                      // Fits::views_of()
    Range receivers, casters;         // Fits::receivers_of(), Fits::casters_of()
};

/// What fits remember from frame to frame, so that maps stay in place while they are good enough. Keep one per world
/// and set of lights. A fresh one is valid at any time. Movable; a moved-from one may only be assigned or destroyed.
class History {
public:
    History();
    /// Copies what is remembered.
    History(const History& other);
    /// Moves it.
    History(History&&) noexcept;
    /// Copies what is remembered.
    History& operator=(const History& other);
    /// Moves it.
    History& operator=(History&&) noexcept;
    ~History();
    /// Returns whether both lead to the same fits.
    bool operator==(const History& other) const;

private:
    friend void fit_shadows(const Scene&, const Settings&, History&, class Fits&);
    struct State;
    std::unique_ptr<State> state_;
};

/// Results of a frame, and storage that the next one reuses. All spans stay valid until the next fit_shadows() with it.
/// Movable; a moved-from one may only be assigned or destroyed.
class Fits {
public:
    Fits();
    /// Moves the results.
    Fits(Fits&&) noexcept;
    /// Moves the results.
    Fits& operator=(Fits&&) noexcept;
    ~Fits();

    std::span<const LightFit> lights() const;                 // one per light of the scene, same order
    std::span<const View> views() const;                      // all lights' views, by light; cascades near to far
    std::span<const View> views_of(std::size_t light) const;  // one light's views
    /// Returns indices into Scene::boxes.
    std::span<const std::uint32_t> casters_of(const View& view) const;     // drawn into it: each once, rising
    std::span<const std::uint32_t> casters_of(std::size_t light) const;    // able to darken what is seen
    std::span<const std::uint32_t> receivers_of(std::size_t light) const;  // visible, and in the light's range
    std::uint32_t unusable_cameras() const;                                // passed over: numbers outside their ranges
    std::uint32_t unusable_boxes() const;                                  // the same of boxes

private:
    friend void fit_shadows(const Scene&, const Settings&, History&, Fits&);
    struct State;
    std::unique_ptr<State> state_;
};

/// Fits the shadow maps of a frame and writes them to `fits`. Reads and updates `history`. Call it once per frame.
/// Unusable cameras, lights and boxes are passed over and reported; the rest is as without them. Allocates nothing once
/// it has seen as large a scene. O(boxes) to notice what moved, then O(log boxes) per light and what it finds.
void fit_shadows(const Scene& scene, const Settings& settings, History& history, Fits& fits);

// -------------------------------------------------------------------------------------------------------- helpers

/// Returns the place of a point in the view's map: u, v and stored depth. NaN: it is not before the light.
glm::dvec3 map_place(const View& view, const glm::dvec3& position_ws_m);

/// Offset of a receiver before it is compared with a map.
struct Offset {
    double along_normal_m = 0.0;  // the receiver is moved along its normal first
    double depth = 0.0;  // then its stored depth is moved toward the light: added where reversed, else subtracted
};

/// Returns the smallest offset that keeps a plane from shadowing itself (docs/explanation/bias.md). `normal_ws`:
/// geometric, unit, toward the light. `error_m`: how far the position may be off the plane, beside the rounding of its
/// floats relative to the anchor. `normal_error_rad`: how far the normal may be off; the default is that of two signed
/// 16-bit numbers.
Offset offset_at(const View& view, const glm::dvec3& position_ws_m, const glm::dvec3& normal_ws, double error_m = 0.0,
                 double normal_error_rad = 4.3e-5);

}  // namespace gnomon::core
