#pragma once
#include <optional>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Inputs for the casters of one view, beside the scene.
struct CasterInputs {
    LightSetsView sets;  // sets of the view's light
    const FilterSettings& filter;
    std::span<const std::uint64_t> moving;  // result of DynamicCasters::moving(); empty: all are static
    /// Receivers of a sun that a camera may see (receiver_mask.h), for views that do not stay; none: not searched.
    std::optional<std::span<const std::uint32_t>> seen = {};
};

/// Appends the casters of one fitted view to `casters`. These can darken its visible receivers, the filter's width
/// included. For a view that stays in place (`stays`) they are all casters in its map. Dynamic casters come last, each
/// group by mesh, then by index. Only this function decides the drawing order. Sets view.casters and
/// view.static_casters. Call after select_sets() for the same scene and `scratch`.
void select_view_casters(const SceneSnapshot& scene, const CasterInputs& inputs, ShadowView& view, SetScratch& scratch,
                         std::vector<std::uint32_t>& casters);

}  // namespace gnomon::shadow
