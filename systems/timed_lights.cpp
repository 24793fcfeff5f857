#include "systems/timed_lights.h"

#include <algorithm>

#include "systems/frame_timers.h"

namespace gnomon {
namespace {

/// Finds a light in the report. `guess`: its probable index.
LightReport* find_light(FrameReport& report, ecs::Entity light, std::size_t guess) {
    if (guess < report.lights.size() && report.lights[guess].entity == light) return &report.lights[guess];
    const auto at = std::find_if(report.lights.begin(), report.lights.end(),
                                 [&](const LightReport& l) { return l.entity == light; });
    return at != report.lights.end() ? &*at : nullptr;
}

}  // namespace

void TimedLights::submitted(std::uint64_t submission, const FrameReport& report) {
    Submission& now = submissions_[next_];
    next_ = (next_ + 1) % kFrames;
    now.known = true;
    now.number = submission;
    now.lights.clear();
    for (Submission& s : submissions_)
        s.lights.reserve(report.lights.size());  // at once, so that later frames do not allocate
    for (const LightReport& light : report.lights) now.lights.push_back(light.entity);
}

const TimedLights::Submission* TimedLights::find(std::uint64_t number) const {
    const auto at = std::find_if(submissions_.begin(), submissions_.end(),
                                 [&](const Submission& s) { return s.known && s.number == number; });
    return at != submissions_.end() ? &*at : nullptr;
}

void TimedLights::tell(std::span<const gl::Timing> timings, FrameReport& report) const {
    const Submission* newest = nullptr;
    for (const gl::Timing& t : timings)
        if (const Submission* of = find(t.submission); of && (!newest || of->number > newest->number)) newest = of;
    if (!newest) return;
    double all_us = 0.0, shadow_us = 0.0;
    for (const gl::Timing& t : timings) {
        if (t.submission != newest->number) continue;
        all_us += t.gpu_us;
        if (t.id >= kSurfaceTimer) continue;
        const std::uint32_t index = t.id / 2;
        if (t.id == shadow_timer(index)) shadow_us += t.gpu_us;
        LightReport* const light =
            index < newest->lights.size() ? find_light(report, newest->lights[index], index) : nullptr;
        if (light) light->gpu_us = light->gpu_us.value_or(0.0) + t.gpu_us;
    }
    report.gpu_us = all_us;
    report.shadow_gpu_us = shadow_us;
}

}  // namespace gnomon
