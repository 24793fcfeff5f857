#include "systems/debug/shown_scale.h"
#include "systems/debug/words.h"

/// The debug view "cascades": which map of a light serves which pixel.
namespace gnomon::debug {
namespace {

std::string map_text(const shadow::ShadowView& view) {
    std::string text = map_name(view);
    if (view.seen_to_m > 0.0)
        text += ", " + length_text(view.seen_from_m) + " to " + length_text(view.seen_to_m) + " away";
    return text + ", texels up to " + length_text(view.texel_m);
}

}  // namespace

std::optional<Drawing> draw_cascades(const ViewInput& input) {
    const auto light = requested_light(input);
    if (!light) return std::nullopt;
    ShownScale scale;
    for (std::uint32_t i = 0; i < kScaleColours; ++i) scale.colours[i] = scale_colour(map_colour(i), 0.0f);
    Drawing drawing = lookup_drawing(*light, scale);
    Legend legend(input.area);
    const auto views = views_with_map(input.frame, *light);
    const std::string& name = input.scene.lights[*light].name;
    legend.add(name + (views.empty() ? " has " + no_map(input.frame, *light) : ": maps by what they serve"));
    for (const std::size_t v : views)
        legend.add(map_text(input.frame.views[v]), map_colour(input.frame.views[v].layer));
    drawing.labels = legend.take();
    return drawing;
}

}  // namespace gnomon::debug
