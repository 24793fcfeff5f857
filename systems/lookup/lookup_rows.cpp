#include "systems/lookup/lookup_rows.h"

#include <algorithm>
#include <array>

#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::lookup {
namespace {

using shadow::FilterRow;
using shadow::MapReading;

constexpr std::array kUsualFilters = {ShadowFilter::triangles, ShadowFilter::pcss, ShadowFilter::pcf_bilinear,
                                      ShadowFilter::pcf_grid};

/// Filter that another one is a case of.
struct StandIn {
    ShadowFilter of;
    FilterChoice choice;
};
/// A grid of one tap is that tap. Without a source, no caster has a penumbra, and votes decide.
constexpr std::array kStandIns = {
    StandIn{ShadowFilter::hard, {.filter = ShadowFilter::pcf_grid, .alike = true, .one_tap = true}},
    StandIn{ShadowFilter::hardware_2x2, {.filter = ShadowFilter::pcf_bilinear, .alike = true, .one_tap = true}},
    StandIn{ShadowFilter::sharp_4x4, {.filter = ShadowFilter::pcss, .alike = true, .without_source = true}}};

}  // namespace

LookupUnits units_of(const LookupBindings& bindings) {
    LookupUnits units;
    units.arrays = (bindings.texture_unit_count - std::min(kTexelUnits, bindings.texture_unit_count)) / 2;
    units.first_depths = bindings.first_texture_unit;
    units.first_triangles = units.first_depths + units.arrays;
    units.first_texels = units.first_triangles + units.arrays;
    return units;
}

bool can_evaluate(ShadowFilter filter) {
    const FilterRow& row = shadow::filter_row(filter);
    return row.moments == nullptr && row.rays == nullptr;
}

std::span<const ShadowFilter> usual_filters() { return kUsualFilters; }

FilterChoice choose_filter(ShadowFilter filter, std::span<const ShadowFilter> filters) {
    const auto has = [&](ShadowFilter f) { return std::find(filters.begin(), filters.end(), f) != filters.end(); };
    if (has(filter)) return {.filter = filter, .alike = true};
    for (const StandIn& stand_in : kStandIns)
        if (stand_in.of == filter && has(stand_in.choice.filter)) return stand_in.choice;
    const FilterRow& wanted = shadow::filter_row(filter);
    const auto distance = [&](ShadowFilter other) {
        const FilterRow& row = shadow::filter_row(other);
        // A prefiltered map's blur is that of a square of blended taps.
        const bool blends = wanted.moments != nullptr || wanted.reading == MapReading::compare_linear;
        int apart = row.width == wanted.width ? 0 : 8;
        apart += (row.reading == MapReading::compare_linear) == blends ? 0 : 2;
        apart += (row.reading == MapReading::depths) == (wanted.reading == MapReading::depths) ? 0 : 4;
        return apart + (row.storage.triangle_ids ? 32 : 0);
    };
    const ShadowFilter nearest = *std::min_element(
        filters.begin(), filters.end(), [&](ShadowFilter a, ShadowFilter b) { return distance(a) < distance(b); });
    const bool fixed = wanted.width == shadow::FilterWidth::fixed;
    return {.filter = nearest,
            .one_tap = fixed && shadow::filter_row(nearest).width == shadow::FilterWidth::size,
            .without_source = wanted.width != shadow::FilterWidth::source};
}

bool has_kind(const LookupRows& rows, LookupKind kind) {
    switch (kind) {
        case LookupKind::cascades:
            return rows.suns;
        case LookupKind::warped_cascades:
            return rows.warped_suns;
        case LookupKind::cone:
            return rows.cones;
        case LookupKind::cube:
            return rows.cubes;
        case LookupKind::none:
            return false;
    }
    return false;
}

LookupKind lookup_kind(const shadow::ShaderKey& row) {
    if (row.kind_file == shadow::kWarpedSunFile) return LookupKind::warped_cascades;
    if (row.kind_file == shadow::kPerspectiveFile) return LookupKind::cone;
    if (row.kind_file == kCascadesFile) return LookupKind::cascades;
    return row.kind_file == kCubeFile ? LookupKind::cube : LookupKind::none;
}

}  // namespace gnomon::lookup
