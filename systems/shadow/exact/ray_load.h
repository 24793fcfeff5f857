#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

/// How many rays lights ask, before any is counted; and what follows from that.
namespace gnomon::shadow {

/// What an exact light falls back to when others' rays use a budget up: the row that errs least without any.
inline constexpr ShadowFilter kFilteredRow = ShadowFilter::triangles;

/// Of the pixels that ask a light, so many its map is taken not to be certain of: more than in all but one of the
/// scenes of docs/exact.md.
inline constexpr double kUncertainShare = 0.2;

/// Pixels that ask the light: of its rectangles in all pictures.
double asking_pixels(const SceneSnapshot& scene, const LightItem& light);

/// Has lights asked by their own filter give way to kFilteredRow, with Reason::ray_budget, until the others ask for no
/// more than `most_rays` (0: any number) in a frame: those that mean least to the picture first. A light that gave way
/// comes back when there is room for a quarter more than it asks. `scratch` is overwritten.
void limit_rays(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, std::uint64_t most_rays,
                std::vector<ShadowDemand>& demands, std::vector<std::uint32_t>& scratch);

/// What drawing a light's maps of sheets would draw.
struct SheetLoad {
    double triangles = 0.0, texels = 0.0;
};

/// Whether rays for all pixels cost less than to draw that and ask for the uncertain ones.
bool are_rays_cheaper(double pixels, const SheetLoad& load);

}  // namespace gnomon::shadow
