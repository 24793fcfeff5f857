#include "sample_game/inside/filter_figures.h"

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_choice.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::game {
namespace {

const char* sampler_text(shadow::MapReading reading) {
    if (reading == shadow::MapReading::depths) return "depth, read as it is";
    if (reading == shadow::MapReading::moments) return "moments, linear sampler";
    return reading == shadow::MapReading::compare_linear ? "depth, linear sampler" : "depth, nearest sampler";
}

static_assert(static_cast<int>(FilterExtent::size) == static_cast<int>(shadow::FilterWidth::size) &&
              static_cast<int>(FilterExtent::spread) == static_cast<int>(shadow::FilterWidth::spread) &&
              static_cast<int>(FilterExtent::source) == static_cast<int>(shadow::FilterWidth::source));

}  // namespace

FilterFigures figures_of(ShadowFilter filter) {
    constexpr std::uint32_t kUsualMap_px = 2048;
    const shadow::FilterRow& row = shadow::filter_row(filter);
    const ShadowTuning::Kernel usual;
    FilterFigures figures{.taps = row.taps(usual, false),
                          .cube_taps = row.taps(usual, true),
                          .widest_texel = shadow::filter_settings(row, LightItem{}, kUsualMap_px).widest_texel,
                          .sampler = sampler_text(row.reading),
                          .extent = static_cast<FilterExtent>(row.width),
                          .prefiltered = row.moments != nullptr,
                          .keeps_depths = !row.storage.conservative_bounds,
                          .antialiases = row.area_shares != shadow::AreaShares::none,
                          .random = row.random};
    if (row.moments) {
        figures.has_exponent = row.moments->bits_32.usual_exponent > 0.0f;
        figures.has_second = row.moments->usual_negative_exponent > 0.0f;
    }
    if (row.rays) figures.rays = row.rays->per_source ? FilterRays::to_source : FilterRays::one;
    return figures;
}

ShadowFilter filter_of(ShadowFilter wanted, LightKind kind) {
    return wanted == ShadowFilter::automatic ? shadow::usual_filter(kind) : wanted;
}

bool is_sun(LightKind kind) { return light_facts(kind).parallel; }
bool has_width(LightKind kind) { return has_height(kind) || light_facts(kind).shape == SourceShape::tube; }
bool has_height(LightKind kind) { return light_facts(kind).shape == SourceShape::rectangle; }
bool has_radius(LightKind kind) { return light_facts(kind).area() && !has_height(kind); }
bool is_point(LightKind kind) { return !light_facts(kind).parallel && !light_facts(kind).cone; }

}  // namespace gnomon::game
