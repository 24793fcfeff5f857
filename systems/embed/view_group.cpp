#include "systems/embed/view_group.h"

#include <algorithm>

namespace gnomon::embed {

ViewGroups::ViewGroups(gl::Device& device, bool shares_layers) : device_(device), shares_layers_(shares_layers) {
    active_.push_back(&group_of({}));
}

/// Returns the active group that sees the same, or an idle one, or a new one.
ViewGroup& ViewGroups::group_of(const ViewLayers& layers) {
    const auto alike = [&](const auto& group) { return in_use_.are_alike(group->layered.layers(), layers); };
    if (!groups_.empty() && alike(groups_.front())) return *groups_.front();
    const auto at = std::find_if(groups_.begin(), groups_.end(), [&](const auto& group) {
        return !group->consumers.empty() ? alike(group) : group->layered.layers() == layers;
    });
    if (at != groups_.end()) return **at;
    groups_.push_back(std::make_unique<ViewGroup>(device_, layers));
    if (shares_layers_) groups_.back()->shadows.share_layers();
    return *groups_.back();
}

void ViewGroups::arrange(const SceneSnapshot& whole, std::span<const std::uint32_t> views,
                         std::span<const ViewLayers> layers) {
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
    active_.clear();
    for (const auto& group : groups_)
        if (!group->consumers.empty()) active_.push_back(group.get());
    if (active_.empty()) active_.push_back(groups_.front().get());
    for (ViewGroup* group : active_) {
        const bool sees_all = active_.size() == 1 && group == groups_.front().get();
        if (!sees_all) group->layered.update(whole, group->consumers);
        group->seen = sees_all ? &whole : &group->layered.snapshot();
    }
    for (const auto& group : groups_) group->idle_frames = group->consumers.empty() ? group->idle_frames + 1 : 0;
    std::erase_if(groups_,
                  [&](const auto& group) { return group != groups_.front() && group->idle_frames > kIdleFrames; });
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
        }
        is_first = false;
        sum.predicted_error_px = std::max(sum.predicted_error_px, report.predicted_error_px);
        sum.keeps_max_error = sum.keeps_max_error && (report.keeps_max_error || !shows);
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
