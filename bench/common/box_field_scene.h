#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/fit_stages.h"

/// A scene of any number of boxes for what is measured without a picture.
namespace gnomon::bench {

inline constexpr std::uint32_t kPlainMeshes = 50;

/// Makes a plain with boxes of about a metre, four to a hundred square metres, a light of `kind` and a camera above.
/// The boxes use kPlainMeshes meshes in turn. `sight_m`: range of the camera; 0: as far as the plain goes.
SceneSnapshot plain(std::int64_t boxes, LightKind kind, double sight_m);

/// Returns what a fit of the only light gets after the sets are found. Refers to all four.
shadow::FitInput fit_input(const SceneSnapshot& scene, shadow::FitStages& stages,
                           const shadow::LightFitHistory& previous, shadow::LightFitHistory& next);

}  // namespace gnomon::bench
