#include "bench/compare/filter_gallery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "bench/accuracy/accuracy.h"
#include "bench/common/png_file.h"
#include "bench/compare/filter_variants.h"
#include "bench/flicker/map_readback.h"
#include "bench/glsl_on_cpu/cpu_lookup.h"
#include "bench/text/printf_string.h"
#include "sample_game/support/files/image_files.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kShownGrid = 7;  // size of pcf_grid beside soft shadows

/// Returns a row that takes the light as a point, judged by the truth about the disk: that shows the error of a fixed
/// width.
FilterVariant judged_by_disk(const FilterVariant& variant) {
    FilterVariant other = variant;
    other.name += "_disk";
    other.settings.insert(other.settings.end(), disk_source().begin(), disk_source().end());
    return other;
}

/// Returns all rows, and after them the rows to show beside filters that soften by the source.
std::vector<FilterVariant> pictured() {
    std::vector<FilterVariant> found = filter_variants(), by_disk;
    for (const FilterVariant& variant : found) {
        const ShadowFilter id = variant.row->id;
        const bool widest_grid = id == ShadowFilter::pcf_grid && variant.light.tuning.kernel.size_texel == kShownGrid;
        if (id == ShadowFilter::hard || id == ShadowFilter::triangles || widest_grid)
            by_disk.push_back(judged_by_disk(variant));
    }
    found.insert(found.end(), by_disk.begin(), by_disk.end());
    return found;
}

constexpr glm::uvec2 kWindow_px{80, 48};
constexpr std::uint32_t kMagnified = 4;

/// Returns the lower left corner of the window in which the truth has the most edges.
glm::uvec2 busiest_window(const LightAccuracy& light, glm::uvec2 size_px) {
    const glm::uvec2 window = glm::min(kWindow_px, size_px);
    const std::size_t width = size_px.x;
    const auto edge = [&](std::size_t x, std::size_t y) {
        const auto at = [&](std::size_t i) { return light.truth.scored[i] ? light.truth.visibility[i] : -1.0f; };
        const float here = at(y * width + x), beside = at(y * width + x + 1);
        return here >= 0.0f && beside >= 0.0f && here != beside;
    };
    constexpr std::uint32_t kStep_px = 8;
    glm::uvec2 best{0, 0};
    std::size_t most = 0;
    for (std::uint32_t y = 0; y + window.y <= size_px.y; y += kStep_px)
        for (std::uint32_t x = 0; x + window.x <= size_px.x; x += kStep_px) {
            std::size_t edges = 0;
            for (std::uint32_t v = 0; v < window.y; ++v)
                for (std::uint32_t u = 0; u + 1 < window.x; ++u) edges += edge(x + u, y + v);
            if (edges <= most) continue;
            most = edges;
            best = {x, y};
        }
    return best;
}

std::optional<Error> write_window(const std::vector<float>& values, glm::uvec2 size_px, glm::uvec2 at,
                                  const std::filesystem::path& file) {
    constexpr float kByteMax = 255.0f, kRounding = 0.5f;
    const glm::uvec2 window = glm::min(kWindow_px, size_px);
    const glm::uvec2 shown = window * kMagnified;
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t row = 0; row < shown.y; ++row)  // pictures start at the top, visibility at the bottom
        for (std::uint32_t column = 0; column < shown.x; ++column) {
            const std::uint32_t x = at.x + column / kMagnified, y = at.y + window.y - 1 - row / kMagnified;
            const float value = std::clamp(values[std::size_t{y} * size_px.x + x], 0.0f, 1.0f);
            const auto level = static_cast<std::uint8_t>(value * kByteMax + kRounding);
            rgba.insert(rgba.end(), {level, level, level, 255});
        }
    return write_png(file, shown.x, shown.y, rgba);
}

/// Returns the mean difference from the truth, about the source with its size if it has one. A blurred value counts by
/// its difference.
double mean_error(const LightAccuracy& light) {
    if (light.soft) return light.soft->metrics.mean_error;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < light.measured.size(); ++i) {
        if (!light.truth.scored[i] || light.truth.ambiguous[i] || !(light.measured[i] >= 0.0f)) continue;
        sum += static_cast<double>(std::abs(light.measured[i] - light.truth.visibility[i]));
        ++count;
    }
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

constexpr const char* kTableHead =
    "| filter | light | taps | E | wrong % | mean error % | bailing saves % | changes % | makes wrong % |\n"
    "|---|---|---|---|---|---|---|---|---|\n";
constexpr float kHalf = 0.5f;

std::string table_line(const FilterVariant& variant, const LightAccuracy& light, const TapCount& taps) {
    const bool cube = shadow::light_kind_row(light.report.kind).texture == gl::TextureKind::cube;
    const double texels = static_cast<double>(light.report.counts.texels) / std::max(1u, light.report.counts.views);
    const auto edge_px = static_cast<std::uint32_t>(std::sqrt(texels));
    LightItem item;
    item.kind = light.report.kind;
    item.source_radius_m = variant.light.source_radius_m;
    item.sun_radius_rad = variant.light.sun_radius_rad;
    item.tuning = variant.light.tuning;
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %s | %u | %.1f | %.3f | %.3f | %.1f | %.3f | %.3f |\n",
                  variant.name.c_str(), light.report.name.c_str(), variant.row->taps(item.tuning.kernel, cube),
                  static_cast<double>(shadow::filter_settings(*variant.row, item, edge_px).widest_texel),
                  kPercent * light.metrics.fraction(light.metrics.wrong), kPercent * mean_error(light),
                  kPercent * taps.saved(), kPercent * taps.share(taps.changed), kPercent * taps.share(taps.wrong));
    return text;
}

std::optional<Error> apply(Stage& stage, const std::vector<std::string>& settings) {
    for (const std::string& setting : settings)
        if (auto error = stage.apply_setting(setting)) return error;
    return std::nullopt;
}

/// Computes visibility and taps of each point, under the lights' present settings.
std::optional<Error> evaluate(Stage& stage, std::uint32_t count, std::vector<std::vector<ExactVisibility>>& lights,
                              std::vector<std::string>& names) {
    constexpr int kSettlingFrames = 2;
    auto frames = ShadowFrames::create(stage);
    if (!frames) return frames.error();
    for (int i = 0; i < kSettlingFrames; ++i)
        if (auto error = frames.value()->run()) return error;
    const SceneSnapshot& scene = frames.value()->snapshot();
    const std::vector<SurfacePoint> points =
        surface_points(scene, stage.library(), std::span(&scene.consumers.front(), 1), count);
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        if (!scene.lights[l].has_shadow) continue;
        const auto light = frames.value()->exact_light(l);
        if (!light) return Error{"a filter that is not compiled in", stage.scene_name(), "", "bench.row"};
        std::vector<SurfacePoint> lit;
        std::copy_if(points.begin(), points.end(), std::back_inserter(lit),
                     [&](const SurfacePoint& p) { return shines_on(scene.lights[l], p); });
        lights.emplace_back(lit.size());
        light->evaluate(lit, lights.back());
        names.push_back(scene.lights[l].name);
    }
    return std::nullopt;
}

}  // namespace

Result<std::vector<TapCount>> count_taps(Stage& stage, std::uint32_t points) {
    std::vector<std::vector<ExactVisibility>> all, early;
    std::vector<std::string> names, again;
    if (auto error = apply(stage, {"early_bail=off"})) return *error;
    if (auto error = evaluate(stage, points, all, names)) return *error;
    if (auto error = apply(stage, {"early_bail=on"})) return *error;
    if (auto error = evaluate(stage, points, early, again)) return *error;
    if (auto error = apply(stage, {"early_bail=off"})) return *error;
    std::vector<TapCount> counts;
    for (std::size_t l = 0; l < all.size(); ++l) {
        TapCount count{names[l], all[l].size()};
        for (std::size_t i = 0; i < all[l].size(); ++i) {
            count.all += all[l][i].taps;
            count.early += early[l][i].taps;
            const float with = early[l][i].value, without = all[l][i].value;
            count.changed += with != without;
            count.wrong += (with >= kHalf) != (without >= kHalf);
        }
        count.all /= std::max<double>(1.0, static_cast<double>(count.points));
        count.early /= std::max<double>(1.0, static_cast<double>(count.points));
        counts.push_back(std::move(count));
    }
    return counts;
}

Result<FilterPictures> write_filter_pictures(Stage& stage, const std::filesystem::path& folder,
                                             const FilterPicturesOptions& options) {
    if (auto error = game::make_writable_folder(folder)) return *error;
    FilterPictures found;
    found.point_figures = found.disk_figures = kTableHead;
    std::optional<glm::uvec2> window;
    bool soft_truth = false;
    for (const FilterVariant& variant : pictured()) {
        if (variant.name.find(options.only) == std::string::npos) continue;
        if (auto error = apply(stage, variant.settings)) return *error;
        std::vector<TapCount> taps;
        if (knows_filter(*variant.row)) {
            auto counted = count_taps(stage, options.points);
            if (!counted) return counted.error();
            taps = std::move(counted).value();
        }
        const auto accuracy = measure_accuracy(stage, {.timed_frames = 0});
        if (!accuracy) return accuracy.error();
        const std::vector<LightAccuracy>& lights = accuracy.value().lights;
        for (const LightAccuracy& light : lights) {
            const auto count =
                std::find_if(taps.begin(), taps.end(), [&](const TapCount& c) { return c.light == light.report.name; });
            (light.soft ? found.disk_figures : found.point_figures) +=
                table_line(variant, light, count == taps.end() ? TapCount{} : *count);
        }
        if (lights.empty()) continue;
        (lights.front().soft ? found.disk : found.point).push_back(variant.name);
        const glm::uvec2 size_px = accuracy.value().size_px;
        if (!window) {
            window = busiest_window(lights.front(), size_px);
            if (auto error = write_window(lights.front().truth.visibility, size_px, *window, folder / "truth.png"))
                return *error;
        }
        if (lights.front().soft && !soft_truth) {
            soft_truth = true;
            const std::vector<float>& truth = lights.front().soft->truth.visibility;
            if (auto error = write_window(truth, size_px, *window, folder / "truth_disk.png")) return *error;
        }
        if (auto error = write_window(lights.front().measured, size_px, *window, folder / (variant.name + ".png")))
            return *error;
    }
    return found;
}

std::string picture_table(const std::vector<std::string>& names, const std::string& folder) {
    constexpr std::size_t kColumns = 3;
    std::string table;
    for (std::size_t first = 0; first < names.size(); first += kColumns) {
        std::string titles, pictures;
        for (std::size_t i = first; i < first + kColumns; ++i) {
            const std::string name = i < names.size() ? names[i] : "";
            titles += name.empty() ? "| " : "| `" + name + "` ";
            pictures += name.empty() ? "| " : "| ![" + name + "](" + folder + "/" + name + ".png) ";
        }
        table += titles + "|\n" + (first == 0 ? "|---|---|---|\n" : "") + pictures + "|\n";
    }
    return table;
}

}  // namespace gnomon::bench
