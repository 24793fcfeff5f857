#include <array>

#include "sample_game/support/settings/setting_parsers.h"
#include "sample_game/support/settings/setting_rows.h"

namespace gnomon::game {

template <>
inline constexpr std::array<std::string_view, 3> kWords<LightProjection>{"automatic", "orthographic", "perspective"};
template <>
inline constexpr std::array<std::string_view, 4> kWords<CubeRoute>{"automatic", "six_passes", "layered_vertex",
                                                                   "layered_geometry"};
template <>
inline constexpr std::array<std::string_view, 3> kWords<DepthFormat>{"d32f", "d24", "d16"};
template <>
inline constexpr std::array<std::string_view, 3> kWords<ShadowFit>{"tight", "stable", "quantised"};
template <>
inline constexpr std::array<std::string_view, 6> kWords<CascadeSplits>{"practical", "uniform", "logarithmic",
                                                                       "manual",    "seen",    "sampled"};

namespace {

constexpr double kSliderBias_m = 0.2, kSliderBias_texel = 8.0;
constexpr int kMaxBias = 1000000;
constexpr double kMaxEyeAngle_deg = 160.0;  // what one perspective map can hold (kWidestMap_rad to either side)

using B = ShadowTuning::Bias;
template <auto field>
using Bias = Field<&LightSettings::tuning, &ShadowTuning::bias, field>;

/// Sets the mode of the bias by its name, or a constant bias, metres.
bool set_bias(LightSettings& settings, std::string_view text) {
    if (set_word<Bias<&B::mode>>(settings, text)) return true;
    if (!set_up_to<Bias<&B::offset_m>, kMaxBias>(settings, text)) return false;
    settings.tuning.bias.mode = BiasMode::constant;
    return true;
}

constexpr std::array kBiasRows{
    LightSetting{.key = "bias",
                 .field = "ShadowTuning::bias.mode",
                 .values = "automatic | constant | slope | normal_offset | receiver_plane | tutorial_constant | "
                           "tutorial_cosine | tutorial_tangent | 0 ... 1e6 (m)",
                 .meaning = "offset against self-shadowing; metres: constant",
                 .set = set_bias,
                 .get = get_word<Bias<&B::mode>>,
                 .editor = kChoice,
                 .choice = word<BiasMode>},
    LightSetting{.key = "bias_m",
                 .field = "ShadowTuning::bias.offset_m",
                 .values = "0 ... 1e6 (m)",
                 .meaning = "of constant, slope, normal_offset, receiver_plane: along the light",
                 .set = set_up_to<Bias<&B::offset_m>, kMaxBias>,
                 .get = get_float<Bias<&B::offset_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderBias_m},
    LightSetting{.key = "bias_texel",
                 .field = "ShadowTuning::bias.offset_texel",
                 .values = "0 ... 1e6 (texels)",
                 .meaning = "of slope, normal_offset, receiver_plane: times tangent or sine of the incidence",
                 .set = set_up_to<Bias<&B::offset_texel>, kMaxBias>,
                 .get = get_float<Bias<&B::offset_texel>>,
                 .editor = kNumber,
                 .slider_most = kSliderBias_texel},
};

using P = ShadowTuning::Projection;
template <auto field>
using Projection = Field<&LightSettings::tuning, &ShadowTuning::projection, field>;

bool set_eye_angle(LightSettings& settings, std::string_view text) {
    const auto value_deg = read_number(text);
    if (!value_deg || !(*value_deg <= kMaxEyeAngle_deg)) return false;
    const auto angle_rad = static_cast<float>(*value_deg * kDegree_rad);
    if (!(angle_rad > 0.0f)) return false;
    settings.tuning.projection.eye_angle_rad = angle_rad;
    return true;
}

constexpr std::array kProjectionRows{
    LightSetting{.key = "projection",
                 .field = "ShadowTuning::projection.kind",
                 .values = "automatic | orthographic | perspective",
                 .meaning = "of the map; perspective gives a sun one view from an eye",
                 .set = set_word<Projection<&P::kind>>,
                 .get = get_word<Projection<&P::kind>>,
                 .editor = kChoice,
                 .choice = word<LightProjection>},
    LightSetting{.key = "eye_distance_m",
                 .field = "ShadowTuning::projection.eye_distance_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "a sun's eye from the middle of what is seen; 0: the angle holds all that is seen",
                 .set = set_distance<Projection<&P::eye_distance_m>>,
                 .get = get_float<Projection<&P::eye_distance_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
    LightSetting{.key = "eye_angle_deg",
                 .field = "ShadowTuning::projection.eye_angle_rad",
                 .values = "above 0 ... 160 (degrees)",
                 .meaning = "full opening angle of a sun's perspective view",
                 .set = set_eye_angle,
                 .get = get_degrees<Projection<&P::eye_angle_rad>>,
                 .editor = kNumber,
                 .slider_most = kMaxEyeAngle_deg},
    LightSetting{.key = "near_m",
                 .field = "ShadowTuning::projection.near_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "depth range starts here, from the light or a sun's eye; 0: fitted",
                 .set = set_distance<Projection<&P::near_m>>,
                 .get = get_float<Projection<&P::near_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
    LightSetting{.key = "far_m",
                 .field = "ShadowTuning::projection.far_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "depth range ends here; beyond it is lit; 0: fitted",
                 .set = set_distance<Projection<&P::far_m>>,
                 .get = get_float<Projection<&P::far_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
};

using C = ShadowTuning::Cascades;
template <auto field>
using Cascades = Field<&LightSettings::tuning, &ShadowTuning::cascades, field>;

/// Sets the splits: rising distances with commas between them, metres; a lone 0 for none.
bool set_splits_m(LightSettings& settings, std::string_view text) {
    decltype(C::split_m) distances_m{};
    if (text == "0") {
        settings.tuning.cascades.split_m = distances_m;
        return true;
    }
    float last_m = 0.0f;
    for (std::size_t count = 0; count < distances_m.size(); ++count) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto value = read_number(text.substr(0, comma));
        if (!value || !(*value <= kMaxDistance_m) || !(static_cast<float>(*value) > last_m)) return false;
        last_m = distances_m[count] = static_cast<float>(*value);
        if (comma == text.size()) {
            settings.tuning.cascades.split_m = distances_m;
            return true;
        }
        text.remove_prefix(comma + 1);
    }
    return false;
}
std::string get_splits_m(const LightSettings& settings) {
    std::string text;
    for (const float distance_m : settings.tuning.cascades.split_m) {
        if (distance_m == 0.0f) break;
        text += (text.empty() ? "" : ",") + number_text(distance_m);
    }
    return text.empty() ? "0" : text;
}

constexpr std::array kCascadesRows{
    LightSetting{.key = "fit",
                 .field = "ShadowTuning::cascades.fit",
                 .values = "tight | stable | quantised",
                 .meaning = "how a sun's cascades follow the camera",
                 .set = set_word<Cascades<&C::fit>>,
                 .get = get_word<Cascades<&C::fit>>,
                 .editor = kChoice,
                 .choice = word<ShadowFit>},
    LightSetting{.key = "splits",
                 .field = "ShadowTuning::cascades.splits",
                 .values = "practical | uniform | logarithmic | manual | seen | sampled",
                 .meaning = "where a sun's cascades end along the view",
                 .set = set_word<Cascades<&C::splits>>,
                 .get = get_word<Cascades<&C::splits>>,
                 .editor = kChoice,
                 .choice = word<CascadeSplits>},
    LightSetting{.key = "split_lambda",
                 .field = "ShadowTuning::cascades.split_lambda",
                 .values = "0 ... 1",
                 .meaning = "practical, seen and sampled splits: 0 uniform, 1 logarithmic",
                 .set = set_up_to<Cascades<&C::split_lambda>, 100, 100>,
                 .get = get_float<Cascades<&C::split_lambda>>,
                 .editor = kNumber,
                 .slider_most = 1.0},
    LightSetting{.key = "split_m",
                 .field = "ShadowTuning::cascades.split_m",
                 .values = "0 | up to 7 rising distances, as 5,15,40 (m)",
                 .meaning = "manual splits: one cascade more than distances",
                 .set = set_splits_m,
                 .get = get_splits_m,
                 .editor = kText},
    LightSetting{.key = "cascade_blend",
                 .field = "ShadowTuning::cascades.blend",
                 .values = "0 ... 0.5",
                 .meaning = "share of a cascade that fades into the next one",
                 .set = set_up_to<Cascades<&C::blend>, 50, 100>,
                 .get = get_float<Cascades<&C::blend>>,
                 .editor = kNumber,
                 .slider_most = 0.5},
    LightSetting{.key = "warp",
                 .field = "ShadowTuning::cascades.warp",
                 .values = "0 ... 1",
                 .meaning = "tight fit: how far texels may grow with the distance from the camera",
                 .set = set_up_to<Cascades<&C::warp>, 100, 100>,
                 .get = get_float<Cascades<&C::warp>>,
                 .editor = kNumber,
                 .slider_most = 1.0},
};

using M = ShadowTuning::Maps;
template <auto field>
using Maps = Field<&LightSettings::tuning, &ShadowTuning::maps, field>;
constexpr std::array kMapsRows{
    LightSetting{.key = "depth_format",
                 .field = "ShadowTuning::maps.depth_format",
                 .values = "d32f | d24 | d16",
                 .meaning = "how a map stores depth: float, or fixed point in 24 or 16 bits",
                 .set = set_word<Maps<&M::depth_format>>,
                 .get = get_word<Maps<&M::depth_format>>,
                 .editor = kChoice,
                 .choice = word<DepthFormat>},
    LightSetting{.key = "cube_route",
                 .field = "ShadowTuning::maps.cube_route",
                 .values = "automatic | six_passes | layered_vertex | layered_geometry",
                 .meaning = "how a point light's faces are drawn; the maps are the same",
                 .set = set_word<Maps<&M::cube_route>>,
                 .get = get_word<Maps<&M::cube_route>>,
                 .editor = kChoice,
                 .choice = word<CubeRoute>},
    LightSetting{.key = "multi_draw",
                 .field = "ShadowTuning::maps.multi_draw",
                 .values = "on | off",
                 .meaning = "off: a command per mesh and map; the maps are the same",
                 .set = set_switch<Maps<&M::multi_draw>>,
                 .get = get_switch<Maps<&M::multi_draw>>,
                 .editor = kToggle},
    LightSetting{.key = "proxies",
                 .field = "ShadowTuning::maps.proxies",
                 .values = "on | off",
                 .meaning = "on: coarser meshes cast where that moves no edge by more than a share of a pixel",
                 .set = set_switch<Maps<&M::proxies>>,
                 .get = get_switch<Maps<&M::proxies>>,
                 .editor = kToggle},
    LightSetting{.key = "short_references",
                 .field = "ShadowTuning::maps.short_references",
                 .values = "on | off",
                 .meaning = "off: maps name triangles by two numbers a texel; shadows are the same",
                 .set = set_switch<Maps<&M::short_references>>,
                 .get = get_switch<Maps<&M::short_references>>,
                 .editor = kToggle},
};

using R = ShadowTuning::Reuse;
template <auto field>
using Reuse = Field<&LightSettings::tuning, &ShadowTuning::reuse, field>;
constexpr std::array kReuseRows{
    LightSetting{.key = "economy",
                 .field = "ShadowTuning::reuse.economy",
                 .values = "on | off",
                 .meaning = "off: redraw every map every frame, change nothing else",
                 .set = set_switch<Reuse<&R::economy>>,
                 .get = get_switch<Reuse<&R::economy>>,
                 .editor = kToggle},
    LightSetting{.key = "keep_visibility",
                 .field = "ShadowTuning::reuse.keep_visibility",
                 .values = "on | off",
                 .meaning = "what pixels see of the light is kept while nothing changes; the same to the bit",
                 .set = set_switch<Reuse<&R::keep_visibility>>,
                 .get = get_switch<Reuse<&R::keep_visibility>>,
                 .editor = kToggle},
};

}  // namespace

std::span<const LightSetting> bias_rows() { return kBiasRows; }
std::span<const LightSetting> projection_rows() { return kProjectionRows; }
std::span<const LightSetting> cascades_rows() { return kCascadesRows; }
std::span<const LightSetting> maps_rows() { return kMapsRows; }
std::span<const LightSetting> reuse_rows() { return kReuseRows; }

}  // namespace gnomon::game
