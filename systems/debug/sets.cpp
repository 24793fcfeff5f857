#include <algorithm>

#include "systems/debug/lines.h"
#include "systems/debug/words.h"

/// Debug view "sets": boxes of a light's receivers and casters.
namespace gnomon::debug {
namespace {

constexpr glm::vec3 kReceiver{0.34f, 0.71f, 0.91f}, kCaster{0.84f, 0.37f, 0.0f}, kBoth{0.94f, 0.89f, 0.26f};  // sRGB

std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> items) {
    std::vector<std::uint32_t> all(items.begin(), items.end());
    std::sort(all.begin(), all.end());
    return all;
}

bool has(const std::vector<std::uint32_t>& sorted, std::uint32_t item) {
    return std::binary_search(sorted.begin(), sorted.end(), item);
}

}  // namespace

std::optional<Drawing> draw_sets(const ViewInput& input) {
    const auto light = requested_light(input);
    if (!light) return std::nullopt;
    const shadow::ShadowFrame& frame = input.frame;
    const shadow::LightSetsView sets = frame.fitted.sets_of(frame.sets, *light);
    const std::vector<std::uint32_t> receivers = sorted(sets.receivers());
    std::vector<std::uint32_t> casters = sorted(sets.casters());
    const std::vector<std::size_t> views = requested_views(input, *light);
    if (input.request.layer)
        casters = views.empty() ? std::vector<std::uint32_t>{}
                                : sorted(frame.fitted.casters_of(frame.fitted.views[views.front()]));

    LineDrawing lines(camera_of(input));
    std::size_t both = 0;
    const auto add_box = [&](std::uint32_t item, const glm::vec3& colour) {
        lines.add(corners_of(input.scene.instances[item].bounds_ws), colour);
    };
    for (const std::uint32_t item : receivers)
        if (!has(casters, item)) add_box(item, kReceiver);
    for (const std::uint32_t item : casters) {
        const bool receives = has(receivers, item);
        both += receives ? 1 : 0;
        add_box(item, receives ? kBoth : kCaster);
    }
    Legend legend(input.area);
    const bool none = frame.statuses[*light].is_skipped();
    legend.add(input.scene.lights[*light].name + (none ? " has " + no_map(frame, *light) : ": potential sets"));
    legend.add(std::to_string(receivers.size() - both) + " receive only", kReceiver);
    legend.add(std::to_string(casters.size() - both) + " cast only", kCaster);
    legend.add(std::to_string(both) + " do both", kBoth);
    return Drawing{.lines = lines.take(), .labels = legend.take()};
}

}  // namespace gnomon::debug
