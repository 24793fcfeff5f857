#include "systems/embed/view_group.h"

#include <algorithm>

namespace gnomon::embed {

/// Returns the group that sees the same and has views, or an idle one of these layers, or a new one.
ViewGroup& ViewGroups::group_of(const ViewLayers& wanted) {
    const ViewLayers layers = in_use_.are_alike(wanted, {}) ? ViewLayers{} : wanted;
    const auto at = std::find_if(groups_.begin(), groups_.end(), [&](const auto& group) {
        const ViewLayers& of_group = group->layered.layers();
        return of_group == layers || (!group->consumers.empty() && in_use_.are_alike(of_group, layers));
    });
    if (at != groups_.end()) return **at;
    groups_.push_back(std::make_unique<ViewGroup>(device_, jobs_, layers));
    if (shares_layers_) groups_.back()->shadows.share_layers();
    return *groups_.back();
}

void ViewGroups::arrange(const SceneSnapshot& whole, std::span<const std::uint32_t> views,
                         std::span<const ViewLayers> layers, bool keeps_idle) {
    in_use_.update(whole);
    for (const auto& group : groups_) {
        group->consumers.clear();
        group->views.clear();
    }
    for (std::size_t c = 0; c < views.size(); ++c) {
        ViewGroup& group = group_of(layers[c]);
        group.consumers.push_back(whole.consumers[c]);
        group.views.push_back(views[c]);
    }
    const ViewGroup* without_views = views.empty() ? &group_of({}) : nullptr;
    std::erase_if(groups_, [&](const auto& group) {
        const bool is_active = !group->consumers.empty() || group.get() == without_views;
        group->idle_frames = is_active ? 0 : group->idle_frames + 1;
        return group->idle_frames > (keeps_idle ? kIdleFrames : 0);
    });
    active_.clear();
    for (const auto& group : groups_)
        if (group->idle_frames == 0) active_.push_back(group.get());
    for (ViewGroup* group : active_) {
        const bool sees_all = active_.size() == 1 && group->layered.layers() == ViewLayers{};
        if (!sees_all) group->layered.update(whole, group->consumers);
        group->seen = sees_all ? &whole : &group->layered.snapshot();
    }
}

LightStatus ViewGroups::status(std::uint32_t light) const {
    LightStatus sum;
    bool is_first = true;
    for (const ViewGroup* group : active_) {
        if (light >= group->report.lights.size()) continue;
        const LightReport& report = group->report.lights[light];
        const bool shows = report.state != LightState::skipped;
        if (is_first || (sum.state == LightState::skipped && shows)) {
            sum.state = report.state;
            sum.reason = report.reason;
            sum.filter = report.filter.filter;
            sum.keeps_max_error = report.keeps_max_error;
            sum.resolved.keeps_narrowest = report.resolved.keeps_narrowest;
        }
        is_first = false;
        sum.predicted_error_px = std::max(sum.predicted_error_px, report.predicted_error_px);
        sum.keeps_max_error = sum.keeps_max_error && (report.keeps_max_error || !shows);
        sum.resolved.px = std::max(sum.resolved.px, report.resolved.px);
        sum.resolved.m = std::max(sum.resolved.m, report.resolved.m);
        sum.resolved.keeps_narrowest = sum.resolved.keeps_narrowest && (report.resolved.keeps_narrowest || !shows);
        sum.maps += report.counts.views;
        sum.maps_drawn += report.counts.views_drawn;
        sum.draws += report.counts.draws;
        sum.by_depth = std::max(sum.by_depth, report.counts.by_depth);
        sum.bytes += report.counts.bytes;
        if (report.gpu_us) sum.gpu_us = sum.gpu_us.value_or(0.0) + *report.gpu_us;
    }
    return sum;
}

}  // namespace gnomon::embed
