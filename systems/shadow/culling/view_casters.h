#pragma once
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// What the casters of one view follow from, beside the scene.
struct CasterInputs {
    LightSetsView sets;  // of the view's light
    const FilterSettings& filter;
    std::span<const std::uint64_t> moving;  // as CasterMotion::moving(); empty: nothing moves
};

/// Appends the casters of one fitted view to `casters`: those that can darken what is seen in it, the filter's width
/// included; of a held view all that its map can show. Moving ones come last, each by mesh, then by index. Sets
/// view.casters and view.still_casters. No other place decides in which order casters are drawn.
void select_view_casters(const SceneSnapshot& scene, const CasterInputs& inputs, ShadowView& view, SetScratch& scratch,
                         std::vector<std::uint32_t>& casters);

}  // namespace gnomon::shadow
