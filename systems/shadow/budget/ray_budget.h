#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"
#include "systems/shadow/request/filter_table.h"

/// How many rays lights ask, before any is counted; and what follows from that.
namespace gnomon::shadow {

/// What an exact light falls back to when others' rays use a budget up: the row that errs least without any.
inline constexpr ShadowFilter kFilteredRow = kUsualFilter;
/// The same of a source with a size.
inline constexpr ShadowFilter kFilteredSoftRow = ShadowFilter::pcss;
constexpr ShadowFilter filtered_row(ShadowFilter filter) {
    return filter == ShadowFilter::exact_soft ? kFilteredSoftRow : kFilteredRow;
}

/// Of the pixels that ask a light, so many its map is taken not to be certain of: more than in all but one of the
/// scenes of docs/exact.md.
inline constexpr double kUncertainShare = 0.2;

/// Pixels that ask the light: of its rectangles in all pictures.
double asking_pixels(const SceneSnapshot& scene, const LightItem& light);

/// Of each of those that is not certain.
double rays_per_pixel(const ShadowDemand& demand);

/// A light that asks by rays, and what its shadow means to the picture: pixels times illuminance at the camera.
struct RayAsker {
    double meaning = 0.0;
    std::uint32_t light = 0;
};

/// Has lights asked by their own filter give way to filtered_row(), with Reason::ray_budget, until the others ask for
/// no more than `most_rays` (0: any number) in a frame: those that mean least to the picture first. A light that gave
/// way comes back when there is room for a quarter more than it asks. `scratch` is overwritten.
void limit_rays(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, std::uint64_t most_rays,
                std::vector<ShadowDemand>& demands, std::vector<RayAsker>& scratch);

/// The same of all of them, with Reason::buffer_failed: the device has no room for what rays walk.
void give_rays_up(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held,
                  std::vector<ShadowDemand>& demands);

/// After the fits: counts the frames of is_quiet().
void count_quiet_frames(const SceneSnapshot& scene, const History& held, ShadowFrame& frame);

/// What drawing a light's maps of sheets would draw.
struct SheetLoad {
    double triangles = 0.0, texels = 0.0;
};

/// Whether rays for all pixels cost less than to draw that and ask for the uncertain ones.
bool are_rays_cheaper(double pixels, double rays_per_pixel, const SheetLoad& load);

}  // namespace gnomon::shadow
