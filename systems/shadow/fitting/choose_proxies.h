#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

/// Coarser meshes that are drawn in place of casters.
///
/// Every point of a proxy lies within its bound of the caster's surface, and the other way round. Across the light, an
/// edge of its shadow is off by the bound at most. From a lamp it is off by the bound times the receiver's distance,
/// over the caster's. A lookup moves the receiver along its normal by as much, so that no surface darkens itself by its
/// own proxy. That moves edges as far again. A proxy is drawn where the sum stays below the allowed pixels.
namespace gnomon::shadow {

/// Caster as it is drawn.
using DrawnCaster = std::pair<std::uint32_t, std::uint32_t>;  // mesh that is drawn, instance

/// Returns how far off an edge may be because of proxies, on receivers within 60 degrees of the light, pixels.
double allowed_proxy_px(const LightShadow& shadow);

/// Returns the widest bound of casters with shadows at some distance from the camera, per metre of that distance. For
/// an orthographic camera it is the bound itself, metres.
double proxy_bound_of(const ConsumerItem& consumer, double allowed_px);

/// Chooses the mesh that each caster of the view is drawn as: the coarsest proxy that keeps edges within what is
/// allowed. Puts the view's static casters, and its moving ones, in the order of these meshes. Sets
/// view.error.proxy_m and the casters' entries of out.caster_meshes, and adds what edges may move to view.error. The
/// choice changes in steps as cameras move, since a change draws the map again. Does nothing to views with
/// another filter, or tuning, than may take proxies.
void choose_proxies(const SceneSnapshot& scene, const MapSettings& map, ShadowView& view,
                    std::vector<DrawnCaster>& scratch, FittedViews& out);

}  // namespace gnomon::shadow
