#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/exact/error_margins.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

inline glm::dvec3 row(const glm::mat4& m, int r) { return {m[0][r], m[1][r], m[2][r]}; }

inline glm::dvec3 absolute(const glm::dmat3& m, const glm::dvec3& v) {
    return glm::abs(m[0]) * v.x + glm::abs(m[1]) * v.y + glm::abs(m[2]) * v.z;
}

/// Bound on float's error of any vertex of an instance in clip space. It covers what bounds_item.glsl computes.
class ClipRounding {
public:
    ClipRounding(const CasterTopology& surface, const InstanceItem& item, const ShadowView& view)
        : clip_from_anchor_(view.clip_from_anchor) {
        const glm::dvec3 local = absolute(item.basis, surface.reach_ms);
        const glm::dvec3 reach = local + glm::abs(item.translation_ws_m - view.pose.anchor_ws_m);
        const double split = kSplitUnits * (glm::length(item.translation_ws_m) + glm::length(view.pose.anchor_ws_m));
        error_ = (kPlacedUnits + kProjectedUnits) * kUnitRoundoff * reach + split;
    }
    double of_row(int r) const {
        return glm::dot(glm::abs(row(clip_from_anchor_, r)), error_) +
               kProjectedUnits * kUnitRoundoff * std::abs(static_cast<double>(clip_from_anchor_[3][r]));
    }
    double length_m() const { return glm::length(error_); }

private:
    glm::mat4 clip_from_anchor_;
    glm::dvec3 error_{0.0};
};

}  // namespace gnomon::shadow
