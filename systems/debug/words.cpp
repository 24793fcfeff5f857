#include "systems/debug/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace gnomon::debug {
namespace {

constexpr std::array kFaceNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
constexpr std::array<std::array<int, 3>, shadow::kMaxViews> kMapColours{{{230, 159, 0},
                                                                         {86, 180, 233},
                                                                         {0, 158, 115},
                                                                         {240, 228, 66},
                                                                         {0, 114, 178},
                                                                         {213, 94, 0},
                                                                         {204, 121, 167},
                                                                         {153, 153, 153}}};

}  // namespace

glm::vec3 map_colour(std::uint32_t layer) {
    const auto& c = kMapColours[layer % kMapColours.size()];
    return glm::vec3(c[0], c[1], c[2]) / 255.0f;
}

std::string map_name(const shadow::ShadowView& view) {
    const bool face = view.projection == shadow::ViewProjection::cube_face;
    return face ? std::string("face ") + kFaceNames[view.layer % kFaceNames.size()]
                : "map " + std::to_string(view.layer);
}

std::string length_text(double length_m) {
    struct Unit {
        double from_m, per_m;
        const char* name;
    };
    constexpr Unit kUnits[] = {{1.0e3, 1.0e-3, "km"}, {1.0, 1.0, "m"}, {0.0, 1.0e3, "mm"}};
    const Unit& unit = *std::find_if(std::begin(kUnits), std::end(kUnits) - 1,
                                     [&](const Unit& u) { return std::abs(length_m) >= u.from_m; });
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g %s", length_m * unit.per_m, unit.name);
    return text.data();
}

std::optional<std::uint32_t> requested_light(const ViewInput& input) {
    const auto& lights = input.scene.lights;
    const auto light =
        std::find_if(lights.begin(), lights.end(), [&](const LightItem& l) { return l.name == input.request.light; });
    if (light == lights.end()) return std::nullopt;
    return static_cast<std::uint32_t>(light - lights.begin());
}

std::string no_map(const shadow::ShadowFrame& frame, std::uint32_t light) {
    const Reason reason = light < frame.statuses.size() ? frame.statuses[light].skipped() : Reason::none;
    return std::string("no map: ") + (reason == Reason::none ? "not this one" : reason_code(reason));
}

std::string range_text(const shadow::ShadowView& view) {
    const bool flat = shadow::is_parallel(view);
    const double near_m = flat ? 0.0 : view.depth.near_m,
                 far_m = flat ? view.depth.far_m - view.depth.near_m : view.depth.far_m;
    std::array<char, 64> range{};
    std::snprintf(range.data(), range.size(), ": %.3g ... %.3g m", near_m, far_m);
    return map_name(view) + range.data();
}

std::vector<std::size_t> requested_views(const ViewInput& input, std::uint32_t light) {
    const shadow::DrawnViews drawn = shadow::drawn_views(input.frame);
    std::vector<std::size_t> found;
    if (light >= drawn.fitted.lights.size()) return found;
    const shadow::IndexRange views = drawn.fitted.lights[light].views;
    for (std::size_t v = views.first; v < views.end(); ++v) {
        const bool wanted = !input.request.layer || *input.request.layer == drawn.view(v).layer;
        if (wanted && drawn.has_map(v)) found.push_back(v);
    }
    return found;
}

void Legend::add(std::string text, std::optional<glm::vec3> swatch) {
    labels_.push_back({next_px_, std::move(text), swatch});
    next_px_.y -= kLine_px;
}

}  // namespace gnomon::debug
