#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/maps/map_cache.h"

namespace gnomon::shadow {

/// How a frame ended.
struct FrameEnd {
    bool executed = true;      // false: the submission failed, and nobody knows what the layers hold
    bool takes_turns = false;  // a budget may have views wait: what they show is remembered
};

/// Remembers in the store what the frame drew, after it was submitted.
void commit_maps(const SceneSnapshot& scene, const DrawnViews& drawn, const FrameEnd& end, MapStore& maps);

}  // namespace gnomon::shadow
