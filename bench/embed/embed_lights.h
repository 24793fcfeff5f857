#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/math/aabb.h"
#include "gnomon/light.h"
#include "gnomon/shadows.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/extract/snapshot.h"

namespace gnomon::bench {

/// Lights of one kind and filter that are measured together.
struct EmbedCase {
    LightKind kind = LightKind::spot;
    const char* kind_name = "";
    ShadowFilter filter = ShadowFilter::automatic;
    bool LookupOptions::*part = nullptr;  // in a lookup's text, for that kind
    game::LightSettings settings = {};    // filter aside
    std::string name() const;
};

/// Lists all of them. `quick`: a grid of taps for spots alone.
std::vector<EmbedCase> embed_cases(bool quick);
/// Returns a filter's name in the table; "default" for automatic.
std::string filter_name(ShadowFilter filter);

/// Light where it is in some frame.
struct PlacedLight {
    Light light;
    LightShadow shadow;
    ShadowTuning tuning;
    glm::dvec3 position_m{0.0}, direction{0.0, -1.0, 0.0};
};

math::Aabb bounds_of(const SceneSnapshot& scene);

/// Returns light i of eight: on a ring in the box, aimed at the middle of its floor. `turn`: steps that it has moved.
PlacedLight placed_light(const EmbedCase& of, std::uint32_t i, std::uint32_t turn, const math::Aabb& bounds);

}  // namespace gnomon::bench
