#include "sample_game/support/settings/setting_uses.h"

#include <algorithm>
#include <array>

#include "sample_game/inside/filter_figures.h"

namespace gnomon::game {
namespace {

using Settings = const LightSettings&;

FilterFigures row_of(Settings s, LightKind kind) { return figures_of(filter_of(s.shadow.filter, kind)); }
bool is_among(std::span<const ShadowFilter> filters, ShadowFilter filter) {
    return std::find(filters.begin(), filters.end(), filter) != filters.end();
}

bool for_area_shares(Settings s, LightKind kind) { return row_of(s, kind).antialiases; }

bool for_sun(Settings, LightKind kind) { return is_sun(kind); }
bool for_point(Settings, LightKind kind) { return is_point(kind); }

bool for_source(Settings s, LightKind kind) { return row_of(s, kind).extent == FilterExtent::source; }
bool for_width(Settings, LightKind kind) { return has_width(kind); }
bool for_height(Settings, LightKind kind) { return has_height(kind); }
bool for_lamp_source(Settings s, LightKind kind) {
    return has_radius(kind) || (for_source(s, kind) && !for_sun(s, kind) && !has_height(kind));
}
bool for_sun_source(Settings s, LightKind kind) { return for_source(s, kind) && for_sun(s, kind); }

bool for_size(Settings s, LightKind kind) { return row_of(s, kind).extent == FilterExtent::size; }
bool for_spread(Settings s, LightKind kind) { return row_of(s, kind).extent == FilterExtent::spread; }
bool for_spread_texel(Settings s, LightKind kind) { return for_spread(s, kind) && !(s.tuning.kernel.spread_m > 0.0f); }
bool for_taps(Settings s, LightKind kind) {
    static constexpr std::array kWithTaps{ShadowFilter::poisson, ShadowFilter::poisson_rotated,
                                          ShadowFilter::poisson_stratified, ShadowFilter::pcss};
    return is_among(kWithTaps, filter_of(s.shadow.filter, kind));
}
bool for_seed(Settings s, LightKind kind) { return row_of(s, kind).random; }
bool for_cells(Settings s, LightKind kind) { return for_seed(s, kind) && s.tuning.kernel.seed == FilterSeed::world; }
bool for_many_taps(Settings s, LightKind kind) {
    return (for_size(s, kind) || for_spread(s, kind)) && !row_of(s, kind).prefiltered;
}
bool for_source_rays(Settings s, LightKind kind) { return row_of(s, kind).rays == FilterRays::to_source; }

bool for_moments(Settings s, LightKind kind) { return row_of(s, kind).prefiltered; }
bool for_exponent(Settings s, LightKind kind) { return row_of(s, kind).has_exponent; }
bool for_second_warp(Settings s, LightKind kind) { return row_of(s, kind).has_second; }

// Maps of bounds have neither an offset nor a format of depths to choose.
bool for_depths(Settings s, LightKind kind) { return row_of(s, kind).keeps_depths; }
bool for_offset_m(Settings s, LightKind kind) {
    static constexpr std::array kModes{BiasMode::constant, BiasMode::slope, BiasMode::normal_offset,
                                       BiasMode::receiver_plane};
    return for_depths(s, kind) && std::find(kModes.begin(), kModes.end(), s.tuning.bias.mode) != kModes.end();
}
bool for_offset_texel(Settings s, LightKind kind) {
    return for_offset_m(s, kind) && s.tuning.bias.mode != BiasMode::constant;
}
bool for_automatic_bias(Settings s, LightKind) { return s.tuning.bias.mode == BiasMode::automatic; }
bool for_proxies(Settings s, LightKind kind) { return for_depths(s, kind) && for_automatic_bias(s, kind); }

bool has_eye(Settings s, LightKind kind) {
    return for_sun(s, kind) && s.tuning.projection.kind == LightProjection::perspective;
}
bool for_cascades(Settings s, LightKind kind) { return for_sun(s, kind) && !has_eye(s, kind); }
bool for_splits(Settings s, LightKind kind) { return for_cascades(s, kind) && s.shadow.cascades != 1; }
bool for_lambda(Settings s, LightKind kind) {
    static constexpr std::array kMixed{CascadeSplits::practical, CascadeSplits::seen, CascadeSplits::sampled};
    return for_splits(s, kind) && std::find(kMixed.begin(), kMixed.end(), s.tuning.cascades.splits) != kMixed.end();
}
bool for_manual_splits(Settings s, LightKind kind) {
    return for_cascades(s, kind) && s.tuning.cascades.splits == CascadeSplits::manual;
}
bool for_blend(Settings s, LightKind kind) { return for_splits(s, kind) && for_depths(s, kind); }
bool for_warp(Settings s, LightKind kind) {
    return for_cascades(s, kind) && for_depths(s, kind) && s.tuning.cascades.fit == ShadowFit::tight;
}

constexpr std::array kBasic{
    SettingUse{"enabled"},
    SettingUse{"filter"},
    SettingUse{"max_error_px"},
    SettingUse{"narrowest_caster_px"},
    SettingUse{
        "source_radius_m", for_lamp_source,
        "a disc, sphere or tube; a spot or point light with filter pcss, pcss_moments, soft_triangles or exact_soft"},
    SettingUse{"source_width_m", for_width, "a rectangle or tube"},
    SettingUse{"source_height_m", for_height, "a rectangle"},
    SettingUse{"sun_radius_deg", for_sun_source, "a sun with filter pcss, pcss_moments, soft_triangles or exact_soft"},
};
constexpr std::array kQuality{
    SettingUse{"antialias", for_area_shares, "filter automatic, triangles, exact, exact_soft, pcss or soft_triangles"},
    SettingUse{"resolution"},
    SettingUse{"caster_faces", for_depths, "a filter other than exact and exact_soft"},
    SettingUse{"layers"},
    SettingUse{"translucent_casters"},
    SettingUse{"penumbra_rays", for_source_rays, "filter exact_soft"},
    SettingUse{"filter_seed", for_seed,
               "filter poisson_rotated, poisson_stratified, pcss, soft_triangles or exact_soft"},
    SettingUse{"filter_cell_m", for_cells, "a filter with random taps, and filter_seed world"},
};
constexpr std::array kCascades{
    SettingUse{"cascades", for_cascades, "a sun without perspective projection"},
    SettingUse{"fit", for_cascades, "a sun without perspective projection"},
    SettingUse{"splits", for_splits, "a sun with more than one cascade"},
    SettingUse{"split_lambda", for_lambda, "splits practical, seen or sampled of a sun"},
    SettingUse{"split_m", for_manual_splits, "splits manual of a sun"},
    SettingUse{"cascade_blend", for_blend, "a sun with more than one cascade, and a filter that reads depths"},
    SettingUse{"warp", for_warp, "fit tight of a sun, and a filter that reads depths"},
};
constexpr std::array kCost{
    SettingUse{"refresh_error_px", for_automatic_bias, "bias automatic"},
    SettingUse{"depth_format", for_depths, "a filter other than exact and exact_soft"},
    SettingUse{"cube_route", for_point, "a point light"},
    SettingUse{"multi_draw"},
    SettingUse{"short_references"},
    SettingUse{"proxies", for_proxies, "bias automatic, and a filter other than exact and exact_soft"},
    SettingUse{"early_bail", for_many_taps, "a filter of many taps"},
    SettingUse{"economy"},
    SettingUse{"keep_visibility"},
};
constexpr std::array kComparison{
    SettingUse{"filter_size", for_size, "a pcf or prefiltered filter"},
    SettingUse{"filter_taps", for_taps, "a poisson filter or pcss"},
    SettingUse{"filter_spread_texel", for_spread_texel, "a poisson or cube filter, and filter_spread_m 0"},
    SettingUse{"filter_spread_m", for_spread, "a poisson or cube filter"},
    SettingUse{"filter_doubles_m", for_spread, "a poisson or cube filter"},
    SettingUse{"moment_bits", for_moments, "a prefiltered filter"},
    SettingUse{"moment_exponent", for_exponent, "filter exponential, evsm2 or evsm4"},
    SettingUse{"moment_negative_exponent", for_second_warp, "filter evsm4"},
    SettingUse{"moment_bleeding", for_moments, "a prefiltered filter"},
    SettingUse{"moment_levels", for_moments, "a prefiltered filter"},
    SettingUse{"moment_anisotropy", for_moments, "a prefiltered filter"},
    SettingUse{"bias", for_depths, "a filter other than exact and exact_soft"},
    SettingUse{"bias_m", for_offset_m, "bias constant, slope, normal_offset or receiver_plane"},
    SettingUse{"bias_texel", for_offset_texel, "bias slope, normal_offset or receiver_plane"},
    SettingUse{"projection", for_sun, "a sun"},
    SettingUse{"eye_distance_m", has_eye, "a sun with projection perspective"},
    SettingUse{"eye_angle_deg", has_eye, "a sun with projection perspective"},
    SettingUse{"near_m"},
    SettingUse{"far_m"},
};

}  // namespace

std::span<const PurposeGroup> purpose_groups() {
    static constexpr std::array kGroups{
        PurposeGroup{"basic", "what most scenes ever set", kBasic},
        PurposeGroup{"quality", "when edges must be finer or softer than the defaults make them", kQuality},
        PurposeGroup{"cascades", "how a sun's maps divide the view", kCascades},
        PurposeGroup{"cost", "when memory or time is short", kCost},
        PurposeGroup{"for comparison", "textbook methods beside Gnomon's own", kComparison}};
    return kGroups;
}

std::string_view why_idle(const SettingUse& use, const LightSettings& settings, LightKind kind) {
    if (!settings.shadow.enabled && std::string_view(use.key) != "enabled") return "enabled";
    return !use.works || use.works(settings, kind) ? std::string_view{} : use.needs;
}

void reset_group(const PurposeGroup& group, LightSettings& settings) {
    for (const SettingUse& use : group.settings) {
        const LightSetting& setting = *find_setting(use.key);
        setting.set(settings, setting.get(LightSettings{}));
    }
}

bool is_default(const LightSetting& setting, const LightSettings& settings) {
    return setting.get(settings) == setting.get(LightSettings{});
}

}  // namespace gnomon::game
