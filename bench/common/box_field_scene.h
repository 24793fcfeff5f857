#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/fit_stages.h"

/// A scene of any number of boxes for what is measured without a picture.
namespace gnomon::bench {

inline constexpr std::uint32_t kPlainMeshes = 50;

/// Boxes of about a metre, of kPlainMeshes meshes in turn, on a plain, four to a hundred square metres, with a light of
/// `kind` and a camera above them. `sight_m`: how far the camera sees; as far as the plain goes if 0.
SceneSnapshot plain(std::int64_t boxes, LightKind kind, double sight_m);

/// Returns what a fit of the only light gets after the sets are found. Refers to all four.
shadow::FitInput fit_input(const SceneSnapshot& scene, shadow::FitStages& stages, const shadow::HeldLight& held,
                           shadow::HeldLight& next);

}  // namespace gnomon::bench
