#include "bench/sweep/sweep_plan.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "bench/compare/filter_variants.h"

namespace gnomon::bench {
namespace {

constexpr LightKinds kSun = only(LightKind::directional), kSpot = only(LightKind::spot),
                     kPoint = only(LightKind::point);

/// One value of a factor: what it is called, and what sets it.
struct Value {
    std::string name;
    std::vector<std::string> settings;
    LightKinds kinds = kAllKinds;
};

/// Makes a value that has its "KEY=VALUE" as its name.
Value of(const std::string& setting, LightKinds kinds = kAllKinds) { return {setting, {setting}, kinds}; }

std::vector<Value> fits() { return {of("fit=tight", kSun), of("fit=stable", kSun)}; }

std::vector<Value> cascades(SweepSize size) {
    std::vector<Value> values;
    for (const char* count : {"1", "2", "3", "4", "6", "8"})
        if (size == SweepSize::full || *count == '1' || *count == '4' || *count == '8')
            values.push_back(of(std::string("cascades=") + count, kSun));
    return values;
}

/// Returns the sizes of maps. 4096 is not for cubes: with the widest filters six such faces take gigabytes.
std::vector<Value> resolutions(SweepSize size) {
    if (size == SweepSize::quick) return {of("resolution=512"), of("resolution=1024"), of("resolution=2048")};
    return {of("resolution=512"),  of("resolution=768"),  of("resolution=1024"),
            of("resolution=1536"), of("resolution=2048"), of("resolution=4096", kSun | kSpot)};
}

std::vector<Value> formats() { return {of("depth_format=d24"), of("depth_format=d16")}; }

std::vector<Value> biases(SweepSize size) {
    if (size == SweepSize::quick) return {of("bias=normal_offset"), of("bias=tutorial_cosine")};
    std::vector<Value> values;
    for (const char* mode : {"constant", "slope", "normal_offset", "receiver_plane", "tutorial_constant",
                             "tutorial_cosine", "tutorial_tangent"})
        values.push_back(of(std::string("bias=") + mode));
    return values;
}

/// Filters of the quick sweep, each in its first variant.
constexpr std::string_view kQuickFilters[] = {"hard",      "hardware_2x2", "pcf_grid", "poisson",
                                              "sharp_4x4", "evsm4",        "moments",  "pcss"};

/// Returns the rows of the filter table, except the default one.
std::vector<Value> filters(SweepSize size) {
    std::vector<Value> values;
    const shadow::FilterRow* last = nullptr;
    for (const FilterVariant& variant : filter_variants()) {
        const bool more = variant.row == last;
        last = variant.row;
        const bool quick = !more && std::find(std::begin(kQuickFilters), std::end(kQuickFilters), variant.row->name) !=
                                        std::end(kQuickFilters);
        if (variant.row->id == LightShadow{}.filter || (size == SweepSize::quick && !quick)) continue;
        values.push_back({variant.name, variant.settings});
    }
    return values;
}

/// Returns the values with these names.
std::vector<Value> named(const std::vector<Value>& values, std::span<const std::string_view> names) {
    std::vector<Value> found;
    for (const Value& value : values)
        if (std::find(names.begin(), names.end(), value.name) != names.end()) found.push_back(value);
    return found;
}

/// Combines values with the filter `hard`: biases differ most where single texels decide.
std::vector<Value> with_hard(std::vector<Value> values) {
    for (Value& value : values) {
        value.name = "hard, " + value.name;
        value.settings.insert(value.settings.begin(), "filter=hard");
    }
    return values;
}

/// Returns the settings of LearnOpenGL's and opengl-tutorial.org's chapters: one map around the scene without cascades,
/// their bias and their filters. Maps have 1024 texels, or 8428 in the chapter that uses more.
std::vector<Value> tutorials() {
    const std::vector<std::string> box = {"fit=stable", "cascades=1", "caster_faces=both"};
    const auto sun = [&](std::string name, std::vector<std::string> settings) {
        settings.insert(settings.begin(), box.begin(), box.end());
        return Value{std::move(name), std::move(settings), kSun};
    };
    const std::vector<std::string> pcf = {"filter=pcf_grid", "filter_size=3", "bias=tutorial_cosine"};
    const auto with = [](std::vector<std::string> settings, const char* more) {
        settings.emplace_back(more);
        return settings;
    };
    return {sun("tutorial, 3x3 PCF, 1024", with(pcf, "resolution=1024")),
            sun("tutorial, 3x3 PCF, 8428", with(pcf, "resolution=8428")),
            sun("tutorial, Poisson, d16, 1024",
                {"filter=poisson", "filter_taps=4", "depth_format=d16", "bias=tutorial_tangent", "resolution=1024"}),
            {"tutorial, 3x3 PCF, 1024, spot", with(pcf, "resolution=1024"), kSpot},
            {"tutorial, 20 directions, 1024",
             {"filter=cube_directions", "bias=tutorial_cosine", "resolution=1024"},
             kPoint}};
}

class Plan {
public:
    explicit Plan(LightKinds kinds) : kinds_(kinds) {}

    void add(const std::string& factor, const Value& value) {
        SweepRow row;
        row.name = value.name;
        row.settings = value.settings;
        row.kinds = value.kinds & kinds_;
        row.factor = factor;
        for (const SweepRow& other : rows_)
            if (other.settings == row.settings) row.kinds &= static_cast<LightKinds>(~other.kinds);
        if (row.kinds != 0) rows_.push_back(std::move(row));
    }

    void add(const std::string& factor, const std::vector<Value>& values) {
        for (const Value& value : values) add(factor, value);
    }

    void cross(const std::string& factor, const std::vector<Value>& some, const std::vector<Value>& others) {
        for (const Value& b : others)
            for (const Value& a : some) {
                Value both{b.name + ", " + a.name, b.settings, static_cast<LightKinds>(a.kinds & b.kinds)};
                both.settings.insert(both.settings.end(), a.settings.begin(), a.settings.end());
                add(factor, both);
            }
    }

    std::vector<SweepRow> rows() && { return std::move(rows_); }

private:
    LightKinds kinds_;
    std::vector<SweepRow> rows_;
};

}  // namespace

std::vector<SweepRow> sweep_plan(SweepSize size, LightKinds kinds) {
    using Names = std::vector<std::string_view>;
    const bool full = size == SweepSize::full;
    Plan plan(kinds);
    plan.add(std::string(kDefaultsRow), Value{std::string(kDefaultsRow), {}});
    plan.add(std::string(kTutorialFactor), tutorials());
    plan.add("fit", fits());
    plan.add("cascades", cascades(size));
    plan.add("resolution", resolutions(size));
    plan.add("format", formats());
    plan.add("bias", biases(size));
    plan.add("filter", filters(size));
    plan.add("antialias", Value{"antialias=on", {"antialias=on"}});

    const std::vector<Value> sizes =
        named(resolutions(size), full ? Names{"resolution=512", "resolution=1024", "resolution=2048", "resolution=4096"}
                                      : Names{"resolution=512", "resolution=2048"});
    const std::vector<Value> most_sizes = named(sizes, Names{"resolution=512", "resolution=1024", "resolution=2048"});
    const Names compared =
        full ? Names{"hard", "hardware_2x2", "pcf_grid_3", "pcf_grid_7", "sharp_4x4"} : Names{"hard", "pcf_grid_3"};
    const Names prefiltered = full ? Names{"evsm4_7", "moments_7", "pcss_16"} : Names{};
    plan.cross("resolution x filter", sizes, named(filters(size), compared));
    plan.cross("resolution x filter", most_sizes, named(filters(size), prefiltered));
    plan.cross("resolution x bias", most_sizes,
               with_hard(named(biases(size), full ? Names{"bias=slope", "bias=normal_offset", "bias=receiver_plane",
                                                          "bias=tutorial_cosine"}
                                                  : Names{"bias=tutorial_cosine"})));
    plan.cross("resolution x cascades", sizes,
               named(cascades(size), full ? Names{"cascades=1", "cascades=2", "cascades=8"} : Names{"cascades=1"}));
    return std::move(plan).rows();
}

}  // namespace gnomon::bench
