#include <array>

#include "systems/debug/shown_scale.h"
#include "systems/debug/words.h"

/// Debug views of a light's lookups at each pixel: "cascades", "texels", "bias" and "penumbra".
namespace gnomon::debug {
namespace {

constexpr std::size_t kStops = 7;
/// Seven samples of the colour map "turbo" (Mikhailov 2019), easy to distinguish from their neighbours.
constexpr std::array<std::array<int, 3>, kStops> kRamp{
    {{48, 18, 59}, {70, 134, 251}, {27, 229, 181}, {164, 252, 60}, {251, 185, 56}, {227, 68, 10}, {122, 4, 3}}};
using Lengths = std::array<double, kStops>;  // metres, increasing

std::string map_text(const shadow::ShadowView& view) {
    std::string text = map_name(view);
    if (view.cascade.seen_to_m > 0.0)
        text += ", from " + length_text(view.cascade.seen_from_m) + " to " + length_text(view.cascade.seen_to_m);
    return text + ", texels up to " + length_text(view.error.texel_m);
}

/// Draws a light's lookups in `scale`'s colours, with a title. `each` adds legend entries if the light has a map.
template <class Each>
std::optional<Drawing> drawing(const ViewInput& input, const char* title, ShownScale scale, const Each& each) {
    const auto light = requested_light(input);
    if (!light) return std::nullopt;
    scale.options.x = input.request.layer ? static_cast<std::int32_t>(*input.request.layer) : -1;
    Drawing drawing = lookup_drawing(*light, scale);
    Legend legend(input.area);
    const std::vector<std::size_t> views = requested_views(input, *light);
    const std::string& name = input.scene.lights[*light].name;
    legend.add(name + (views.empty() ? " has " + no_map(input.frame, *light) : std::string(": ") + title));
    if (!views.empty()) each(views, legend);
    drawing.labels = legend.take();
    return drawing;
}

std::optional<Drawing> by_map(const ViewInput& input, const char* title) {
    ShownScale scale;
    for (std::uint32_t i = 0; i < shadow::kMaxViews; ++i) scale.colours[i] = scale_colour(map_colour(i), 0.0f);
    return drawing(input, title, scale, [&](const std::vector<std::size_t>& views, Legend& legend) {
        for (const std::size_t v : views) {
            const shadow::ShadowView& view = input.frame.fitted.views[v];
            legend.add(map_text(view), map_colour(view.layer));
        }
    });
}

std::optional<Drawing> by_length(const ViewInput& input, const char* title, const Lengths& lengths_m) {
    const auto colour = [](std::size_t i) { return glm::vec3(kRamp[i][0], kRamp[i][1], kRamp[i][2]) / 255.0f; };
    ShownScale scale;
    for (std::size_t i = 0; i < kStops; ++i)
        scale.colours[i] = scale_colour(colour(i), static_cast<float>(lengths_m[i]));
    scale.options.y = static_cast<std::int32_t>(kStops);
    return drawing(input, title, scale, [&](const std::vector<std::size_t>&, Legend& legend) {
        for (std::size_t i = 0; i < kStops; ++i) {
            const char* beyond = i == 0 ? " or less" : i + 1 == kStops ? " or more" : "";
            legend.add(length_text(lengths_m[i]) + beyond, colour(i));
        }
    });
}

}  // namespace

std::optional<Drawing> draw_cascades(const ViewInput& input) { return by_map(input, "maps by what they serve"); }

std::optional<Drawing> draw_texels(const ViewInput& input) { return by_map(input, "texels of the maps"); }

std::optional<Drawing> draw_bias(const ViewInput& input) {
    return by_length(input, "how far the bias moves what is compared", {3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2});
}

std::optional<Drawing> draw_penumbra(const ViewInput& input) {
    return by_length(input, "how wide the filter blurs an edge", {3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0});
}

}  // namespace gnomon::debug
