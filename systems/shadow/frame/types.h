#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "components/light.h"
#include "components/shadow_tuning.h"
#include "engine/gl/commands.h"
#include "engine/math/aabb.h"
#include "engine/math/frustum.h"
#include "systems/report.h"
#include "systems/shadow/frame/cascade_ends.h"
#include "systems/shadow/frame/filter_demand.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/index_set.h"
#include "systems/shadow/frame/moment_demand.h"
#include "systems/shadow/frame/shader_key.h"
#include "systems/visibility/ray_records.h"

/// Structs 2 to 6 of the frame, in flow order. A later struct names an earlier one by index;
/// nothing is changed after its stage.
namespace gnomon::shadow {

/// Of a mask of consumers; those beyond its width share the last bit.
inline std::uint32_t consumer_bit(std::uint32_t consumer) { return 1u << std::min(consumer, 31u); }

/// Half-open range into a flat array.
struct IndexRange {
    std::uint32_t first = 0, count = 0;
    bool operator==(const IndexRange&) const = default;
};

/// Struct 2. What one light deserves this frame; or why it gets nothing.
struct ShadowDemand {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights
    Reason skip = Reason::none;
    Reason note = Reason::none;  // a degradation that is known already (resolution_clamped, …)
    ShadowFilter filter = ShadowFilter::hard;
    DepthFormat depth_format = DepthFormat::d32f;
    FilterDemand filtering{};         // its settings
    MomentDemand moments{};           // of FilterStorage::moments
    std::uint32_t resolution_px = 0;  // edge of the map or of a cube face: the fit takes fewer than most_px where they
    std::uint32_t most_px = 0;        // keep the light's word (accuracy_target.h)
    std::uint32_t view_count = 0;     // layers of the map
    std::uint32_t device_px = 0;      // the device's limit on that edge
    std::uint32_t most_views = 0;     // of a sun whose count of cascades is the fit's to choose; else 0
    int faces_eighths = 0;  // spot: share of cube faces against a single view (projection/spot_cube_transition.h)
    LampAim aim = {};       // of a far lamp: one view of what is seen of what it lights (projection/far_lamp_aim.h)
    bool perspective_sun = false;      // one view from an eye instead of cascades
    float cascade_blend = 0.0f;        // share of a cascade that fades into the next
    float warp = 0.0f;                 // a sun's maps are warped (fitting/directional/fit_lispsm.h) by so much at most
    double near_m = 0.0, far_m = 0.0;  // asked for, from the light or a sun's eye; 0: fitted
    std::uint32_t map_px = 0;          // of a budget, after the fit: edge of the map instead of resolution_px; 0: that
    std::uint32_t refresh_frames = 1;  // of a budget (Grant)
    bool asks_rays = false;            // FilterStorage::sheets: about pixels of which its map, if any, is not certain
    bool traced = false;               // and about all: it is to have no map
    bool gives_way = false;            // others' rays leave it none: it has another filter than its own
    double usual_px = 0.0;      // the contract chose its filter, since maps of the usual one err by so much; else 0
    bool left_to_rays = false;  // its map is not worth drawing in this frame
    bool over_budget = false;   // a budget gives it less than it asks for
    double clear_m = 0.0;       // of a lamp with a size: no caster that its maps do not hold whole comes nearer
    double weight = 0.0;        // of a budget: what its shadow means to the picture, 0 to 1
};

/// Whether it looks a map up, if it gets a shadow at all.
inline bool has_map(const ShadowDemand& demand) { return !demand.traced; }

/// Edge of the light's maps in this frame.
inline std::uint32_t map_edge_px(const ShadowDemand& demand) {
    return demand.map_px > 0 ? demand.map_px : demand.resolution_px;
}

/// Struct 3. Who is seen and lit (PSR), who can darken them (PSC). One per demand, same order.
struct PotentialSets {
    Reason skip = Reason::none;
    IndexRange receivers;        // into ShadowFrame::receiver_items
    IndexRange casters;          // into ShadowFrame::caster_items, all views of the light
    IndexRange receiver_points;  // into ShadowFrame::receiver_points_ws: corners of receivers clipped to what is seen
                                 // and reached
    IndexRange beams;            // into ShadowFrame::beams: one of a sun or a spot, one per face of a cube
};

/// Light on its way to the receivers, through one opening: a sun's sky, a spot's view, a face of the cube around a
/// light. Everything on that way is what casters may be.
struct Beam {
    bool parallel = false;        // the light comes along -axes[2]; else from the origin
    glm::dvec3 origin_ws_m{0.0};  // of the outline's coordinates
    glm::dmat3 axes{1.0};         // columns u, v, toward the light; orthonormal
    IndexRange receiver_points;   // into ShadowFrame::receiver_points_ws: what lies in this opening
    std::uint32_t receivers = 0;  // of how many that is, once for each consumer
    std::uint32_t consumers = 0;  // consumer_bit() of each that sees any of it
    IndexRange outline;           // into ShadowFrame::outlines: convex polygon around them as the light sees them, in
                                  // metres along u and v (parallel), or tangents
    double slack = 0.0;           // by how much rounding may have moved a corner of it
    double far_m = 0.0;           // farthest of them along -axes[2]
    double reach_m = 0.0;         // farthest of them from the origin; infinite if parallel
};

enum class ViewProjection : std::uint8_t { orthographic, perspective, cube_face };

/// Struct 4. One depth picture: a cascade, a spot's view, a cube face. All hard numerics end here.
struct ShadowView {
    std::uint32_t demand = 0;
    std::uint32_t layer = 0;  // cascade or face
    ViewProjection projection = ViewProjection::orthographic;
    glm::dvec3 anchor_ws_m{0.0};       // fixed to the light, never to a camera
    double apex_m = 0.0;               // perspective: how far the light stands behind the anchor, along axis_back
    glm::mat4 clip_from_anchor{1.0f};  // reversed depth in [0,1]
    glm::mat4 map_from_anchor{1.0f};   // texture coordinates instead of clip
    glm::dvec3 axis_u{1.0, 0.0, 0.0}, axis_v{0.0, 1.0, 0.0}, axis_back{0.0, 0.0, 1.0};  // world, unit
    double texel_u = 0.0, texel_v = 0.0;  // edge of a texel: metres (orthographic) or tangent at distance 1
    double near_m = 0.0, far_m = 0.0;     // along -axis_back from the anchor's plane; perspective: from the light
    double depth_alpha = 0.0, depth_beta = 0.0;  // perspective: depth = alpha + beta / distance
    glm::dvec2 half_extent_m{0.0};               // orthographic: half of the map's sides along axis_u and axis_v
    glm::dvec2 centre_ls_m{0.0};  // orthographic: the map's centre from the anchor, along axis_u and axis_v
    glm::dvec2 warp{0.0};  // orthographic: gradient of w along axis_u and axis_v, per metre (projection/lispsm_math.h);
                           // extents, centre and texels are then those of the warped plane, near_m that at the anchor
    glm::dvec2 tan_low{0.0}, tan_high{0.0};  // perspective, cube face: sides of the map at distance 1
    double seen_from_m = 0.0;                // cascades: nearest view distance this one serves
    double seen_to_m = 0.0;                  // view distance from which the next cascade serves; 0: where its map ends
    double fades_from_m = 0.0;  // view distance from which it may fade into the next, and where only its map's border
    double fades_to_m = 0.0;    // keeps it from having done so; both 0: at any distance
    double texel_m = 0.0;       // largest diagonal of a texel across the light, at a receiver
    double texel_extent_px = 0.0;       // longest extent of a texel on screen: Lloyd's m (error_bound.h)
    double predicted_error_px = 0.0;    // how far a shadow edge may be off on screen
    double metre_px = 0.0;              // longest extent on screen of a metre across the light, on a receiver
    std::uint32_t consumer_mask = ~0u;  // who may look it up: consumer_bit() of each that sees receivers in it
    std::uint32_t receivers = 0;        // how many are seen in it
    bool held = false;   // meant to stay while cameras move: its casters are all that its map can show, so that the map
                         // holds; else only those that can darken what is seen now
    IndexRange casters;  // into ShadowFrame::view_caster_items: those that stand still before those that move, each by
                         // mesh, then by index; drawn in that order, since of equal depths the first drawn one stays
    std::uint32_t still_casters = 0;  // how many of them stand still
    bool lit = false;  // nothing can darken what it serves: it is published, but neither drawn, cleared nor looked up
};

/// Where the light of a perspective view or a cube's face stands.
inline glm::dvec3 apex_ws_m(const ShadowView& view) { return view.anchor_ws_m + view.axis_back * view.apex_m; }

/// How a view that is drawn uses the store of still casters beside its light's map (static_caster_copy.h).
enum class StillUse : std::uint8_t {
    none,
    fill,  // still casters are drawn into the map and copied there, before the others are drawn
    copy   // they are copied back from there instead of being drawn
};

/// Why a view whose casters moved keeps the map that it has.
enum class Hold : std::uint8_t {
    none,
    within_error,  // LightShadow::refresh_error_px
    by_turn        // a budget: others are drawn in this frame (Grant::refresh_frames, update_scheduler.h)
};

/// How far off shadows are in a map of casters as they were (stale_error.h).
struct Staleness {
    double moved_m = 0.0;   // farthest that any point of a caster moved since
    double error_px = 0.0;  // how much farther off a shadow edge may be on screen
};

/// Struct 5. Where the view lives, and whether last frame's content still holds.
struct ShadowSlot {
    gl::TextureHandle texture{};
    gl::TextureHandle triangles{};     // what each texel shows: FilterStorage::depth_and_triangle; of ::sheets one
                                       // layer that all views draw into, one after the other; else {0}
    gl::TextureHandle second{};        // FilterStorage::sheets: depths of the next triangles behind; else {0}
    gl::TargetHandle second_target{};  // this view's layer of it
    gl::TextureHandle bounds{};        // and where sheets end, and how far they depart from their depths
    gl::TargetHandle bounds_target{};
    gl::BufferHandle ends{};           // FilterStorage::soft_sheets: what a source with a size asks of those; else {0}
    gl::TextureHandle moments{};       // FilterStorage::moments: what the depths become; else {0}
    gl::TargetHandle moment_target{};  // this view's layer of it
    gl::TextureHandle scratch{};       // between the two passes of its blur; {0} if there is one pass alone
    gl::TargetHandle scratch_target{};
    gl::TargetHandle target{};
    gl::TargetHandle whole{};  // all layers of the light's map, where one pass draws all of its views; else {0}
    CubeRoute route = CubeRoute::six_passes;
    std::uint32_t size_px = 0;
    std::uint64_t content = 0;         // signature of what the layer is to hold (content_signature)
    std::uint64_t placement = 0;       // the same without its casters
    std::uint64_t moment_content = 0;  // the same of its moments
    std::uint64_t still_content = 0;   // the same of its still casters alone
    StillUse still_use = StillUse::none;
    gl::TextureHandle still{}, still_triangles{};  // where those are kept, if used; {0} where the map has none
    bool reuse = false;
    bool convert = false;             // the moments have to be made anew
    bool changed = false;             // the layer shows other than what it should: it is drawn, or has to wait (Grant)
    std::uint64_t shown_content = 0;  // signature of what the layer holds
    Staleness if_held{};              // what keeping that would mean; infinite: it cannot be told, or must not be
    std::uint32_t waited_frames = 0;  // for how many it was kept by turns
    Hold hold = Hold::none;           // it is kept,
    Staleness stale{};                // and means this; else nothing
};

/// Keeps what the layer holds, for this frame.
inline void keep_layer(ShadowSlot& slot, Hold why) {
    slot.hold = why;
    slot.content = slot.shown_content;
    slot.stale = slot.if_held;
    slot.reuse = true;
}

inline constexpr std::uint32_t kMaxViews = 8;  // kMaxViews in shaders/shadow/lookup/light_block.glsl
static_assert(kMaxViews == kHeldViews);

/// Matches ViewRecord in shaders/shadow/lookup/light_block.glsl (std140).
struct ViewRecord {
    glm::mat4 map_from_anchor{1.0f};
    glm::vec4 axis_u{0.0f}, axis_v{0.0f}, axis_back{0.0f};
    glm::vec4 numeric{0.0f};
    glm::vec4 anchor_from_camera{0.0f};
    bool operator==(const ViewRecord&) const = default;
};
static_assert(sizeof(ViewRecord) == 144);

/// Matches LightBlock in shaders/shadow/lookup/light_block.glsl (std140).
struct LightRecord {
    glm::vec4 position{0.0f};
    glm::vec4 to_light{0.0f};
    glm::vec4 radiance{0.0f};
    glm::vec4 cone{0.0f};
    glm::ivec4 options{0};
    glm::vec4 bias{0.0f};
    glm::ivec4 filtering{0};
    glm::vec4 spread{0.0f};
    glm::ivec4 seed_cell{0};
    glm::vec4 seed_place{0.0f};
    glm::vec4 moments{0.0f}, moment_sampling{0.0f};
    glm::vec4 low{0.0f};
    ViewRecord views[kMaxViews];
};
static_assert(sizeof(LightRecord) == std::size_t{13} * 16 + kMaxViews * sizeof(ViewRecord));

/// Matches DepthViewBlock in shaders/shadow/passes/depth/depth_view_block.glsl (std140).
struct DepthViewRecord {
    glm::mat4 clip_from_anchor{1.0f};
    glm::vec4 anchor_high{0.0f}, anchor_low{0.0f};
};
static_assert(sizeof(DepthViewRecord) == 96);

/// Matches CameraBlock in shaders/common/camera_block.glsl (std140).
struct CameraRecord {
    glm::mat4 clip_from_anchor{1.0f};
    glm::vec4 anchor_high{0.0f}, anchor_low{0.0f};
    glm::vec4 right{0.0f}, up{0.0f}, back{0.0f};
    glm::vec4 unproject{0.0f};
};
static_assert(sizeof(CameraRecord) == 160);

/// What a light's report says of the shadow that is looked up so.
struct LookupAccuracy {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: there is nothing to look up
    double predicted_error_px = 0.0;                // worst over its views; 0: none shows an edge
    bool keeps_max_error = false;
};

/// How a light is looked up while its own row's program cannot be had: one tap of the depths that it has in any case.
struct PlainLookup {
    ProgramRow row;  // no filter file: the light has no map
    gl::TextureHandle map{};
    gl::SamplerHandle sampler{};
    LookupAccuracy accuracy;
};

/// Struct 6. One light as one consumer's lighting needs it: GPU-ready, with the textures to bind.
struct LightingLight {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights and FrameReport::lights
    ProgramRow row;
    gl::TextureHandle map{}, triangles{};  // triangles: {0} unless row.triangles
    gl::TextureHandle second{}, bounds{};  // {0} unless row.sheets
    gl::BufferHandle ends{};               // {0} unless they are of a source with a size
    gl::SamplerHandle sampler{};
    visibility::RayBuffers rays{};  // {0} unless row.rays
    PlainLookup plain;
    gl::Rect screen{};            // pixels the light can reach; empty: none
    float farthest_depth = 0.0f;  // of the picture: surfaces that it can reach have larger ones, and the sky never has
    /// Of all that a lookup's result at a place of the picture follows from, beside that place and the camera
    /// (visibility_hash.h): the same number, the same visibility. 0: nobody knows, or it is not to be kept.
    std::uint64_t lookup_signature = 0;
    LightRecord record;
};
struct LightingInputs {
    std::uint32_t consumer = 0;
    CameraRecord camera;
    std::vector<LightingLight> lights;
};

/// Reused storage of the fits; holds nothing between them.
struct FitScratch {
    std::vector<glm::dvec3> points_ws;
    std::vector<glm::dvec2> points, hull, outline, profile;
    std::vector<DepthSpan> depths;
};

/// Reused storage of the search for receivers and casters; holds nothing between two searches.
struct SetScratch {
    struct Candidate {
        std::uint32_t item, consumer;
    };
    Marks marks, receivers;  // of instances
    std::vector<Candidate> candidates;
    std::vector<glm::dvec3> points_ws;
    std::vector<glm::dvec2> points, polygon, clipped;
    std::vector<std::uint32_t> items, mesh_starts;
};

/// Everything of one frame between snapshot and commands. Storage is reused from frame to frame.
struct ShadowFrame {
    std::vector<std::uint64_t> moving;          // which instances move, as CasterMotion::moving(); none: none
    std::vector<ShadowDemand> demands;          // one per light
    bool shared_out = false;                    // within a budget: another filter waits for the next frame's shares
    std::vector<math::Frustum> seen;            // one per consumer: what it sees
    std::vector<glm::dvec3> lamps_ws_m;         // one per light: from where its shadows are looked for, if it is local
                                                // (lamp_offsets.h); none: from where the lights are
    std::vector<PotentialSets> sets;            // one per demand
    std::vector<std::uint32_t> receiver_items;  // indices into SceneSnapshot::instances
    std::vector<std::uint32_t> caster_items;
    std::vector<glm::dvec3> receiver_points_ws;
    std::vector<Beam> beams;
    std::vector<glm::dvec2> outlines;
    std::vector<ShadowView> views;
    std::vector<std::uint32_t> view_caster_items;
    std::vector<ShadowSlot> slots;       // one per view
    std::vector<LightingInputs> inputs;  // one per consumer
    History next_history;                // what the fits hand to the next frame
    SetScratch set_scratch;
    FitScratch fit_scratch;
    std::vector<double> cpu_us;  // one per light: what the stages spent on it alone
};

/// From where a local light's shadows are looked for.
inline const glm::dvec3& lamp_ws_m(const ShadowFrame& frame, const SceneSnapshot& scene, std::uint32_t light) {
    return light < frame.lamps_ws_m.size() ? frame.lamps_ws_m[light] : scene.lights[light].position_ws_m;
}

/// Those of a view, still ones first.
inline std::span<const std::uint32_t> casters_of(const ShadowFrame& frame, const ShadowView& view) {
    return std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
}

/// Takes all slots of a light whose maps cannot be made; its set says why, or its demand, if rays do without.
inline void drop_light(ShadowFrame& frame, std::uint32_t demand, Reason reason) {
    (frame.demands[demand].asks_rays ? frame.demands[demand].note : frame.sets[demand].skip) = reason;
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (frame.views[v].demand == demand) frame.slots[v] = {};
}

/// Takes a light's prefiltered maps, whose programs cannot be had: its depths are read instead (PlainLookup).
inline void drop_moments(ShadowFrame& frame, std::uint32_t demand) {
    frame.demands[demand].note = Reason::filter_program_failed;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (frame.views[v].demand != demand) continue;
        ShadowSlot& slot = frame.slots[v];
        slot.moments = slot.scratch = {};
        slot.moment_target = slot.scratch_target = {};
        slot.convert = false;
    }
}

}  // namespace gnomon::shadow
