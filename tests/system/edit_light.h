#pragma once
#include <type_traits>

#include "gnomon/light.h"
#include "gnomon/registry.h"
#include "gnomon/shadow_tuning.h"

namespace gnomon {

/// Edits the component of a light that `change` takes: Light, LightShadow, or ShadowTuning, which is added where there
/// is none.
template <class Change>
void edit_light(ecs::Registry& registry, ecs::Entity light, const Change& change) {
    if constexpr (std::is_invocable_v<Change, ShadowTuning&>) {
        if (!registry.has<ShadowTuning>(light)) registry.emplace<ShadowTuning>(light);
        registry.patch<ShadowTuning>(light, change);
    } else if constexpr (std::is_invocable_v<Change, LightShadow&>) {
        registry.patch<LightShadow>(light, change);
    } else {
        registry.patch<Light>(light, change);
    }
}

}  // namespace gnomon
