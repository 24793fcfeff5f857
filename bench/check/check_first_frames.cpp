#include "bench/check/check_first_frames.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace gnomon::bench {
namespace {

using Visibilities = std::vector<std::vector<float>>;  // a light's, by pixel

FailedFrame failed(const char* what) { return FailedFrame({what, {}, {}, "bench.frame"}); }

Visibilities first_frame(Stage& stage) {
    auto made = FrameSystem::create(stage.device(), stage.library());
    if (!made) throw FailedFrame(made.error());
    FrameSystem& frame = *made.value();
    frame.run(stage.world(), stage.settings());
    if (frame.report().failure != gl::Failure::none) throw failed("a first frame failed");
    Visibilities shown(frame.snapshot().lights.size());
    for (std::uint32_t light = 0; light < shown.size(); ++light)
        if (!frame.read_visibility(light, shown[light])) throw failed("a first frame's visibility cannot be read");
    return shown;
}

std::uint32_t pixels_apart(const Visibilities& a, const Visibilities& b) {
    std::uint32_t apart = 0;
    for (std::size_t light = 0; light < a.size(); ++light)
        for (std::size_t i = 0; i < a[light].size(); ++i) apart += a[light][i] != b[light][i] ? 1 : 0;
    return apart;
}

}  // namespace

FirstFrames check_first_frames(Stage& stage, std::uint32_t count, const CheckProgress& progress) {
    const auto start = std::chrono::steady_clock::now();
    FirstFrames frames;
    Visibilities first;
    for (; frames.drawn < count; ++frames.drawn) {
        progress("first frames", frames.drawn, count);
        Visibilities shown = first_frame(stage);
        if (frames.drawn == 0) {
            first = std::move(shown);
            for (const std::vector<float>& light : first)
                frames.dark_px += static_cast<std::uint32_t>(std::count(light.begin(), light.end(), 0.0f));
            continue;
        }
        const std::uint32_t apart = pixels_apart(first, shown);
        frames.differ += apart > 0 ? 1 : 0;
        frames.most_px = std::max(frames.most_px, apart);
    }
    frames.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return frames;
}

}  // namespace gnomon::bench
