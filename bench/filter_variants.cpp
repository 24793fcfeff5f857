#include "bench/filter_variants.h"

#include <array>

namespace gnomon::bench {
namespace {

const std::vector<std::string> kPoint = {"source_radius_m=0", "sun_radius_deg=0"};
constexpr float kDiskRadius = 0.02f;  // metres; close to a degree in radians, which changes no number of taps
constexpr std::array<std::uint32_t, 3> kSizes = {3, 5, 7};
/// Blurs cost a prefiltered map nothing when it is read.
constexpr std::array<std::uint32_t, 3> kBlurs = {3, 7, 15};
constexpr std::array<std::uint32_t, 4> kTaps = {4, 8, 16, 32};

void add(std::vector<FilterVariant>& found, const shadow::FilterRow& row, const std::string& suffix,
         const std::string& setting, const LightShadow& shadow) {
    const std::string name(row.name);
    found.push_back({name + suffix, {"filter=" + name}, &row, shadow});
    std::vector<std::string>& settings = found.back().settings;
    if (!setting.empty()) settings.push_back(setting);
    const auto& source = found.back().by_source() ? disk_source() : kPoint;
    settings.insert(settings.end(), source.begin(), source.end());
}

}  // namespace

const std::vector<std::string>& disk_source() {
    static const std::vector<std::string> settings = {"source_radius_m=0.02", "sun_radius_deg=1"};
    return settings;
}

std::vector<FilterVariant> filter_variants() {
    std::vector<FilterVariant> found;
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        LightShadow shadow{.filter = row.id};
        if (row.width == shadow::FilterWidth::source) shadow.source_radius_m = shadow.sun_radius_rad = kDiskRadius;
        LightShadow fewest = shadow, most = shadow;
        fewest.filter_taps = 1;
        most.filter_taps = kTaps.back();
        const bool moments = row.storage == shadow::FilterStorage::moments;
        if (row.width == shadow::FilterWidth::size) {
            for (const std::uint32_t size : moments ? kBlurs : kSizes) {
                shadow.filter_size = size;
                add(found, row, "_" + std::to_string(size), "filter_size=" + std::to_string(size), shadow);
            }
        } else if (row.taps(fewest, false) != row.taps(most, false)) {
            for (const std::uint32_t taps : kTaps) {
                shadow.filter_taps = taps;
                add(found, row, "_" + std::to_string(taps), "filter_taps=" + std::to_string(taps), shadow);
            }
        } else {
            add(found, row, "", "", shadow);
        }
    }
    return found;
}

}  // namespace gnomon::bench
