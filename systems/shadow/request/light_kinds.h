#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "components/light.h"
#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/projection/light_frusta.h"

namespace gnomon::shadow {

/// What a kind's fit sees: its light, its request, its sets. Points are the visible receivers' corners, world space.
struct FitInput {
    const LightItem& light;
    const ShadowRequest& request;
    const SceneSnapshot& scene;
    std::span<const std::uint32_t> receivers;  // indices into scene.instances
    std::span<const std::uint32_t> casters;
    std::span<const glm::dvec3> receiver_points_ws;  // not empty
    std::span<const Beam> beams;                     // of a local light: one for each of light_openings()
    std::span<const glm::dvec3> frame_points_ws;     // what Beam::receiver_points is a range of
    float reach_texel = 0.5f;                        // the filter's E, for borders: FilterSettings::border_texel
    FitScratch& scratch;                             // so that a fit allocates nothing in steady state
    const HeldLight& held;                           // what this light's last fit left
    HeldLight& next;                                 // output, starts as a copy of `held`: see fit_history.h

    std::span<const glm::dvec3> points_of(const Beam& beam) const {
        return frame_points_ws.subspan(beam.receiver_points.first, beam.receiver_points.count);
    }
};

/// Appends the light's views (without casters and predicted error). False if no finite volume exists.
/// Pure: same input, history included, same output; any finite input gives finite matrices.
using FitFunction = bool (*)(const FitInput& input, std::vector<ShadowView>& views);

struct LightKindRow {
    LightKind kind;
    std::string_view name;    // as in --stats
    std::string_view define;  // for the shaders
    std::string_view file;    // under shaders/
    gl::TextureKind texture;
    std::uint32_t layers;  // of the map
    FitFunction fit;
    FrustaFunction frusta;  // light frusta of a lamp, one per view; nullptr: rays are parallel
};

/// A sun seen from an eye is looked up as a spot is, and so is an aimed point light.
inline constexpr std::string_view kPerspectiveFile = "shadow/lookup/kinds/spot.glsl";
/// A sun whose maps are warped.
inline constexpr std::string_view kWarpedSunFile = "shadow/lookup/kinds/directional_lispsm.glsl";

/// In the order of LightKind. To add a kind: systems/shadow/fitting/local/fit_x.cpp,
/// shaders/shadow/lookup/kinds/x.glsl, a row here.
std::span<const LightKindRow> light_kind_table();
const LightKindRow& light_kind_row(LightKind kind);

/// Returns the light frusta of a light: of its kind, or the one of an aimed lamp (far_lamp_aim.h); none of a sun.
LightOpenings light_openings(const LightItem& light, const ShadowRequest& request);

/// Of the light's map: an aimed lamp has a flat one.
gl::TextureKind map_texture(const LightItem& light, const ShadowRequest& request);

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views);
/// One view from the sun's eye (projection/sun_viewpoint.h).
bool fit_perspective_sun(const FitInput& input, const glm::dmat3& basis, std::vector<ShadowView>& views);
bool fit_spot(const FitInput& input, std::vector<ShadowView>& views);
bool fit_point(const FitInput& input, std::vector<ShadowView>& views);

}  // namespace gnomon::shadow
