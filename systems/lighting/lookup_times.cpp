#include "systems/lighting/lookup_times.h"

#include <algorithm>

#include "systems/frame_timers.h"

namespace gnomon::lighting {

void LookupTimes::submitted(std::uint64_t submission) {
    ++frame_;
    std::erase_if(passes_, [&](const Pass& p) { return p.frame + kFrames <= frame_; });
    passes_.reserve(kFrames * recorded_.size());  // at once, so that later frames do not allocate
    for (Pass& pass : recorded_) {
        pass.frame = frame_;
        pass.submission = submission;
        passes_.push_back(pass);
    }
    recorded_.clear();
}

void LookupTimes::learn(std::span<const gl::Timing> timings) {
    for (const gl::Timing& timing : timings) {
        const auto pass = std::find_if(passes_.begin(), passes_.end(), [&](const Pass& p) {
            return p.submission == timing.submission && lighting_timer(p.index) == timing.id;
        });
        if (pass == passes_.end()) continue;
        pass->us += timing.gpu_us;  // a submission may have several pictures
        if (pass->light.index >= measured_.size()) measured_.resize(pass->light.index + std::size_t{1});
        Measured& light = measured_[pass->light.index];
        if (light.light != pass->light) light = {pass->light, {}, {}};
        (pass->kept ? light.kept_us : light.looked_up_us) = pass->us;
    }
}

std::optional<double> LookupTimes::saved_us(ecs::Entity light) const {
    if (light.index >= measured_.size()) return std::nullopt;
    const Measured& m = measured_[light.index];
    if (m.light != light || !m.looked_up_us || !m.kept_us) return std::nullopt;
    return std::max(*m.looked_up_us - *m.kept_us, 0.0);
}

}  // namespace gnomon::lighting
