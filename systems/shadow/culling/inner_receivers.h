#pragma once
#include <cstdint>
#include <span>

#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/split_scratch.h"

namespace gnomon::shadow {

/// Receivers within a volume. Fits derive convex hulls of their corners, and maxima of ratios of linear functions. What
/// lies within the hull of others adds nothing to either, so that only the others have to be clipped.
struct SplitReceivers {
    std::span<const std::uint32_t> inner;      // wholly within the volume and within the hull of `corners`; in no order
    std::span<const std::uint32_t> others;     // rising
    std::span<const glm::dvec3> corners_ws_m;  // corners of receivers that lie wholly within the volume's core
};

/// Volume inside of all planes and of a box.
struct ReceiverVolume {
    std::span<const math::Plane> planes;
    const math::Aabb& limit = math::kEverywhere;
    /// Planes around its core, which together with `planes` contains the corners. A cube's face has its own part as its
    /// core: its errors are those of receivers there, without the border that its neighbours share.
    std::span<const math::Plane> core = {};
};

/// Number of receivers up to which none is inner: clipping them takes less than finding out.
inline constexpr std::size_t kFewReceivers = 1024;

/// Splits `receivers`, rising indices into scene.instances. With few receivers, or while scene.tree does not fit the
/// scene, all of them are others.
SplitReceivers split_receivers(const SceneSnapshot& scene, std::span<const std::uint32_t> receivers,
                               const ReceiverVolume& volume, SplitScratch& scratch);

}  // namespace gnomon::shadow
