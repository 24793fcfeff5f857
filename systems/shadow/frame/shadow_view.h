#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "systems/shadow/frame/cascade_ends.h"
#include "systems/shadow/frame/index_range.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

enum class ViewProjection : std::uint8_t { orthographic, perspective, cube_face };

/// Position and orientation of a view in the world.
struct ViewPose {
    glm::dvec3 anchor_ws_m{0.0};  // fixed to the light, never to a camera
    double apex_m = 0.0;          // perspective: distance of the light behind the anchor, along axis_back
    glm::dvec3 axis_u{1.0, 0.0, 0.0}, axis_v{0.0, 1.0, 0.0}, axis_back{0.0, 0.0, 1.0};  // unit
};

/// Depths of a view, along -axis_back from the anchor's plane; perspective: from the light.
struct ViewDepths {
    double near_m = 0.0, far_m = 0.0;
    double alpha = 0.0, beta = 0.0;  // perspective: stored depth = alpha + beta / distance
};

/// Sides and texels of a view's map across the light: metres (orthographic), or tangents at distance 1.
struct MapPlane {
    double texel_u = 0.0, texel_v = 0.0;  // edges of a texel
    glm::dvec2 half_extent_m{0.0};        // orthographic: half of the map's sides along axis_u and axis_v
    glm::dvec2 centre_ls_m{0.0};          // orthographic: the map's centre from the anchor, along the same
    /// Orthographic: gradient of w along axis_u and axis_v, per metre (projection/lispsm_math.h). Extents, centre and
    /// texels are then those of the warped plane, near_m that at the anchor. 0: not warped.
    glm::dvec2 warp{0.0};
    glm::dvec2 tan_low{0.0}, tan_high{0.0};  // perspective, cube face: sides of the map
};

/// View distances that one cascade serves, metres. All 0: any.
struct ServedDistances {
    double seen_from_m = 0.0;   // start
    double seen_to_m = 0.0;     // end, where the next cascade takes over; 0: where its map ends
    double fades_from_m = 0.0;  // start of the fade into the next cascade
    double fades_to_m = 0.0;    // end of the fade, unless the map's border lies farther away
};

/// Accuracy of a view, and the size of its texels on the screen of the camera that sees them largest
/// (fitting/error_bound.h). All 0: it shows no receiver.
struct ViewError {
    double texel_m = 0.0;    // largest diagonal of a texel across the light, at a receiver
    double extent_px = 0.0;  // longest extent of a texel on screen: aliasing error m (Lloyd et al. 2006)
    /// Bound on the error on screen of an edge that texels decide, wherever it is. The size of maps follows it.
    double texel_edge_px = 0.0;
    double rounding_px = 0.0;  // on screen: how far off positions are that the picture rebuilds from its depths
    double edge_px = 0.0;      // bound on the error on screen of edges of resolved casters, by the view's own filter
    double grid_px = 0.0;      // part of edge_px that the picture's pixel grid causes by itself
    double resolved_m = 0.0;   // width of a caster, at its receiver across the light, that the map resolves
    double metre_px = 0.0;     // longest extent on screen of a metre across the light, on a receiver
    /// Largest distance of a caster's surface from that of the mesh that it is drawn as, metres. 0: all are drawn as
    /// they are (fitting/choose_proxies.h).
    double proxy_m = 0.0;
};

/// Struct 4. Shadow view: one depth map of a cascade, a spot or a cube face. All double-precision geometry ends here.
struct ShadowView {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights
    std::uint32_t layer = 0;  // cascade or face
    ViewProjection projection = ViewProjection::orthographic;
    glm::mat4 clip_from_anchor{1.0f};  // reversed depth in [0,1]
    glm::mat4 map_from_anchor{1.0f};   // texture coordinates instead of clip
    ViewPose pose;
    ViewDepths depth;
    MapPlane plane;
    ServedDistances cascade;
    ViewError error;
    std::uint32_t consumer_mask = ~0u;  // consumer_bit() of each camera that sees receivers in it
    std::uint32_t receivers = 0;        // number of visible receivers in it
    /// Stays while cameras move: its casters are all casters in its map. false, as for a sun that turns in every frame
    /// above houses: only casters that can darken receivers visible now.
    bool stays = false;
    /// Into FittedViews::casters: static casters, then dynamic ones, each by the mesh that is drawn, then by index. The
    /// drawing order matters, because at equal depths the first one drawn stays.
    IndexRange casters;
    std::uint32_t static_casters = 0;  // number of static casters
    bool lit = false;                  // no caster can darken its receivers: published, but neither drawn nor looked up
};

/// Returns the position of the light of a perspective view or cube face.
inline glm::dvec3 apex_ws_m(const ShadowView& view) {
    return view.pose.anchor_ws_m + view.pose.axis_back * view.pose.apex_m;
}

/// Returns true if the view's rays of light are parallel: a sun's, unless its view is from an eye.
inline bool is_parallel(const ShadowView& view) { return view.projection == ViewProjection::orthographic; }

/// Choices of the fits for one light.
struct FitChoice {
    ShadowRequest request;  // with the chosen filter, size and number of views
    IndexRange views;       // into FittedViews::views; empty: it has none
    LightSets sets;         // sets of the last fit of its views
    bool resized = false;   // `sets` refers to FittedViews::resized_sets instead of the culling stage's arrays
    /// Accuracy of the default filter's maps where it missed a target: another filter was chosen. 0: the default filter
    /// was chosen.
    MapAccuracy default_filter;
    std::uint32_t fits = 0;  // number of fits made for the choice (kMaxFits)
};

/// Results of the fits of all lights.
struct FittedViews {
    std::vector<FitChoice> lights;  // one per light
    std::vector<ShadowView> views;  // by light; the views of a light are consecutive
    std::vector<std::uint32_t> casters;
    /// Mesh that each caster is drawn as, of views with a ViewError::proxy_m; of others meaningless, or missing.
    std::vector<std::uint32_t> caster_meshes;
    /// Sets of cube lights that the fits gave maps of another size. They change because a face's border is a share of
    /// its map.
    ReceiverCasterSets resized_sets;

    std::span<const ShadowView> views_of(std::uint32_t light) const { return slice(views, lights[light].views); }
    std::span<const std::uint32_t> casters_of(const ShadowView& view) const { return slice(casters, view.casters); }
    std::span<const std::uint32_t> static_casters_of(const ShadowView& view) const {
        return casters_of(view).first(view.static_casters);
    }
    std::span<const std::uint32_t> moving_casters_of(const ShadowView& view) const {
        return casters_of(view).subspan(view.static_casters);
    }
    /// Returns the mesh that each caster of the view is drawn as; empty: all are drawn as they are.
    std::span<const std::uint32_t> meshes_of(const ShadowView& view) const {
        return view.error.proxy_m > 0.0 ? slice(caster_meshes, view.casters) : std::span<const std::uint32_t>();
    }
    /// Returns the light's sets, from the culling stage's `sets` or from resized_sets.
    LightSetsView sets_of(const ReceiverCasterSets& sets, std::uint32_t light) const {
        return {lights[light].resized ? resized_sets : sets, lights[light].sets};
    }
};

/// Reused storage of the fits; its contents are meaningless between two fits.
struct FitScratch {
    std::vector<glm::dvec3> points_ws;
    std::vector<glm::dvec2> points, hull, outline, profile;
    std::vector<DepthSpan> depths;
    SplitScratch split;
};

}  // namespace gnomon::shadow
