#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/maps/map_cache.h"

namespace gnomon::shadow {

/// Outcome of a frame.
struct FrameEnd {
    bool executed = true;      // false: the submission failed, so that the layers' content is unknown
    bool takes_turns = false;  // a budget may defer views, so that the casters they show are recorded
};

/// Records in the map cache what the frame drew. Call it after the frame was submitted.
void commit_maps(const SceneSnapshot& scene, const DrawnViews& drawn, const FrameEnd& end, MapCache& maps);

}  // namespace gnomon::shadow
