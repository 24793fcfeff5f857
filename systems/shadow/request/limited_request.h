#pragma once
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// Returns the request with the limits applied. QualityLimits::none leaves it unchanged.
ShadowRequest granted(const LightItem& light, const ShadowRequest& wanted, const QualityLimits& grant);

/// Returns whether the limits give that request less than it needs.
bool is_less(const LightItem& light, const ShadowRequest& wanted, const QualityLimits& grant);

/// Applies each light's last limits to its request and writes the results to `limited`, one entry per light.
void apply_last_limits(const SceneSnapshot& scene, const History& previous, std::span<const ShadowRequest> requests,
                       std::vector<ShadowRequest>& limited);

}  // namespace gnomon::shadow
