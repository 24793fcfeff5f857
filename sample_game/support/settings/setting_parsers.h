#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "sample_game/support/settings/light_settings.h"
#include "sample_game/support/settings/parse_number.h"

/// Reading and writing of the values in the table of settings. set_… returns false and changes nothing if the text is
/// no value. get_… returns a text that set_… reads back.
namespace gnomon::game {

// Distances of a scene, as --set takes them: a hundred million kilometres.
inline constexpr double kMaxDistance_m = 1.0e11;
inline constexpr double kSliderDistance_m = 200.0;
inline constexpr double kDegree_rad = 0.017453292519943295;

/// Word for a value that the system chooses.
inline constexpr std::string_view kAutomatic = "automatic";

/// A field of LightSettings, by the members that lead to it.
template <auto... path>
struct Field {
    template <class Settings>
    static auto& of(Settings& settings) {
        return (settings.*....*path);
    }
    using Value = std::remove_reference_t<decltype(of(std::declval<LightSettings&>()))>;
};

template <class Number>
std::string number_text(Number value) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), result.ptr};
}

template <class F>
bool set_switch(LightSettings& settings, std::string_view text) {
    if (text != "on" && text != "off") return false;
    F::of(settings) = text == "on";
    return true;
}
template <class F>
std::string get_switch(const LightSettings& settings) {
    return F::of(settings) ? "on" : "off";
}

/// Sets a whole number of kLeast to kMost, in steps.
template <class F, std::uint32_t kLeast, std::uint32_t kMost, std::uint32_t kStep = 1>
bool set_count(LightSettings& settings, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value < kLeast || *value > kMost || (*value - kLeast) % kStep != 0) return false;
    F::of(settings) = static_cast<typename F::Value>(*value);
    return true;
}
template <class F>
std::string get_count(const LightSettings& settings) {
    return std::to_string(F::of(settings));
}

/// Sets a distance, 0 to kMaxDistance_m, metres. LightSetting::meaning explains 0.
template <class F>
bool set_distance(LightSettings& settings, std::string_view text) {
    const auto value = read_number(text);
    if (!value || !(*value >= 0.0 && *value <= kMaxDistance_m)) return false;
    F::of(settings) = static_cast<float>(*value);
    return true;
}
/// Sets a number of 0 to kMost / kParts.
template <class F, int kMost, int kParts = 1>
bool set_up_to(LightSettings& settings, std::string_view text) {
    constexpr double kGreatest = static_cast<double>(kMost) / kParts;
    const auto value = read_number(text);
    if (!value || !(*value >= 0.0 && *value <= kGreatest)) return false;
    F::of(settings) = static_cast<float>(*value);
    return true;
}
template <class F>
std::string get_float(const LightSettings& settings) {
    return number_text(F::of(settings));
}

template <class F>
std::string get_degrees(const LightSettings& settings) {
    const float field_rad = F::of(settings);
    // The shorter text where it reads back to the same angle.
    const double angle_deg = static_cast<double>(field_rad) / kDegree_rad;
    const auto shorter_deg = static_cast<float>(angle_deg);
    const bool same = static_cast<float>(static_cast<double>(shorter_deg) * kDegree_rad) == field_rad;
    return same ? number_text(shorter_deg) : number_text(angle_deg);
}

/// The words of an enumeration, in its order.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kWords{};
template <>
inline constexpr std::array<std::string_view, 8> kWords<BiasMode>{
    "automatic",      "constant",          "slope",           "normal_offset",
    "receiver_plane", "tutorial_constant", "tutorial_cosine", "tutorial_tangent"};
static_assert(kWords<BiasMode>.size() == static_cast<std::size_t>(BiasMode::count));

template <class Enum>
std::string_view word(std::size_t index) {
    return index < kWords<Enum>.size() ? kWords<Enum>[index] : std::string_view{};
}
template <class F>
bool set_word(LightSettings& settings, std::string_view text) {
    using Enum = typename F::Value;
    const auto found = std::find(kWords<Enum>.begin(), kWords<Enum>.end(), text);
    if (found == kWords<Enum>.end()) return false;
    F::of(settings) = static_cast<Enum>(found - kWords<Enum>.begin());
    return true;
}
template <class F>
std::string get_word(const LightSettings& settings) {
    return std::string(word<typename F::Value>(static_cast<std::size_t>(F::of(settings))));
}

}  // namespace gnomon::game
