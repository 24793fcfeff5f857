#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "components/light_shadow.h"
#include "sample_game/support/settings/parse_number.h"

/// How the values of light_settings.cpp's table are read and written: set_… changes nothing and returns false on a text
/// that is none, get_… returns a text that set_… reads back.
namespace gnomon::game {

// Larger than any texture OpenGL devices make; the shadow system clamps to the device's own limit and reports it.
inline constexpr std::uint64_t kMaxResolution_px = 65536;
inline constexpr double kMaxError_px = 1.0e4;
inline constexpr int kMaxBias = 1000000;
inline constexpr double kSliderResolution_px = 4096.0, kSliderError_px = 16.0, kSliderBias_m = 0.2,
                        kSliderBias_texel = 8.0;

// Distances of a scene, as --set takes them: a hundred million kilometres.
inline constexpr double kMaxDistance_m = 1.0e11;
inline constexpr double kSliderDistance_m = 200.0;
inline constexpr double kDegree_rad = 0.017453292519943295;
inline constexpr double kMaxEyeAngle_deg = 160.0;  // what one perspective map can hold (kWidestMap_rad to either side)

template <class Number>
std::string number_text(Number value) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), result.ptr};
}

template <bool LightShadow::*field>
bool set_switch(LightShadow& shadow, std::string_view text) {
    if (text != "on" && text != "off") return false;
    shadow.*field = text == "on";
    return true;
}
template <bool LightShadow::*field>
std::string get_switch(const LightShadow& shadow) {
    return shadow.*field ? "on" : "off";
}

/// A distance in metres; 0 stands for a word of its own in the setting's meaning.
template <float LightShadow::*field>
bool set_distance(LightShadow& shadow, std::string_view text) {
    const auto value = read_number(text);
    if (!value || !(*value >= 0.0 && *value <= kMaxDistance_m)) return false;
    shadow.*field = static_cast<float>(*value);
    return true;
}
template <float LightShadow::*field>
std::string get_float(const LightShadow& shadow) {
    return number_text(shadow.*field);
}

/// The words of an enumeration, in its order.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kWords{};
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

template <>
inline constexpr std::array<std::string_view, 4> kWords<CasterFaces>{"automatic", "front", "back", "both"};

template <>
inline constexpr std::array<std::string_view, 8> kWords<BiasMode>{
    "automatic",      "constant",          "slope",           "normal_offset",
    "receiver_plane", "tutorial_constant", "tutorial_cosine", "tutorial_tangent"};
static_assert(kWords<BiasMode>.size() == static_cast<std::size_t>(BiasMode::count));

template <class Enum>
std::string_view word(std::size_t index) {
    return index < kWords<Enum>.size() ? kWords<Enum>[index] : std::string_view{};
}
template <auto field, class Enum>
bool set_word(LightShadow& shadow, std::string_view text) {
    const auto found = std::find(kWords<Enum>.begin(), kWords<Enum>.end(), text);
    if (found == kWords<Enum>.end()) return false;
    shadow.*field = static_cast<Enum>(found - kWords<Enum>.begin());
    return true;
}
template <auto field, class Enum>
std::string get_word(const LightShadow& shadow) {
    return std::string(word<Enum>(static_cast<std::size_t>(shadow.*field)));
}

inline bool set_resolution(LightShadow& shadow, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value > kMaxResolution_px) return false;
    shadow.resolution_px = static_cast<std::uint32_t>(*value);
    return true;
}
inline std::string get_resolution(const LightShadow& shadow) { return std::to_string(shadow.resolution_px); }

/// Of what the system chooses where nobody says it.
inline constexpr std::string_view kAutomatic = "automatic";

inline bool set_max_error(LightShadow& shadow, std::string_view text) {
    if (text == kAutomatic) shadow.max_error_px = 0.0f;
    if (text == kAutomatic) return true;
    const auto value = read_number(text);
    if (!value || !(static_cast<float>(*value) > 0.0f && *value <= kMaxError_px)) return false;
    shadow.max_error_px = static_cast<float>(*value);
    return true;
}

inline std::string get_max_error(const LightShadow& shadow) {
    return shadow.max_error_px > 0.0f ? get_float<&LightShadow::max_error_px>(shadow) : std::string(kAutomatic);
}

/// A number of 0 to kMost / kParts.
template <float LightShadow::*field, int kMost, int kParts = 1>
bool set_up_to(LightShadow& shadow, std::string_view text) {
    constexpr double kGreatest = static_cast<double>(kMost) / kParts;
    const auto value = read_number(text);
    if (!value || !(*value >= 0.0 && *value <= kGreatest)) return false;
    shadow.*field = static_cast<float>(*value);
    return true;
}

/// A mode, or metres: a constant bias of so much.
inline bool set_bias(LightShadow& shadow, std::string_view text) {
    if (set_word<&LightShadow::bias, BiasMode>(shadow, text)) return true;
    if (!set_up_to<&LightShadow::bias_m, kMaxBias>(shadow, text)) return false;
    shadow.bias = BiasMode::constant;
    return true;
}

inline bool set_eye_angle(LightShadow& shadow, std::string_view text) {
    const auto value_deg = read_number(text);
    if (!value_deg || !(*value_deg <= kMaxEyeAngle_deg)) return false;
    const auto angle_rad = static_cast<float>(*value_deg * kDegree_rad);
    if (!(angle_rad > 0.0f)) return false;
    shadow.eye_angle_rad = angle_rad;
    return true;
}
template <float LightShadow::*field_rad>
std::string get_degrees(const LightShadow& shadow) {
    // The shorter text where it reads back to the same angle.
    const double angle_deg = static_cast<double>(shadow.*field_rad) / kDegree_rad;
    const auto shorter_deg = static_cast<float>(angle_deg);
    const bool same = static_cast<float>(static_cast<double>(shorter_deg) * kDegree_rad) == shadow.*field_rad;
    return same ? number_text(shorter_deg) : number_text(angle_deg);
}

inline bool set_cascades(LightShadow& shadow, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value > kMaxCascades) return false;
    shadow.cascades = static_cast<std::uint32_t>(*value);
    return true;
}
inline std::string get_cascades(const LightShadow& shadow) { return std::to_string(shadow.cascades); }

inline bool set_layers(LightShadow& shadow, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value > kAllShadowLayers) return false;
    shadow.layers = static_cast<ShadowLayers>(*value);
    return true;
}
inline std::string get_layers(const LightShadow& shadow) { return std::to_string(shadow.layers); }

/// Rising distances with commas between; a lone 0 for none.
inline bool set_splits_m(LightShadow& shadow, std::string_view text) {
    decltype(shadow.split_m) distances_m{};
    if (text == "0") {
        shadow.split_m = distances_m;
        return true;
    }
    float last_m = 0.0f;
    for (std::size_t count = 0; count < distances_m.size(); ++count) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto value = read_number(text.substr(0, comma));
        if (!value || !(*value <= kMaxDistance_m) || !(static_cast<float>(*value) > last_m)) return false;
        last_m = distances_m[count] = static_cast<float>(*value);
        if (comma == text.size()) {
            shadow.split_m = distances_m;
            return true;
        }
        text.remove_prefix(comma + 1);
    }
    return false;
}
inline std::string get_splits_m(const LightShadow& shadow) {
    std::string text;
    for (const float distance_m : shadow.split_m) {
        if (distance_m == 0.0f) break;
        text += (text.empty() ? "" : ",") + number_text(distance_m);
    }
    return text.empty() ? "0" : text;
}

}  // namespace gnomon::game
