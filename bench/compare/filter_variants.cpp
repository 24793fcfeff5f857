#include "bench/compare/filter_variants.h"

#include <array>

#include "sample_game/support/settings/light_settings.h"

namespace gnomon::bench {
namespace {

constexpr std::array<std::uint32_t, 3> kSizes = {3, 5, 7};
/// Blurs cost a prefiltered map nothing when it is read.
constexpr std::array<std::uint32_t, 3> kBlurs = {3, 7, 15};
constexpr std::array<std::uint32_t, 4> kTaps = {4, 8, 16, 32};
/// More take a software device half a minute a frame.
constexpr std::array<std::uint32_t, 2> kRays = {4, 16};

/// Adds the row with `value` of `key`, if the row has such a choice.
void add(std::vector<FilterVariant>& found, const shadow::FilterRow& row, const char* key = nullptr,
         std::uint32_t value = 0) {
    const std::string name(row.name), number = std::to_string(value);
    FilterVariant& variant = found.emplace_back();
    variant.name = key ? name + "_" + number : name;
    variant.settings = {"filter=" + name};
    variant.row = &row;
    if (key) variant.settings.push_back(std::string(key) + "=" + number);
    if (variant.by_source())
        variant.settings.insert(variant.settings.end(), disk_source().begin(), disk_source().end());
    for (const std::string& setting : variant.settings) (void)game::apply_setting(variant.light, setting);
}

}  // namespace

const std::vector<std::string>& disk_source() {
    static const std::vector<std::string> settings = {"source_radius_m=0.02", "sun_radius_deg=1"};
    return settings;
}

std::vector<FilterVariant> filter_variants() {
    std::vector<FilterVariant> found;
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        const ShadowTuning::Kernel fewest{.taps = 1}, most{.taps = kTaps.back()};
        if (row.width == shadow::FilterWidth::size)
            for (const std::uint32_t size : row.moments ? kBlurs : kSizes) add(found, row, "filter_size", size);
        else if (row.rays && row.rays->per_source)
            for (const std::uint32_t rays : kRays) add(found, row, "penumbra_rays", rays);
        else if (row.taps(fewest, false) != row.taps(most, false))
            for (const std::uint32_t taps : kTaps) add(found, row, "filter_taps", taps);
        else
            add(found, row);
    }
    return found;
}

}  // namespace gnomon::bench
