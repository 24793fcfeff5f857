#include "sample_game/app/write_outputs.h"

namespace gnomon::game {
namespace {

constexpr std::uint32_t kSettlingRuns = 120;  // until nothing of shadows changes, which takes two seconds at most

/// Freezes the last frame, compares it with its ray-traced truth, and adds the result to `stats`.
std::optional<Error> judge(const CommandLine& line, GameWorld& world, Frame& frame, glm::uvec2 size_px,
                           FrozenFrame& frozen, StatsFile& stats) {
    frozen.freeze(world.registry, world.library, size_px, trace_threads() + 1);  // nothing is drawn meanwhile
    frozen.finish(frame);
    if (!frozen.on()) return Error{.message = "--truth: no camera sees anything", .rule = "output.truth"};
    for (std::size_t i = 0; i < frozen.lights().size(); ++i) {
        const JudgedLight& light = frozen.lights()[i];
        if (!light.judged())
            return Error{.message = "the device could not draw the visibility of " + light.name,
                         .rule = "output.visibility"};
        if (line.truth_light == light.name) frozen.choose(i);
    }
    stats.set_truth(truth_stats(frozen));
    return std::nullopt;
}

}  // namespace

bool finish_samples(GameWorld& world, Frame& frame, const FrameSettings& settings,
                    const std::function<void(const FrameReport&)>& after_frame) {
    const std::uint32_t most_runs = settings.still_samples > 1 ? settings.still_samples + kSettlingRuns : 0;
    for (std::uint32_t i = 0; i < most_runs && frame.report().samples < settings.still_samples; ++i) {
        frame.run(world.registry, settings);
        after_frame(frame.report());
    }
    return frame.report().samples >= settings.still_samples;
}

std::optional<Error> write_last_frame(const CommandLine& line, GameWorld& world, Frame& frame,
                                      const FrameSettings& settings, Gui* gui, StatsFile& stats) {
    if (line.screenshot)
        if (auto error = write_picture(*line.screenshot, frame, line.transparent)) return error;
    FrameSettings middle = settings;  // what is judged and written per pixel is that of its middle
    middle.still_samples = 1;
    if (settings.still_samples > 1 && (line.truth || line.visibility)) frame.run(world.registry, middle);
    if (line.truth)
        if (auto error = judge(line, world, frame, settings.viewport_px, gui->frozen, stats)) return error;
    if (auto error = write_outputs(line, world, frame, settings.viewport_px, stats)) return error;
    if (!line.truth) return std::nullopt;
    frame.run(world.registry, middle);  // again, for a picture that nothing was drawn over
    gui->draw(world, frame, settings.viewport_px, nullptr, kStep_s);
    return write_picture(*line.truth, frame, line.transparent);
}

}  // namespace gnomon::game
