#include "systems/shadow/report/draw_times.h"

#include <algorithm>

#include "systems/frame_timers.h"

namespace gnomon::shadow {

void DrawTimes::submitted(std::uint64_t submission, const SceneSnapshot& scene, const FrameReport& report) {
    ++frame_;
    std::erase_if(drawn_, [&](const Drawn& d) { return d.frame + kFrames <= frame_; });
    const std::size_t lights = std::min(scene.lights.size(), report.lights.size());
    drawn_.reserve(kFrames * lights);  // at once: later frames allocate nothing
    for (std::uint32_t i = 0; i < lights; ++i)
        if (report.lights[i].counts.views_drawn > 0)
            drawn_.push_back({frame_, submission, i, report.lights[i].counts.views_drawn, scene.lights[i].entity});
}

void DrawTimes::learn(std::span<const gl::Timing> timings) {
    for (const gl::Timing& timing : timings) {
        const auto drawn = std::find_if(drawn_.begin(), drawn_.end(), [&](const Drawn& d) {
            return d.submission == timing.submission && shadow_timer(d.light) == timing.id;
        });
        if (drawn == drawn_.end()) continue;
        drawn->us += timing.gpu_us;  // a light may have a timer per view
        if (drawn->entity.index >= measured_.size()) measured_.resize(drawn->entity.index + std::size_t{1});
        measured_[drawn->entity.index] = {drawn->entity, drawn->us / drawn->views};
    }
}

std::optional<double> DrawTimes::view_us(ecs::Entity light) const {
    if (light.index >= measured_.size() || measured_[light.index].entity != light) return std::nullopt;
    return measured_[light.index].view_us;
}

}  // namespace gnomon::shadow
