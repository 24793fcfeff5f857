#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/gl/device.h"
#include "gnomon/light.h"
#include "systems/extract/sampled_depths.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/projection/light_frusta.h"

namespace gnomon::shadow {

/// Input of a fit: light, request and sets. Points are the visible receivers' corners in world space.
struct FitInput {
    const LightItem& light;
    const ShadowRequest& request;
    const SceneSnapshot& scene;
    std::span<const std::uint32_t> receivers;  // indices into scene.instances
    std::span<const std::uint32_t> casters;
    std::span<const glm::dvec3> receiver_points_ws;  // not empty
    std::span<const glm::dvec3> error_points_ws;     // ReceiverCasterSets::error_points_ws; not empty
    std::span<const ReceiverHull> hulls;             // receiver hulls; local light: one per light_frusta() item
    std::span<const glm::dvec3> frame_points_ws;     // array that ReceiverHull::receiver_points refers to
    float reach_texel = 0.5f;                        // E for borders: FilterSettings::border_texel
    const SampledDepths& sampled_depths;             // depths of an earlier picture; optional
    FitScratch& scratch;                             // reused storage: a fit allocates nothing in a steady state
    const LightFitHistory& previous;                 // history after this light's last fit
    LightFitHistory& next;                           // output; starts as a copy of `previous` (fit_history.h)

    std::span<const glm::dvec3> points_of(const ReceiverHull& receiver_hull) const {
        return frame_points_ws.subspan(receiver_hull.receiver_points.first, receiver_hull.receiver_points.count);
    }
};

/// Appends the light's views, without casters and predicted error. Returns false if no finite volume exists. Pure
/// function: equal input, history included, gives equal output. Finite input gives finite matrices.
using FitFunction = bool (*)(const FitInput& input, std::vector<ShadowView>& views);

struct LightKindRow {
    LightKind kind;
    std::string_view name;    // as in --stats
    std::string_view define;  // for the shaders
    std::string_view file;    // below shaders/
    gl::TextureKind texture;
    std::uint32_t layers;  // default number of the map's layers
    FitFunction fit;
    FrustaFunction frusta;  // light frusta of a lamp, one per view; nullptr: rays are parallel
};

/// Lookup of an aimed point light and of a sun with an eye: the same as a spot's.
inline constexpr std::string_view kPerspectiveFile = "shadow/lookup/kinds/spot.glsl";
/// Lookup of a sun with warped maps.
inline constexpr std::string_view kWarpedSunFile = "shadow/lookup/kinds/directional_lispsm.glsl";

/// Returns all rows in the order of LightKind. A new kind needs systems/shadow/fitting/local/fit_x.cpp,
/// shaders/shadow/lookup/kinds/x.glsl and a row.
std::span<const LightKindRow> light_kind_table();
const LightKindRow& light_kind_row(LightKind kind);

/// Returns the light frusta of a light: its kind's, or the one of an aimed lamp (far_lamp_aim.h). A sun has none.
LightFrusta light_frusta(const LightItem& light, const ShadowRequest& request);

/// Returns the texture kind of the light's map: flat for an aimed lamp, else its kind's.
gl::TextureKind map_texture(const LightItem& light, const ShadowRequest& request);

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views);
/// Fits one view from the sun's eye (projection/sun_viewpoint.h).
bool fit_perspective_sun(const FitInput& input, const glm::dmat3& basis, std::vector<ShadowView>& views);
bool fit_spot(const FitInput& input, std::vector<ShadowView>& views);
bool fit_point(const FitInput& input, std::vector<ShadowView>& views);

}  // namespace gnomon::shadow
