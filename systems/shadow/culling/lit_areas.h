#pragma once
#include <span>

#include "engine/core/jobs.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/stage_storage.h"

namespace gnomon::shadow {

/// Instances up to which a light without receivers is bounded by all that it lights. Each takes about a microsecond.
inline constexpr std::size_t kMostLitInstances = 64;

/// Corners of receivers up to which they bound a light's area. Each takes some 10 ns.
inline constexpr std::size_t kMostLitCorners = 4096;

/// Edge of the grid of lit areas, pixels. They keep their place while instances move a little, and so do the textures
/// of kept visibility.
inline constexpr double kAreaStep_px = 16.0;

/// Returns what a light can light of a picture by its range alone.
LitArea area_in_range(const LightItem& light, const ConsumerItem& camera);

/// Computes the part of a picture that holds all instances which a light lights. It is the rectangle around the light's
/// receivers, if they are all that it lights, and otherwise around the instances in its reach. Lights that are beyond
/// both limits above, and suns, have all of the picture that their range and cone reach.
/// `searched`: sets that were found for this camera, among others; null: none.
LitArea lit_area(const SceneSnapshot& scene, std::uint32_t light, const ConsumerItem& camera,
                 const ReceiverCasterSets* searched, SetScratch& scratch);

/// Computes sets.lit_areas, of each light in each camera view that draws, view by view. The other sets must have been
/// found. `jobs`: threads that share the lights; null: the calling one does all.
void find_lit_areas(const SceneSnapshot& scene, Jobs* jobs, StageStorage& storage, ReceiverCasterSets& sets);

}  // namespace gnomon::shadow
